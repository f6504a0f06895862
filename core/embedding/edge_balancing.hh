#pragma once

#include <vector>

#include "embedding/crossing_room.hh"
#include "embedding/isotonic.hh"
#include "embedding/normal_form.hh"

namespace layout_embedding {

/// Moves all crossings of one edge together, which is what strands need that press against each
/// other: pulled tight one by one, none could move.
class EdgeBalancing {
public:
    /// One projected Newton step for the summed length of the segments at the crossings of an edge,
    /// under the `gaps`, which hold before and after: the second-order model is
    /// separable and its optimum a weighted isotonic regression. Shortened until the length
    /// decreases. Returns the decrease. O(crossings).
    double balance(NormalForm& form, Index edge, const CrossingGaps& gaps);

private:
    struct Crossing {
        Index id;
        Vec3 before;
        Vec3 after;
    };
    double length_at(const Vec3& tail, const Vec3& along, const std::vector<double>& places) const;

    IsotonicRegression regression_;
    std::vector<Crossing> crossings_;
    std::vector<double> places_;
    std::vector<double> goals_;
    std::vector<double> weights_;
    std::vector<double> tried_;
    std::vector<double> widths_;
};

}  // namespace layout_embedding
