#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shapes/remeshing.hh"
#include "shapes/solid.hh"

namespace layout_embedding::shapes {

/// A landmark by construction: where the ray from a point inside first leaves the solid.
struct LandmarkRay {
    std::string name;
    Vec3 inside;
    Vec3 direction;
    /// The ray runs in the cut plane, so that the landmark lies on the rim.
    bool on_boundary = false;
};

/// What a class builds for one of its members: everything but the triangles.
struct Figure {
    Solid solid;
    std::vector<LandmarkRay> landmarks;
    std::optional<CutPlane> cut;
    /// Details of at least this size are seen when the surface is first sampled: at most the
    /// thinnest part and the narrowest gap. 0: one hundredth of the size.
    double detail = 0.0;

    void landmark(std::string name, const Vec3& inside, const Vec3& direction)
    {
        landmarks.push_back({std::move(name), inside, direction, false});
    }
    void landmark_on_rim(std::string name, const Vec3& inside, const Vec3& direction)
    {
        landmarks.push_back({std::move(name), inside, direction, true});
    }
};

/// "left_" for the side of positive x, else "right_".
inline std::string side_name(double side, const char* name)
{
    return (side > 0.0 ? "left_" : "right_") + std::string(name);
}

}  // namespace layout_embedding::shapes
