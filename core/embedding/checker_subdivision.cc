#include "embedding/checker_subdivision.hh"

#include <algorithm>
#include <cmath>

namespace layout_embedding::checker {

namespace {

using Barycentric = std::array<double, 3>;

double sum(const Barycentric& b)
{
    return b[0] + b[1] + b[2];
}

/// Exact arithmetic on doubles as sums of doubles that do not overlap (Shewchuk, Adaptive Precision
/// Floating-Point Arithmetic, 1997; products split as Dekker does). Exact unless a product
/// underflows.
class Expansion {
public:
    void add_product(double a, double b, double c)
    {
        const auto [high, low] = product(a, b);
        const auto [high_high, high_low] = product(high, c);
        const auto [low_high, low_low] = product(low, c);
        add(low_low);
        add(low_high);
        add(high_low);
        add(high_high);
    }

    int sign() const
    {
        for (int i = size_ - 1; i >= 0; --i) {
            if (terms_[i] != 0) {
                return terms_[i] > 0 ? 1 : -1;
            }
        }
        return 0;
    }

private:
    struct Pair {
        double high;
        double low;
    };

    static Pair split(double a)
    {
        const double c = 134217729.0 * a;  // 2^27 + 1
        const double high = c - (c - a);
        return {high, a - high};
    }

    static Pair product(double a, double b)
    {
        const double p = a * b;
        const Pair x = split(a);
        const Pair y = split(b);
        return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
    }

    void add(double b)
    {
        double rest = b;
        for (int i = 0; i < size_; ++i) {
            const double a = terms_[i];
            const double total = rest + a;
            const double part = total - rest;
            terms_[i] = (rest - (total - part)) + (a - part);
            rest = total;
        }
        terms_[size_++] = rest;
    }

    std::array<double, 24> terms_{};  // six products of four terms each
    int size_ = 0;
};

double determinant(const std::array<Barycentric, 3>& m)
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
           m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// The sign of the determinant, exactly. Entries between 0 and a little over 1.
int orientation(const std::array<Barycentric, 3>& m)
{
    // Entries below 1.001 keep each of the six products below 1.01 and the rounding errors of all
    // below 30 units of 2^-53.
    const double approximate = determinant(m);
    if (std::abs(approximate) > 1e-14) {
        return approximate > 0 ? 1 : -1;
    }
    Expansion exact;
    exact.add_product(m[0][0], m[1][1], m[2][2]);
    exact.add_product(-m[0][0], m[1][2], m[2][1]);
    exact.add_product(m[0][1], m[1][2], m[2][0]);
    exact.add_product(-m[0][1], m[1][0], m[2][2]);
    exact.add_product(m[0][2], m[1][0], m[2][1]);
    exact.add_product(-m[0][2], m[1][1], m[2][0]);
    return exact.sign();
}

class SubdivisionCheck {
public:
    SubdivisionCheck(const PolygonMesh& target_mesh, const Surface& target,
                     const RefinedMesh& refined, Violations& violations, Surface& surface,
                     std::vector<Carrier>& carriers)
        : target_mesh_(target_mesh),
          target_(target),
          refined_(refined),
          violations_(violations),
          surface_(surface),
          carriers_(carriers)
    {}

    bool run()
    {
        if (!sizes_fit() || !ids_in_range() || !carriers_known()) {
            return false;
        }
        check_positions();
        std::vector<Index> offsets(refined_.triangle_faces.size() + 1);
        for (std::size_t t = 0; t < offsets.size(); ++t) {
            offsets[t] = static_cast<Index>(3 * t);
        }
        const bool manifold =
            build_surface(static_cast<Index>(refined_.positions.size()), offsets, refined_.corners,
                          "refinedNotSurface", "The refined mesh", violations_, surface_);
        if (check_triangles() && manifold) {
            check_edges();
            if (surface_.euler_characteristic() != target_.euler_characteristic() ||
                surface_.cap_count != target_.cap_count) {
                violations_.add("refinedTopology",
                                "The refined mesh has another Euler characteristic or another "
                                "number of holes than the target.");
            }
            return true;
        }
        return false;
    }

private:
    bool sizes_fit()
    {
        const std::size_t before = violations_.total();
        const std::size_t old_count = target_mesh_.positions.size();
        const std::size_t count = refined_.positions.size();
        const std::size_t triangles = refined_.corners.size() / 3;
        if (count < old_count || count >= kNone) {
            violations_.add("sizeMismatch",
                            "The refined mesh has fewer vertices than the target, or too many.");
        } else if (refined_.vertex_faces.size() != count - old_count ||
                   refined_.vertex_barycentrics.size() != count - old_count) {
            violations_.add("sizeMismatch", "The refined mesh has ",
                            static_cast<Index>(count - old_count),
                            " new vertices but not as many faces and coordinates for them.");
        }
        if (refined_.corners.size() % 3 != 0 || refined_.triangle_faces.size() != triangles ||
            refined_.triangle_patches.size() != triangles) {
            violations_.add("sizeMismatch",
                            "The refined mesh does not have three corners, one face and one patch "
                            "per triangle.");
        }
        return violations_.total() == before;
    }

