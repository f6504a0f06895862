#include "apps/quad_unfolding.hh"

#include <algorithm>
#include <cmath>
#include <vector>

#include "patches/domain.hh"

namespace layout_embedding {
namespace {

/// The energy as a function of two coordinates per vertex, in its tangent plane.
class UnfoldingEnergy {
public:
    UnfoldingEnergy(std::span<const Vec3> normals, std::span<const Index> vertices,
                    std::span<const Index> quads, const UnfoldingMeasure& measure,
                    const QuadMesh& mesh)
        : inflates_(measure.inflates), margin_(measure.margin)
    {
        for (const Index v : vertices) {
            const Vec3& normal = normals[mesh.points[v].face];
            int axis = 0;
            normal.cwiseAbs().minCoeff(&axis);
            const Vec3 across = normal.cross(Vec3::Unit(axis)).normalized();
            frames_.push_back({mesh.positions[v], across, normal.cross(across)});
        }
        double areas = 0;
        for (const Index q : quads) {
            Quad quad{};
            Vec3 up(0, 0, 0);
            for (std::size_t i = 0; i < 4; ++i) {
                const Index v = mesh.quads[q][i];
                const auto found = std::lower_bound(vertices.begin(), vertices.end(), v);
                quad.places[i] = found != vertices.end() && *found == v
                                     ? static_cast<Index>(found - vertices.begin())
                                     : kNone;
                quad.corners[i] = mesh.positions[v];
                up += normals[mesh.points[v].face];
            }
            const auto& c = quad.corners;
            const Vec3 normal = quad_normal(c, up, measure.least_cosine);
            quad.up = normal / std::max(normal.norm(), 1e-300);
            for (std::size_t i = 0; i < 4; ++i) {
                quad.size += (c[(i + 1) % 4] - c[i]).squaredNorm() / 4;
            }
            areas += (c[2] - c[0]).cross(c[3] - c[1]).norm() / 2;
            quads_.push_back(quad);
        }
        double least = 0;
        for (Quad& quad : quads_) {
            if (inflates_) {
                quad.size = areas / double(quads_.size());
            }
            quad.size = std::max(quad.size, 1e-300);
            for (std::size_t i = 0; i < 4; ++i) {
                const Vec3 a = quad.corners[(i + 1) % 4] - quad.corners[i];
                const Vec3 b = quad.corners[(i + 3) % 4] - quad.corners[i];
                const double d = a.cross(b).dot(quad.up);
                least = std::min(least, (d - margin_ * a.norm() * b.norm()) / quad.size);
            }
        }
        constexpr double kShare = 0.2;
        softness_ = std::max(measure.softness, -kShare * least);
    }

    std::size_t size() const { return 2 * frames_.size(); }

    Vec3 position(std::size_t vertex, const std::vector<double>& x) const
    {
        const Frame& frame = frames_[vertex];
        return frame.origin + x[2 * vertex] * frame.across + x[2 * vertex + 1] * frame.along;
    }

