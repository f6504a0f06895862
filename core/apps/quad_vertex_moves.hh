#pragma once

#include "apps/movable_quads.hh"

namespace layout_embedding {

/// The least scaled Jacobian of vertices that look around.
inline constexpr double kBadQuality = 0.1;

/// What a step that lowers the distortion must not do.
struct StepRule {
    /// Flip more of the quads around.
    bool may_flip = false;
    /// Leave more of them with a scaled Jacobian up to this.
    double flat = 0;
    /// Make the worst of them worse, where it is not above this.
    double floor = 0;
    /// What the distortion is measured with (MovableQuads::distortion()).
    double least_cosine = 0;
};

/// Moves v towards the mean of its neighbours, where the smallest scaled Jacobian of the quads
/// around stays above 0.5 or grows; how far, in lengths of the edges around it.
double move_to_mean(MovableQuads& quads, Index v);

/// Moves v by a Newton step in the tangent plane, cut back until it lowers the distortion and keeps
/// to the rule. Returns by which share it lowered the distortion.
double lower_distortion(MovableQuads& quads, Index v, const StepRule& rule = {});

/// Moves v to a place around where the worst of its quads is better, flipping no more of them;
/// whether it is by more than a thousandth.
bool look_around(MovableQuads& quads, Index v);

}  // namespace layout_embedding
