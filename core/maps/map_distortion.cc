#include "maps/map_distortion.hh"

#include <algorithm>
#include <cmath>
#include <limits>

namespace layout_embedding {
namespace {

/// Triangles without area on a target are given this much of the longest edge as height.
constexpr double kLeastHeight = 1e-12;

}  // namespace

Matrix2 to_domain_map(const Vec3& a, const Vec3& b, const Vec3& c, const PlanePoint& u,
                      const PlanePoint& v, const PlanePoint& w)
{
    const Vec3 first = b - a;
    const Vec3 second = c - a;
    const double size = std::max({first.norm(), second.norm(), (c - b).norm(), 1e-300});
    const double width = std::max(first.norm(), kLeastHeight * size);
    const double along = second.dot(first) / width;
    const double height = std::max(first.cross(second).norm() / width, kLeastHeight * size);
    // [v-u, w-u] times the inverse of [(width, 0), (along, height)].
    const PlanePoint p = v - u;
    const PlanePoint q = w - u;
    Matrix2 map;
    map.col(0) = p / width;
    map.col(1) = (q - along / width * p) / height;
    return map;
}

double patch_energy(const PlacedPatch& a, const std::vector<Vec3>& positions_a,
                    const PlacedPatch& b, const std::vector<Vec3>& positions_b, double scale)
{
    const auto map_of = [](const PlacedPatch& placed, const std::vector<Vec3>& x, Index triangle) {
        const auto& c = placed.map.corners[triangle];
        const std::vector<PlanePoint>& p = placed.map.points;
        return to_domain_map(x[c[0]], x[c[1]], x[c[2]], p[c[0]], p[c[1]], p[c[2]]);
    };
    const std::vector<OverlayPiece> pieces = overlay_pieces(a, b);
    double sum = pieces.empty() ? std::numeric_limits<double>::infinity() : 0;
    for (const OverlayPiece& piece : pieces) {
        const Matrix2 from = map_of(a, positions_a, piece.map_triangles[0]);
        const Matrix2 jacobian = map_of(b, positions_b, piece.map_triangles[1]).inverse() * from;
        const double determinant = scale * jacobian.determinant();
        sum += std::max(piece.domain_area, 0.0) / from.determinant() * scale *
               jacobian.squaredNorm() * (1 + 1 / (determinant * determinant));
    }
    return sum;
}

MapDistortion map_distortion(const PlacedTarget& a, const PlacedTarget& b, const Overlay& overlay)
{
    const std::array<const PlacedTarget*, 2> targets{&a, &b};
    std::array<std::vector<std::vector<Vec3>>, 2> positions;
    for (std::size_t side = 0; side < 2; ++side) {
        for (Index face = 0; face < targets[side]->patches().size(); ++face) {
            positions[side].push_back(targets[side]->positions(face));
        }
    }
    std::array<double, 2> total{0, 0};
    struct Piece {
        double area;
        Matrix2 jacobian;
    };
    std::vector<Piece> pieces;
    for (std::size_t t = 0; t < overlay.corners.size(); ++t) {
        const Index face = overlay.layout_faces[t];
        std::array<Matrix2, 2> maps;
        for (std::size_t side = 0; side < 2; ++side) {
            const Parametrisation& map = targets[side]->patches()[face].map;
            const auto& c = map.corners[overlay.map_triangles[t][side]];
            const std::vector<Vec3>& x = positions[side][face];
            maps[side] = to_domain_map(x[c[0]], x[c[1]], x[c[2]], map.points[c[0]],
                                       map.points[c[1]], map.points[c[2]]);
        }
        const double area = std::max(overlay.domain_areas[t], 0.0);
        const std::array<double, 2> areas{area / maps[0].determinant(),
                                          area / maps[1].determinant()};
        total[0] += areas[0];
        total[1] += areas[1];
        pieces.push_back({areas[0], maps[1].inverse() * maps[0]});
    }
    MapDistortion result;
    const double scale = std::sqrt(total[0] / total[1]);
    for (const Piece& piece : pieces) {
        const double squares = piece.jacobian.squaredNorm() * scale * scale;
        const double determinant = piece.jacobian.determinant() * scale * scale;
        const double energy = squares * (1 + 1 / (determinant * determinant));
        // The singular values have this sum of squares and this product.
        const double half = squares / (2 * determinant);
        const double conformal = half + std::sqrt(std::max(half * half - 1, 0.0));
        const double weight = piece.area / total[0];
        result.mean_energy += weight * energy;
        result.mean_conformal += weight * conformal;
        result.mean_area += weight * std::max(determinant, 1 / determinant);
        if (piece.area > 0) {
            result.largest_energy = std::max(result.largest_energy, energy);
        }
    }
    return result;
}

}  // namespace layout_embedding