    bool ids_in_range()
    {
        const std::size_t before = violations_.total();
        for (std::size_t c = 0; c < refined_.corners.size(); ++c) {
            if (refined_.corners[c] >= refined_.positions.size()) {
                violations_.add("indexOutOfRange", "Refined triangle ", static_cast<Index>(c / 3),
                                " names vertex ", refined_.corners[c], ", which does not exist.");
            }
        }
        for (std::size_t t = 0; t < refined_.triangle_faces.size(); ++t) {
            if (refined_.triangle_faces[t] >= target_.polygon_count) {
                violations_.add("indexOutOfRange", "Refined triangle ", static_cast<Index>(t),
                                " lies in target face ", refined_.triangle_faces[t],
                                ", which does not exist.");
            }
        }
        for (std::size_t k = 0; k < refined_.vertex_faces.size(); ++k) {
            if (refined_.vertex_faces[k] >= target_.polygon_count) {
                violations_.add("indexOutOfRange", "Refined vertex ",
                                static_cast<Index>(target_.vertex_count + k),
                                " lies in target face ", refined_.vertex_faces[k],
                                ", which does not exist.");
            }
        }
        return violations_.total() == before;
    }

    bool carriers_known()
    {
        const std::size_t before = violations_.total();
        carriers_.resize(refined_.positions.size());
        for (Index v = 0; v < target_.vertex_count; ++v) {
            carriers_[v] = {Carrier::Kind::vertex, v};
        }
        for (std::size_t k = 0; k < refined_.vertex_faces.size(); ++k) {
            const Index v = static_cast<Index>(target_.vertex_count + k);
            const Barycentric& b = refined_.vertex_barycentrics[k];
            // Written so that NaN fails.
            const auto fits = [](double x) { return x >= 0 && x <= 1 + kBarycentricSumTolerance; };
            if (!fits(b[0]) || !fits(b[1]) || !fits(b[2]) ||
                !(std::abs(sum(b) - 1) <= kBarycentricSumTolerance)) {
                violations_.add("barycentricOutOfRange", "The barycentric coordinates of vertex ",
                                v, " are negative, do not add up to 1 or are no numbers.");
                continue;
            }
            const Index face = refined_.vertex_faces[k];
            const int nonzeros = (b[0] > 0) + (b[1] > 0) + (b[2] > 0);
            if (nonzeros == 3) {
                carriers_[v] = {Carrier::Kind::face, face};
            } else if (nonzeros == 2) {
                const Index corner = b[2] == 0 ? 0 : b[0] == 0 ? 1 : 2;
                carriers_[v] = {Carrier::Kind::edge, target_.edge(3 * face + corner)};
            } else {
                violations_.add("newVertexOnVertex", "The new vertex ", v,
                                " lies on a corner of target face ", face, ".");
            }
        }
        return violations_.total() == before;
    }

    void check_positions()
    {
        Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
        Vec3 high = -low;
        for (const Vec3& p : target_mesh_.positions) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
        const double tolerance = kPositionTolerance * (high - low).norm() + kRounding * largest;
        for (Index v = 0; v < refined_.positions.size(); ++v) {
            const Vec3& p = refined_.positions[v];
            if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
                violations_.add("nonFinitePosition", "The position of refined vertex ", v,
                                " is not finite.");
            } else if (v < target_.vertex_count) {
                if (p != target_mesh_.positions[v]) {
                    violations_.add("inputVertexMoved", "Refined vertex ", v,
                                    " is not where target vertex ", v, " is.");
                }
            } else {
                const Index k = v - target_.vertex_count;
                const Index* corners = target_mesh_.corners.data() + 3 * refined_.vertex_faces[k];
                const Barycentric& b = refined_.vertex_barycentrics[k];
                const Vec3 expected = b[0] * target_mesh_.positions[corners[0]] +
                                      b[1] * target_mesh_.positions[corners[1]] +
                                      b[2] * target_mesh_.positions[corners[2]];
                if (!((p - expected).norm() <= tolerance)) {
                    violations_.add("vertexMisplaced", "Refined vertex ", v,
                                    " is not where its coordinates in target face ",
                                    refined_.vertex_faces[k], " say.");
                }
            }
        }
    }