    double value(const std::vector<double>& x, std::vector<double>& gradient) const
    {
        gradient.assign(size(), 0);
        double sum = 0;
        for (const Quad& quad : quads_) {
            std::array<Vec3, 4> c = quad.corners;
            for (std::size_t i = 0; i < 4; ++i) {
                if (quad.places[i] != kNone) {
                    c[i] = position(quad.places[i], x);
                }
            }
            const double e = softness_ * quad.size;
            std::array<Vec3, 4> slopes{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
            for (std::size_t i = 0; i < 4; ++i) {
                const std::size_t next = (i + 1) % 4;
                const std::size_t previous = (i + 3) % 4;
                const Vec3 a = c[next] - c[i];
                const Vec3 b = c[previous] - c[i];
                const double d = a.cross(b).dot(quad.up);
                const double s = d - margin_ * a.norm() * b.norm();
                const double root = std::sqrt(s * s + e * e);
                // Without cancellation where s is negative.
                const double below = s > 0 ? s + root : e * e / (root - s);
                double squares = a.squaredNorm() + b.squaredNorm();
                if (inflates_) {
                    squares += d * d / quad.size + quad.size;
                }
                const double term = squares / below;
                sum += term;
                // The derivative of s + root is (s + root) / root.
                const double by_s = -term / root;
                const double by_d = by_s + (inflates_ ? 2 * d / quad.size / below : 0.0);
                Vec3 by_a = 2 / below * a + by_d * b.cross(quad.up);
                Vec3 by_b = 2 / below * b + by_d * quad.up.cross(a);
                if (margin_ > 0) {
                    const double ratio = b.norm() / std::max(a.norm(), 1e-300);
                    by_a -= by_s * margin_ * ratio * a;
                    by_b -= by_s * margin_ / std::max(ratio, 1e-300) * b;
                }
                slopes[next] += by_a;
                slopes[previous] += by_b;
                slopes[i] -= by_a + by_b;
            }
            for (std::size_t i = 0; i < 4; ++i) {
                if (const std::size_t place = quad.places[i]; place != kNone) {
                    gradient[2 * place] += slopes[i].dot(frames_[place].across);
                    gradient[2 * place + 1] += slopes[i].dot(frames_[place].along);
                }
            }
        }
        return sum;
    }

private:
    struct Frame {
        Vec3 origin;
        Vec3 across;
        Vec3 along;
    };
    struct Quad {
        std::array<Vec3, 4> corners;
        std::array<Index, 4> places;  // among the vertices that move, else kNone
        Vec3 up;
        double size;
    };

    bool inflates_;
    double margin_;
    std::vector<Frame> frames_;
    std::vector<Quad> quads_;
    double softness_ = 0;
};

double dot(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

void add(std::vector<double>& a, double factor, const std::vector<double>& b)
{
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i] += factor * b[i];
    }
}

/// Goes down from the origin by L-BFGS (Nocedal 1980).
std::vector<double> minimised(const UnfoldingEnergy& energy)
{
    constexpr int kIterations = 15;
    constexpr std::size_t kMemory = 8;
    constexpr int kHalvings = 25;
    struct Pair {
        std::vector<double> step;
        std::vector<double> change;
        double curvature;
    };
    std::vector<Pair> memory;
    std::vector<double> x(energy.size(), 0);
    std::vector<double> gradient;
    double value = energy.value(x, gradient);
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        std::vector<double> direction = gradient;
        std::vector<double> factors;
        for (std::size_t i = memory.size(); i-- > 0;) {
            factors.push_back(dot(memory[i].step, direction) / memory[i].curvature);
            add(direction, -factors.back(), memory[i].change);
        }
        if (!memory.empty()) {
            const Pair& last = memory.back();
            const double scale = last.curvature / dot(last.change, last.change);
            for (double& d : direction) {
                d *= scale;
            }
        }
        for (const Pair& pair : memory) {
            const double factor = dot(pair.change, direction) / pair.curvature;
            add(direction, factors.back() - factor, pair.step);
            factors.pop_back();
        }
        double slope = dot(direction, gradient);
        if (!(slope > 0)) {
            direction = gradient;
            slope = dot(gradient, gradient);
            memory.clear();
        }
        if (!(slope > 0)) {
            break;
        }
        // The first step, along the gradient alone, is to lower the energy by about a tenth.
        double step = memory.empty() ? 0.1 * value / slope : 1;
        bool is_lower = false;
        for (int halving = 0; halving < kHalvings && !is_lower; ++halving, step /= 2) {
            std::vector<double> next = x;
            add(next, -step, direction);
            std::vector<double> next_gradient;
            const double next_value = energy.value(next, next_gradient);
            if (!(next_value <= value - 1e-4 * step * slope)) {
                continue;
            }
            is_lower = true;
            Pair pair{next, next_gradient, 0};
            add(pair.step, -1, x);
            add(pair.change, -1, gradient);
            pair.curvature = dot(pair.step, pair.change);
            if (pair.curvature > 0) {
                if (memory.size() == kMemory) {
                    memory.erase(memory.begin());
                }
                memory.push_back(std::move(pair));
            }
            x = std::move(next);
            gradient = std::move(next_gradient);
            value = next_value;
        }
        if (!is_lower) {
            break;
        }
    }
    return x;
}

}  // namespace

void unfold_quads(const TriangleMesh& target, std::span<const Vec3> normals,
                  std::span<const Index> vertices, std::span<const Index> quads,
                  const UnfoldingMeasure& measure, QuadMesh& mesh)
{
    const UnfoldingEnergy energy(normals, vertices, quads, measure, mesh);
    const std::vector<double> x = minimised(energy);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Index v = vertices[i];
        mesh.points[v] = walk_to_nearest(target, mesh.points[v], energy.position(i, x));
        mesh.positions[v] = position_of(target, mesh.points[v]);
    }
}

}  // namespace layout_embedding
