#pragma once

#include <string>

#include "base/result.hh"
#include "base/types.hh"
#include "embedding/refined_mesh.hh"

namespace layout_embedding {

/// From where a picture is taken, without perspective.
struct View {
    /// From the surface towards the eye; any length.
    Vec3 direction{0, 0, 1};
    /// What is up in the picture.
    Vec3 up{0, 1, 0};
    /// Of the picture, in pixels; the height follows from the shape.
    double width = 800;
};

/// A picture of `refined` as SVG: patches in their colours, shaded, and the paths as lines, all in
/// the order of their depth, what is turned away left out. Errors: invalidOption (a view without
/// direction, or a width that is no positive number).
Result<std::string> write_refined_svg(const RefinedMesh& refined, const View& view = {});

}  // namespace layout_embedding
