#include "embedding/face_cutting.hh"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace layout_embedding {

namespace {

constexpr Index kMaxPieceSize = 6;

/// Whether corner c ends side s.
bool touches(Index corner, Index side)
{
    return corner == side || corner == (side + 1) % 3;
}

/// Whether the partner of crossing i is consistent and the chord runs through the inside.
bool is_proper_chord(std::span<const PerimeterPoint> perimeter, Index i)
{
    const PerimeterPoint& a = perimeter[i];
    if (a.partner >= perimeter.size()) {
        return false;
    }
    const PerimeterPoint& b = perimeter[a.partner];
    return b.is_corner() ? !touches(b.side, a.side) : b.partner == i && b.side != a.side;
}

std::array<double, 3> barycentric(const PerimeterPoint& p)
{
    std::array<double, 3> b{};
    b[p.side] = 1 - p.parameter;
    b[(p.side + 1) % 3] = p.parameter;
    return b;
}

/// How bad the triangle is: its sum of cotangents but for a factor common to the whole face. Of all
/// triangulations of a convex polygon the Delaunay triangulation has the least sum (Musin 1997),
/// and the largest smallest angle. The area comes from barycentric coordinates, in which thin
/// triangles keep their exact sign.
double badness(const PerimeterPoint& a, const PerimeterPoint& b, const PerimeterPoint& c)
{
    const auto p = barycentric(a);
    const auto q = barycentric(b);
    const auto r = barycentric(c);
    const double area = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                        p[2] * (q[0] * r[1] - q[1] * r[0]);
    const double squares = (a.position - b.position).squaredNorm() +
                           (b.position - c.position).squaredNorm() +
                           (c.position - a.position).squaredNorm();
    return area > 0 ? squares / area : std::numeric_limits<double>::infinity();
}

}  // namespace

bool cut_face(std::span<const PerimeterPoint> perimeter, FacePieces& pieces)
{
    pieces.offsets.assign(1, 0);
    pieces.points.clear();
    const Index count = static_cast<Index>(perimeter.size());

    // Chords that end at corners 1 and 2 and come from an earlier crossing.
    std::array<Index, 3> closing{};
    for (Index i = 0; i < count; ++i) {
        if (perimeter[i].is_corner()) {
            continue;
        }
        if (!is_proper_chord(perimeter, i)) {
            return false;
        }
        const Index partner = perimeter[i].partner;
        if (perimeter[partner].is_corner() && partner > i) {
            ++closing[perimeter[partner].side];
        }
    }

    // The points passed so far that still see the rest of the perimeter. A chord from one of them
    // to the current point cuts off all points above it.
    std::vector<Index>& open = pieces.scratch;
    open.clear();
    for (Index i = 0; i < count; ++i) {
        const PerimeterPoint& point = perimeter[i];
        const Index chords = point.is_corner() ? closing[point.side] : point.partner < i ? 1 : 0;
        for (Index k = 0; k < chords; ++k) {
            // The piece is collected clockwise. The second chord at a corner cuts off a piece that
            // has the first one as a side.
            const auto begin = static_cast<std::ptrdiff_t>(pieces.points.size());
            pieces.points.push_back(i);
            if (k > 0) {
                pieces.points.push_back(open.back());
                open.pop_back();
            }
            const auto is_other_end = [&](Index j) {
                return point.is_corner() ? perimeter[j].partner == i : point.partner == j;
            };
            while (!open.empty() && !is_other_end(open.back())) {
                const PerimeterPoint& top = perimeter[open.back()];
                if (!top.is_corner() && top.partner > i) {
                    return false;  // Its own chord leaves this piece.
                }
                pieces.points.push_back(open.back());
                open.pop_back();
            }
            if (open.empty()) {
                return false;  // The other end was cut off before.
            }
            pieces.points.push_back(open.back());
            std::reverse(pieces.points.begin() + begin, pieces.points.end());
            pieces.offsets.push_back(static_cast<Index>(pieces.points.size()));
        }
        open.push_back(i);
    }
    pieces.points.insert(pieces.points.end(), open.begin(), open.end());
    pieces.offsets.push_back(static_cast<Index>(pieces.points.size()));
    return true;
}

void triangulate_piece(std::span<const PerimeterPoint> perimeter, std::span<const Index> piece,
                       std::vector<std::array<Index, 3>>& triangles)
{
    const Index size = static_cast<Index>(piece.size());
    if (size == 3) {
        triangles.push_back({piece[0], piece[1], piece[2]});
        return;
    }
    // Dynamic programming: the best triangulation of the polygon i, i+1, ..., j, and the third
    // corner of its triangle at side i j.
    std::array<std::array<double, kMaxPieceSize>, kMaxPieceSize> best{};
    std::array<std::array<Index, kMaxPieceSize>, kMaxPieceSize> apex{};
    for (Index length = 2; length < size; ++length) {
        for (Index i = 0; i + length < size; ++i) {
            const Index j = i + length;
            for (Index k = i + 1; k < j; ++k) {
                const double sum =
                    best[i][k] + best[k][j] +
                    badness(perimeter[piece[i]], perimeter[piece[k]], perimeter[piece[j]]);
                if (k == i + 1 || sum < best[i][j]) {
                    best[i][j] = sum;
                    apex[i][j] = k;
                }
            }
        }
    }
    const auto emit = [&](const auto& self, Index i, Index j) -> void {
        if (j - i < 2) {
            return;
        }
        const Index k = apex[i][j];
        triangles.push_back({piece[i], piece[k], piece[j]});
        self(self, i, k);
        self(self, k, j);
    };
    emit(emit, 0, size - 1);
}

}  // namespace layout_embedding
