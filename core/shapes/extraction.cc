#include "shapes/extraction.hh"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace layout_embedding::shapes {

namespace {

using Node = std::array<int, 3>;

constexpr int kHalf = 1 << 19;

/// Nodes within half a million cells of the seed, as one number.
std::uint64_t key_of(const Node& n)
{
    return (static_cast<std::uint64_t>(n[0] + kHalf) << 40) |
           (static_cast<std::uint64_t>(n[1] + kHalf) << 20) |
           static_cast<std::uint64_t>(n[2] + kHalf);
}

/// Corners of a cell by bits: x 1, y 2, z 4. Kuhn's six tetrahedra go from corner 0 to corner 7
/// along three edges in all orders, so that those of neighbouring cells fit.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                   {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

class Marching {
public:
    Marching(const Solid& solid, const Vec3& seed, double cell)
        : solid_(solid), seed_(seed), cell_(cell)
    {}

    RawSurface run()
    {
        std::vector<Node> queue;
        std::unordered_map<std::uint64_t, bool> seen;
        const auto visit = [&](const Node& n) {
            if (seen.emplace(key_of(n), true).second && crossed(n)) {
                queue.push_back(n);
            }
        };
        // The seed is a node; the surface passes through one of the cells around it.
        for (int i = 0; i < 27 && queue.empty(); ++i) {
            visit({i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1});
        }
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const Node n = queue[i];
            march(n);
            for (int axis = 0; axis < 3; ++axis) {
                for (const int step : {-1, 1}) {
                    Node neighbor = n;
                    neighbor[axis] += step;
                    if (std::abs(neighbor[axis]) < kHalf - 2) {
                        visit(neighbor);
                    }
                }
            }
        }
        return std::move(surface_);
    }

private:
    static Node corner(const Node& n, int bits)
    {
        return {n[0] + (bits & 1), n[1] + (bits >> 1 & 1), n[2] + (bits >> 2)};
    }
    Vec3 place(const Node& n) const { return seed_ + cell_ * Vec3(n[0], n[1], n[2]); }

    double value(const Node& n)
    {
        const auto [entry, is_new] = values_.try_emplace(key_of(n), 0.0);
        if (is_new) {
            entry->second = solid_.distance(place(n));
        }
        return entry->second;
    }

    bool crossed(const Node& n)
    {
        bool inside = false;
        bool outside = false;
        for (int bits = 0; bits < 8; ++bits) {
            (value(corner(n, bits)) < 0.0 ? inside : outside) = true;
        }
        return inside && outside;
    }

    Index vertex(const Node& n, int from, int to)
    {
        const Node low = corner(n, from);
        const auto key = key_of(low) * 8 + static_cast<std::uint64_t>(to ^ from);
        const auto [entry, is_new] =
            vertices_.try_emplace(key, static_cast<Index>(surface_.positions.size()));
        if (is_new) {
            const Node high = corner(n, to);
            const double a = value(low);
            const double b = value(high);
            // Vertices of different edges never coincide.
            const double t = std::clamp(a / (a - b), 0.02, 0.98);
            surface_.positions.push_back(place(low) + t * (place(high) - place(low)));
        }
        return entry->second;
    }

    void add(const Vec3& inside, Index a, Index b, Index c)
    {
        const Vec3& pa = surface_.positions[a];
        const Vec3 normal = (surface_.positions[b] - pa).cross(surface_.positions[c] - pa);
        if (normal.dot(pa - inside) < 0.0) {
            std::swap(b, c);
        }
        surface_.corners.insert(surface_.corners.end(), {a, b, c});
    }

    void march(const Node& n)
    {
        for (const auto& tetrahedron : kTetrahedra) {
            int in[4];
            int out[4];
            int ins = 0;
            int outs = 0;
            for (const int bits : tetrahedron) {
                if (value(corner(n, bits)) < 0.0) {
                    in[ins++] = bits;
                } else {
                    out[outs++] = bits;
                }
            }
            const auto cut = [&](int i, int o) {
                return vertex(n, std::min(i, o), std::max(i, o));
            };
            if (ins == 1) {
                add(place(corner(n, in[0])), cut(in[0], out[0]), cut(in[0], out[1]),
                    cut(in[0], out[2]));
            } else if (ins == 2) {
                const Index a = cut(in[0], out[0]);
                const Index b = cut(in[0], out[1]);
                const Index c = cut(in[1], out[1]);
                const Index d = cut(in[1], out[0]);
                add(place(corner(n, in[0])), a, b, c);
                add(place(corner(n, in[0])), a, c, d);
            } else if (ins == 3) {
                add(place(corner(n, in[0])), cut(in[0], out[0]), cut(in[1], out[0]),
                    cut(in[2], out[0]));
            }
        }
    }

