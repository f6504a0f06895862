#include "patches/patch_union.hh"

namespace layout_embedding {
namespace {

/// Begin and end of a side among the boundary vertices of a patch; the end may be vertex 0 of the
/// next turn.
struct Side {
    Index begin;
    Index end;
};

Side side_of(const Patch& patch, Index side)
{
    return {patch.sides[side], patch.sides[side + 1]};
}

class PatchUnion {
public:
    PatchUnion(const Patch& left, Index left_side, const Patch& right, Index right_side)
        : left_(left),
          right_(right),
          of_left_(left.vertices.size(), kNone),
          of_right_(right.vertices.size(), kNone),
          left_side_(left_side),
          right_side_(right_side)
    {}

    Patch run()
    {
        add_boundary(left_, left_side_, of_left_);
        add_boundary(right_, right_side_, of_right_);
        patch_.sides.push_back(static_cast<Index>(patch_.vertices.size()));
        // The chain is an inner one now. Its ends are there already: the corners where the other
        // sides of one patch end are those where the other patch's begin.
        const Side chain = side_of(left_, left_side_);
        const Side back = side_of(right_, right_side_);
        const Index last = left_.boundary_size();
        of_left_[chain.begin] = of_right_[back.end % right_.boundary_size()];
        of_right_[back.begin] = of_left_[chain.end % last];
        for (Index i = 1; chain.begin + i < chain.end; ++i) {
            const Index id = add_vertex(left_.vertices[chain.begin + i]);
            of_left_[chain.begin + i] = id;
            of_right_[back.end - i] = id;
        }
        add_triangles(left_, of_left_);
        add_triangles(right_, of_right_);
        return std::move(patch_);
    }

private:
    Index add_vertex(Index refined)
    {
        patch_.vertices.push_back(refined);
        return static_cast<Index>(patch_.vertices.size() - 1);
    }

    /// The sides of a patch behind one of them, each without its end.
    void add_boundary(const Patch& patch, Index skipped, std::vector<Index>& ids)
    {
        for (Index k = 1; k < patch.side_count(); ++k) {
            const Side side = side_of(patch, (skipped + k) % patch.side_count());
            patch_.sides.push_back(static_cast<Index>(patch_.vertices.size()));
            for (Index v = side.begin; v < side.end; ++v) {
                ids[v] = add_vertex(patch.vertices[v]);
            }
        }
    }

    void add_triangles(const Patch& patch, std::vector<Index>& ids)
    {
        for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
            std::array<Index, 3> corners{};
            for (std::size_t i = 0; i < 3; ++i) {
                Index& id = ids[patch.corners[t][i]];
                if (id == kNone) {
                    id = add_vertex(patch.vertices[patch.corners[t][i]]);
                }
                corners[i] = id;
            }
            patch_.triangles.push_back(patch.triangles[t]);
            patch_.corners.push_back(corners);
        }
    }

    const Patch& left_;
    const Patch& right_;
    std::vector<Index> of_left_;
    std::vector<Index> of_right_;
    Index left_side_;
    Index right_side_;
    Patch patch_;
};

}  // namespace

Patch united(const Patch& left, Index left_side, const Patch& right, Index right_side)
{
    return PatchUnion(left, left_side, right, right_side).run();
}

}  // namespace layout_embedding
