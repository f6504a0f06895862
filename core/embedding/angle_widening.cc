#include "embedding/angle_widening.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace layout_embedding {

namespace {

constexpr int kMostRounds = 8;
constexpr int kMostPasses = 4;
/// Gaps are raised as if for angles this much larger, so that rounds end.
constexpr double kMargin = 1.02;

/// A strand that comes from a vertex and leaves the face there through the opposite edge.
struct FanStrand {
    Index vertex;
    Index face;
    double place;  // along the opposite halfedge of the face, which keeps the face on its left
    Index crossing;
};

/// All of them, sorted by vertex, face and place.
std::vector<FanStrand> fan_strands(const NormalForm& form)
{
    const TriangleMesh& mesh = form.mesh();
    std::vector<FanStrand> strands;
    for (Index strand = 0; strand < form.strand_count(); ++strand) {
        for (Index id = form.first(strand); id != kNone; id = form.element(id).next) {
            const NormalForm::Element& x = form.element(id);
            if (!x.is_crossing()) {
                continue;
            }
            for (const bool behind : {true, false}) {
                const NormalForm::Element& y = form.element(behind ? x.previous : x.next);
                if (y.is_crossing()) {
                    continue;
                }
                const Index h = behind ? x.halfedge : mesh.opposite(x.halfedge);
                const bool forward = mesh.halfedge(mesh.edge(h)) == h;
                strands.push_back({y.vertex, TriangleMesh::face_of(h),
                                   forward ? x.parameter : 1 - x.parameter, id});
            }
        }
    }
    std::sort(strands.begin(), strands.end(), [](const FanStrand& a, const FanStrand& b) {
        return a.vertex != b.vertex ? a.vertex < b.vertex
               : a.face != b.face   ? a.face < b.face
                                    : a.place < b.place;
    });
    return strands;
}

/// Calls visit(begin, end) for the strands that leave one vertex through one face.
template <typename Visit>
void for_each_fan(const std::vector<FanStrand>& strands, const Visit& visit)
{
    for (std::size_t begin = 0; begin < strands.size();) {
        std::size_t end = begin + 1;
        while (end < strands.size() && strands[end].vertex == strands[begin].vertex &&
               strands[end].face == strands[begin].face) {
            ++end;
        }
        visit(begin, end);
        begin = end;
    }
}

/// The halfedge of the face opposite to one of its vertices.
Index opposite_side(const TriangleMesh& mesh, Index face, Index vertex)
{
    Index h = 3 * face;
    while (mesh.tail(TriangleMesh::previous(h)) != vertex) {
        ++h;
    }
    return h;
}

class AngleWidening {
public:
    AngleWidening(NormalForm& form, const WantedAngles& angles, double spacing)
        : form_(form), mesh_(form.mesh()), angles_(angles), gaps_(spacing)
    {}

    void run(double most_length)
    {
        for (int round = 0; round < kMostRounds; ++round) {
            raised_ = false;
            raise_in_fans();
            raise_at_crossings();
            if (!raised_) {
                return;
            }
            NormalForm before = form_;
            keep_gaps(form_, gaps_);
            if (form_.total_length() > most_length) {
                form_ = std::move(before);
                return;
            }
        }
    }

private:
    /// Of a place on a halfedge, between 0 and 1.
    Vec3 position_on(Index h, double place) const
    {
        return (1 - place) * mesh_.position(mesh_.tail(h)) + place * mesh_.position(mesh_.head(h));
    }