    const Solid& solid_;
    Vec3 seed_;
    double cell_;
    std::unordered_map<std::uint64_t, double> values_;
    std::unordered_map<std::uint64_t, Index> vertices_;
    RawSurface surface_;
};

}  // namespace

RawSurface extract_surface(const Solid& solid, const Vec3& seed, double cell)
{
    return Marching(solid, seed, cell).run();
}

RawSurface clip_surface(const RawSurface& surface, const Vec3& origin, const Vec3& normal,
                        double cell)
{
    std::vector<double> heights;
    for (const Vec3& p : surface.positions) {
        const double height = (p - origin).dot(normal);
        heights.push_back(std::abs(height) < 0.02 * cell ? 0.02 * cell : height);
    }
    RawSurface result;
    result.positions = surface.positions;
    std::unordered_map<std::uint64_t, Index> cuts;
    const auto cut = [&](Index a, Index b) {
        const auto low = std::min(a, b);
        const auto high = std::max(a, b);
        const auto [entry, is_new] = cuts.try_emplace(static_cast<std::uint64_t>(low) << 32 | high,
                                                      static_cast<Index>(result.positions.size()));
        if (is_new) {
            const double t = heights[low] / (heights[low] - heights[high]);
            result.positions.push_back(surface.positions[low] +
                                       t * (surface.positions[high] - surface.positions[low]));
        }
        return entry->second;
    };
    for (std::size_t f = 0; f < surface.corners.size(); f += 3) {
        std::array<Index, 3> v{surface.corners[f], surface.corners[f + 1], surface.corners[f + 2]};
        const auto below = [&](Index w) { return heights[w] < 0.0; };
        const auto count = std::count_if(v.begin(), v.end(), below);
        if (count == 3) {
            result.corners.insert(result.corners.end(), v.begin(), v.end());
            continue;
        }
        if (count == 0) {
            continue;
        }
        // The one that is alone on its side comes first.
        while (below(v[0]) != (count == 1) || below(v[1]) != below(v[2])) {
            std::rotate(v.begin(), v.begin() + 1, v.end());
        }
        const Index ab = cut(v[0], v[1]);
        const Index ac = cut(v[0], v[2]);
        if (count == 1) {
            result.corners.insert(result.corners.end(), {v[0], ab, ac});
        } else {
            result.corners.insert(result.corners.end(), {ab, v[1], v[2], ab, v[2], ac});
        }
    }
    // Components by union of vertices.
    std::vector<Index> parents(result.positions.size());
    for (Index v = 0; v < parents.size(); ++v) {
        parents[v] = v;
    }
    const auto root = [&](Index v) {
        while (parents[v] != v) {
            v = parents[v] = parents[parents[v]];
        }
        return v;
    };
    for (std::size_t f = 0; f < result.corners.size(); f += 3) {
        for (const std::size_t other : {f + 1, f + 2}) {
            const Index a = root(result.corners[f]);
            const Index b = root(result.corners[other]);
            parents[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<Index> sizes(parents.size(), 0);
    for (std::size_t f = 0; f < result.corners.size(); f += 3) {
        ++sizes[root(result.corners[f])];
    }
    const auto largest =
        static_cast<Index>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    RawSurface component;
    std::vector<Index> ids(parents.size(), kNone);
    for (const Index corner : result.corners) {
        if (root(corner) == largest) {
            if (ids[corner] == kNone) {
                ids[corner] = static_cast<Index>(component.positions.size());
                component.positions.push_back(result.positions[corner]);
            }
            component.corners.push_back(ids[corner]);
        }
    }
    return component;
}

}  // namespace layout_embedding::shapes