    /// The coordinates of a refined vertex in a target face; false if it is not in the closed face.
    bool coordinates(Index vertex, Index face, Barycentric& b) const
    {
        b = {0, 0, 0};
        const Carrier& carrier = carriers_[vertex];
        if (carrier.kind == Carrier::Kind::vertex) {
            for (Index i = 0; i < 3; ++i) {
                if (target_.tails[3 * face + i] == carrier.id) {
                    b[i] = 1;
                    return true;
                }
            }
            return false;
        }
        const Index k = vertex - target_.vertex_count;
        const Barycentric& own = refined_.vertex_barycentrics[k];
        if (refined_.vertex_faces[k] == face) {
            b = own;
            return true;
        }
        if (carrier.kind == Carrier::Kind::face) {
            return false;
        }
        // On an edge of its face: seen from the other side, with its two coordinates swapped.
        const Index edge = carrier.id;
        const Index here = target_.faces[edge] == face ? edge : target_.twins[edge];
        if (target_.faces[here] != face) {
            return false;
        }
        const Index there = target_.twins[here] % 3;
        b[here % 3] = own[(there + 1) % 3];
        b[(here + 1) % 3] = own[there];
        return true;
    }

    bool check_triangles()
    {
        const Index triangles = static_cast<Index>(refined_.triangle_faces.size());
        bool contained = true;
        std::vector<double> areas(target_.polygon_count, 0.0);
        masks_.assign(refined_.corners.size(), 0);
        for (Index t = 0; t < triangles; ++t) {
            const Index face = refined_.triangle_faces[t];
            std::array<Barycentric, 3> points;
            bool inside = true;
            for (Index i = 0; i < 3; ++i) {
                const Index v = refined_.corners[3 * t + i];
                if (!coordinates(v, face, points[i])) {
                    violations_.add("triangleOutsideFace", "Refined triangle ", t,
                                    " is said to lie in target face ", face, ", but its corner ", v,
                                    " does not.");
                    inside = false;
                }
                masks_[3 * t + i] = static_cast<std::uint8_t>(
                    (points[i][0] > 0) | (points[i][1] > 0) << 1 | (points[i][2] > 0) << 2);
            }
            if (!inside) {
                contained = false;
                continue;
            }
            const int sign = orientation(points);
            if (sign < 0) {
                violations_.add("triangleFlipped", "Refined triangle ", t,
                                " is turned over in target face ", face, ".");
            } else if (sign == 0) {
                violations_.add("triangleDegenerate", "Refined triangle ", t,
                                " has no area in target face ", face, ".");
            }
            areas[face] += determinant(points) / (sum(points[0]) * sum(points[1]) * sum(points[2]));
        }
        for (Index f = 0; f < target_.polygon_count && contained; ++f) {
            if (!(std::abs(areas[f] - 1) <= kAreaTolerance)) {
                violations_.add("areaMismatch", "The refined triangles in target face ", f,
                                " do not cover it exactly once.");
            }
        }
        return contained;
    }

    void check_edges()
    {
        for (Index h = 0; h < surface_.corner_count; ++h) {
            const Index twin = surface_.twins[h];
            const Index face = refined_.triangle_faces[h / 3];
            const Index other =
                twin < surface_.corner_count ? refined_.triangle_faces[twin / 3] : kNone;
            if (face == other) {
                continue;
            }
            // The edge has to lie in the edge of `face` that leads to `other` or to a hole.
            const int mask = masks_[h] | masks_[surface_.nexts[h]];
            const Index corner = mask == 3 ? 0 : mask == 6 ? 1 : mask == 5 ? 2 : kNone;
            Index beyond = face;
            if (corner != kNone) {
                beyond = target_.faces[target_.twins[3 * face + corner]];
                if (target_.is_cap(beyond)) {
                    beyond = kNone;
                }
            }
            if (beyond == other) {
                continue;
            }
            const Index tail = surface_.tails[h];
            if (other == kNone) {
                violations_.add("boundaryMismatch", "The boundary edge ", tail, "-",
                                surface_.head(h),
                                " of the refined mesh is not on the boundary of the target.");
            } else {
                violations_.add("trianglesTorn", "The refined edge ", tail, "-", surface_.head(h),
                                " joins triangles in the target faces ", face, " and ", other,
                                " without lying between these.");
            }
        }
    }

    const PolygonMesh& target_mesh_;
    const Surface& target_;
    const RefinedMesh& refined_;
    Violations& violations_;
    Surface& surface_;
    std::vector<Carrier>& carriers_;
    /// Per corner of a refined triangle: which coordinates in the triangle's face are not zero.
    std::vector<std::uint8_t> masks_;
};

}  // namespace

bool check_subdivision(const PolygonMesh& target_mesh, const Surface& target,
                       const RefinedMesh& refined, Violations& violations, Surface& surface,
                       std::vector<Carrier>& carriers)
{
    return SubdivisionCheck(target_mesh, target, refined, violations, surface, carriers).run();
}

}  // namespace layout_embedding::checker