    void raise_in_fans()
    {
        const std::vector<FanStrand> strands = fan_strands(form_);
        for_each_fan(strands, [&](std::size_t begin, std::size_t end) {
            const Index face = strands[begin].face;
            const Vec3& apex = mesh_.position(strands[begin].vertex);
            const Index h = opposite_side(mesh_, face, strands[begin].vertex);
            const double wanted = angles_.tangent_in(face);
            for (std::size_t i = begin; i <= end; ++i) {
                const double low = i == begin ? 0 : strands[i - 1].place;
                const double high = i == end ? 1 : strands[i].place;
                const double tangent =
                    tangent_between(position_on(h, low) - apex, position_on(h, high) - apex);
                if (tangent < wanted) {
                    const double width = kMargin * (high - low) * (wanted / tangent);
                    if (i == end) {
                        raise(strands[i - 1].crossing, h, false, width, true);
                    } else {
                        raise(strands[i].crossing, h, true, width, i == begin);
                    }
                }
            }
        });
    }

    /// Segments that cut off a corner of a face.
    void raise_at_crossings()
    {
        for (Index strand = 0; strand < form_.strand_count(); ++strand) {
            for (Index id = form_.first(strand); form_.element(id).next != kNone;
                 id = form_.element(id).next) {
                const Index next = form_.element(id).next;
                if (!form_.element(id).is_crossing() || !form_.element(next).is_crossing()) {
                    continue;
                }
                const Index h = mesh_.opposite(form_.element(id).halfedge);
                const Index g = form_.element(next).halfedge;
                const bool at_head = g == TriangleMesh::next(h);
                const Vec3& corner = mesh_.position(at_head ? mesh_.head(h) : mesh_.tail(h));
                const Vec3 p = form_.position(id);
                const Vec3 q = form_.position(next);
                const double wanted = angles_.tangent_in(TriangleMesh::face_of(h));
                widen(corner, q, p, wanted, id, h, !at_head);
                widen(corner, p, q, wanted, next, g, at_head);
            }
        }
    }

    /// Moves `crossing` at `moving` away from the corner if the angle at `fixed` is too small.
    void widen(const Vec3& corner, const Vec3& fixed, const Vec3& moving, double wanted,
               Index crossing, Index h, bool corner_at_tail)
    {
        if (!(tangent_between(corner - fixed, moving - fixed) < wanted)) {
            return;
        }
        // The law of sines in the triangle that is cut off.
        const Vec3 u = fixed - corner;
        const Vec3 v = moving - corner;
        const double size = u.norm() * v.norm();
        const double cosine = u.dot(v) / size;
        const double sine = u.cross(v).norm() / size;
        const double distance = u.norm() * wanted / (sine + cosine * wanted);
        const double length =
            (mesh_.position(mesh_.head(h)) - mesh_.position(mesh_.tail(h))).norm();
        if (distance > 0 && length > 0) {
            raise(crossing, h, corner_at_tail, kMargin * distance / length, true);
        }
    }

    /// Asks for `width` between a crossing and the tail of the halfedge, or else its head, or, if
    /// not `from_end`, the crossing beside it there.
    void raise(Index crossing, Index h, bool to_tail, double width, bool from_end)
    {
        const NormalForm::Element& x = form_.element(crossing);
        const bool low = to_tail == (mesh_.halfedge(mesh_.edge(h)) == h);
        const Index beside = low ? x.edge_previous : x.edge_next;
        if (from_end && beside != kNone) {
            const double parameter = form_.element(beside).parameter;
            width -= low ? parameter : 1 - parameter;
        }
        gaps_.raise(crossing, low, width);
        raised_ = true;
    }

    NormalForm& form_;
    const TriangleMesh& mesh_;
    const WantedAngles& angles_;
    CrossingGaps gaps_;
    bool raised_ = false;
};

class FanRelief {
public:
    FanRelief(NormalForm& form, VertexMoves& moves, const WantedAngles& angles)
        : form_(form),
          mesh_(form.mesh()),
          moves_(moves),
          angles_(angles),
          strands_(fan_strands(form))
    {}

