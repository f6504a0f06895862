#include "layout/quad_pairing.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mesh/polygon_halfedges.hh"

namespace layout_embedding {
namespace {

/// Cosines of the sharpest angle and of the sharpest bend that a quad may have.
constexpr double kMostCosine = 0.9;
constexpr double kLeastBend = 0.35;
/// Scores are integers, so that sums are exact.
constexpr double kScoreUnit = 1 << 20;

Vec3 unit(const Vec3& vector)
{
    const double length = std::sqrt(vector.dot(vector));
    return length > 0 ? Vec3(vector / length) : Vec3(Vec3::Zero());
}

/// How good the quad a, b, c, d is that the edge from a to c divides; 0 for none at all.
std::int64_t quad_score(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
    const Vec3 first = unit((b - a).cross(c - a));
    const Vec3 second = unit((c - a).cross(d - a));
    const double bend = first.dot(second);
    if (!(bend > kLeastBend)) {
        return 0;
    }
    const Vec3 up = first + second;
    const std::array<Vec3, 4> sides{unit(b - a), unit(c - b), unit(d - c), unit(a - d)};
    double worst = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3& in = sides[i];
        const Vec3& out = sides[(i + 1) % 4];
        if (!(in.cross(out).dot(up) > 0)) {
            return 0;
        }
        worst = std::max(worst, std::abs(in.dot(out)));
    }
    return worst < kMostCosine ? static_cast<std::int64_t>(kScoreUnit * (1 - worst) * bend) : 0;
}

class QuadPairing {
public:
    explicit QuadPairing(const PolygonMesh& mesh)
        : mesh_(mesh),
          halfedges_(mesh),
          partners_(mesh.face_count(), kNone),
          spare_edges_(mesh.vertex_count(), -3),
          scores_(halfedges_.count(), 0)
    {
        for (Index h = 0; h < halfedges_.count(); ++h) {
            ++spare_edges_[halfedges_.tail(h)];
            const Index twin = halfedges_.opposite(h);
            if (twin == kNone) {
                // Boundary vertices may keep two edges, and have one more than corners.
                spare_edges_[halfedges_.tail(h)] += 1;
                spare_edges_[halfedges_.head(h)] += 1;
            } else if (h < twin) {
                const auto point = [&](Index g) { return mesh_.positions[halfedges_.tail(g)]; };
                scores_[h] = quad_score(point(h), point(halfedges_.previous(twin)), point(twin),
                                        point(halfedges_.previous(h)));
                scores_[twin] = scores_[h];
            }
        }
    }

    PolygonMesh run()
    {
        std::vector<Index> order;
        for (Index h = 0; h < halfedges_.count(); ++h) {
            if (scores_[h] > 0 && h < halfedges_.opposite(h)) {
                order.push_back(h);
            }
        }
        std::sort(order.begin(), order.end(), [&](Index a, Index b) {
            return scores_[a] != scores_[b] ? scores_[a] > scores_[b] : a < b;
        });
        for (const Index h : order) {
            if (is_free(h)) {
                join(h);
            }
        }
        for (bool improved = true; improved;) {
            improved = false;
            for (const Index h : order) {
                improved = exchange(h) || improved;
            }
        }
        return merged();
    }

private:
    /// Whether the two triangles at h can become a quad.
    bool is_free(Index h) const
    {
        return partners_[halfedges_.face(h)] == kNone &&
               partners_[halfedges_.face(halfedges_.opposite(h))] == kNone &&
               spare_edges_[halfedges_.tail(h)] > 0 && spare_edges_[halfedges_.head(h)] > 0;
    }

    void join(Index h)
    {
        const Index twin = halfedges_.opposite(h);
        partners_[halfedges_.face(h)] = h;
        partners_[halfedges_.face(twin)] = twin;
        --spare_edges_[halfedges_.tail(h)];
        --spare_edges_[halfedges_.head(h)];
    }

    void part(Index h)
    {
        partners_[halfedges_.face(h)] = kNone;
        partners_[halfedges_.face(halfedges_.opposite(h))] = kNone;
        ++spare_edges_[halfedges_.tail(h)];
        ++spare_edges_[halfedges_.head(h)];
    }

    /// The best edge that joins the triangle to a free one, kNone if there is none.
    Index best_free(Index face) const
    {
        Index best = kNone;
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (scores_[h] > 0 && is_free(h) && (best == kNone || scores_[h] > scores_[best])) {
                best = h;
            }
        }
        return best;
    }

    /// Makes a quad at h instead of those that its triangles are in, whose other triangles find
    /// new partners; takes it back unless the sum of the scores rises.
    bool exchange(Index h)
    {
        const std::array<Index, 2> faces{halfedges_.face(h),
                                         halfedges_.face(halfedges_.opposite(h))};
        if (partners_[faces[0]] == h) {
            return false;
        }
        std::int64_t gain = scores_[h];
        std::vector<Index> parted;
        std::vector<Index> joined;
        for (const Index f : faces) {
            if (partners_[f] != kNone) {
                parted.push_back(partners_[f]);
                gain -= scores_[partners_[f]];
                part(partners_[f]);
            }
        }
        if (is_free(h)) {
            join(h);
            joined.push_back(h);
            for (const Index old : parted) {
                const Index next = best_free(halfedges_.face(halfedges_.opposite(old)));
                if (next != kNone) {
                    join(next);
                    joined.push_back(next);
                    gain += scores_[next];
                }
            }
            if (gain > 0) {
                return true;
            }
        }
        for (const Index g : joined) {
            part(g);
        }
        for (const Index g : parted) {
            join(g);
        }
        return false;
    }

    PolygonMesh merged() const
    {
        PolygonMesh result;
        result.positions = mesh_.positions;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const Index h = partners_[f];
            if (h == kNone) {
                result.add_face(mesh_.face(f));
                continue;
            }
            const Index twin = halfedges_.opposite(h);
            if (f < halfedges_.face(twin)) {
                const std::array<Index, 4> corners{
                    halfedges_.tail(h), halfedges_.tail(halfedges_.previous(twin)),
                    halfedges_.tail(twin), halfedges_.tail(halfedges_.previous(h))};
                result.add_face(corners);
            }
        }
        return result;
    }

    const PolygonMesh& mesh_;
    PolygonHalfedges halfedges_;
    /// Per triangle: its halfedge that goes, kNone if it stays a triangle.
    std::vector<Index> partners_;
    /// Per vertex: edges it can lose.
    std::vector<std::int64_t> spare_edges_;
    /// Per halfedge: that of the quad without it.
    std::vector<std::int64_t> scores_;
};

}  // namespace

PolygonMesh merged_into_quads(const PolygonMesh& triangles)
{
    return QuadPairing(triangles).run();
}

}  // namespace layout_embedding
