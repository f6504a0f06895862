#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"

namespace layout_embedding {

/// Landmarks as other programs give them: points in space, with names.
struct LandmarkPoints {
    std::vector<Vec3> points;
    /// Per point; may be empty.
    std::vector<std::string> names;
    /// Whether x and y may have to change their sign, as between the two conventions of medical
    /// images (LPS and RAS).
    bool may_be_mirrored = false;
};

/// Reads picked points of MeshLab (.pp, XML): the attributes x, y, z and name of each `point` that
/// is not inactive. Errors: syntaxError, with the line.
Result<LandmarkPoints> read_picked_points(std::string_view bytes, std::string_view subject);

struct PlacedLandmarks {
    std::vector<Index> vertices;
    std::vector<std::string> notes;
};

/// Per point, in turn, the nearest vertex that no point before it took. Points farther from it than
/// 5 % of the target's size are noted. Where x and y may have to change sign, what lies nearer to
/// the target as a whole counts. Errors: landmarkNeedsTarget (no positions), landmarkCount (more
/// points than vertices), nonFinitePosition.
Result<PlacedLandmarks> place_landmarks(const LandmarkPoints& points,
                                        std::span<const Vec3> positions, std::string_view subject);

}  // namespace layout_embedding