    /// Whether a strand was moved.
    bool run()
    {
        for_each_fan(strands_, [&](std::size_t begin, std::size_t end) {
            counts_[{strands_[begin].vertex, strands_[begin].face}] = end - begin;
        });
        bool moved = false;
        for_each_fan(strands_, [&](std::size_t begin, std::size_t end) {
            for (const bool at_tail : {true, false}) {
                if (begin == end ||
                    !is_crowded(strands_[begin].vertex, strands_[begin].face, end - begin)) {
                    return;
                }
                if (move(strands_[at_tail ? begin : end - 1], at_tail)) {
                    moved = true;
                    (at_tail ? ++begin : --end);
                }
            }
        });
        return moved;
    }

private:
    /// Whether so many strands leave the vertex at less than the wanted angles, if they pass the
    /// opposite edge in equal distances.
    bool is_crowded(Index vertex, Index face, std::size_t count) const
    {
        const Index h = opposite_side(mesh_, face, vertex);
        const Vec3 tail = mesh_.position(mesh_.tail(h)) - mesh_.position(vertex);
        const Vec3 head = mesh_.position(mesh_.head(h)) - mesh_.position(vertex);
        const double part = 1 / (static_cast<double>(count) + 1);
        const double wanted = angles_.tangent_in(face);
        return tangent_between(tail, (1 - part) * tail + part * head) < wanted ||
               tangent_between(head, (1 - part) * head + part * tail) < wanted;
    }

    /// Puts the outermost strand of a fan on the tail (or head) of the opposite halfedge. Another
    /// strand that leaves along the edge there goes on into the next face, if that has room.
    bool move(const FanStrand& strand, bool at_tail)
    {
        // Others may have been moved since.
        const NormalForm::Element& x = form_.element(strand.crossing);
        if (!x.is_crossing() || (form_.element(x.previous).vertex != strand.vertex &&
                                 form_.element(x.next).vertex != strand.vertex)) {
            return false;
        }
        const Index h = opposite_side(mesh_, strand.face, strand.vertex);
        const Index corner = at_tail ? mesh_.tail(h) : mesh_.head(h);
        if (const Index other = moves_.carried(corner); other != kNone) {
            const NormalForm::Element& y = form_.element(other);
            const bool comes = form_.element(y.previous).vertex == strand.vertex;
            const Index beyond =
                mesh_.opposite(at_tail ? TriangleMesh::previous(h) : TriangleMesh::next(h));
            if ((!comes && form_.element(y.next).vertex != strand.vertex) || beyond == kNone) {
                return false;
            }
            const Index face = TriangleMesh::face_of(beyond);
            const auto found = counts_.find({strand.vertex, face});
            const std::size_t count = found == counts_.end() ? 0 : found->second;
            if (is_crowded(strand.vertex, face, count + 1) ||
                !moves_.push_off(other, comes != at_tail)) {
                return false;
            }
            counts_[{strand.vertex, face}] = count + 1;
        }
        return moves_.snap_to(strand.crossing, corner) != kNone;
    }

    NormalForm& form_;
    const TriangleMesh& mesh_;
    VertexMoves& moves_;
    const WantedAngles& angles_;
    std::vector<FanStrand> strands_;
    std::map<std::pair<Index, Index>, std::size_t> counts_;  // per vertex and face
};

}  // namespace

bool relieve_fans(NormalForm& form, VertexMoves& moves, const WantedAngles& angles)
{
    bool any = false;
    for (int pass = 0; pass < kMostPasses; ++pass) {
        if (!FanRelief(form, moves, angles).run()) {
            break;
        }
        any = true;
    }
    return any;
}

void widen_angles(NormalForm& form, const WantedAngles& angles, double spacing, double most_length)
{
    AngleWidening(form, angles, spacing).run(most_length);
}

void open_angles(NormalForm& form, const std::vector<Index>& landmarks, double spacing,
                 std::span<const double> edge_costs)
{
    const WantedAngles angles(form.mesh());
    VertexMoves moves(form, landmarks, edge_costs);
    relieve_fans(form, moves, angles);
    keep_gaps(form, CrossingGaps(spacing, &angles));
    widen_angles(form, angles, spacing, std::numeric_limits<double>::infinity());
    form.compact();
}

}  // namespace layout_embedding
