#pragma once

#include <utility>
#include <vector>

#include "base/random.hh"
#include "base/types.hh"

/// Random things that instances for tests are made of, the same on every platform.
namespace layout_embedding::test {

/// A point on the unit sphere, by rejection, without transcendental functions.
inline Vec3 random_direction(Random& random)
{
    for (;;) {
        // One by one: compilers differ in the order in which they evaluate arguments.
        const double x = 2 * random.unit() - 1;
        const double y = 2 * random.unit() - 1;
        const double z = 2 * random.unit() - 1;
        const Vec3 p(x, y, z);
        if (p.squaredNorm() <= 1 && p.squaredNorm() > 0.01) {
            return p / p.norm();
        }
    }
}

template <typename T>
void shuffle(std::vector<T>& items, Random& random)
{
    for (std::size_t i = items.size(); i > 1; --i) {
        std::swap(items[i - 1], items[random.below(i)]);
    }
}

}  // namespace layout_embedding::test
