#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "mesh/polygon_mesh.hh"
#include "shapes/figure.hh"

namespace layout_embedding::shapes {

/// Shapes of one kind with corresponding landmarks, for example hands in many poses.
struct ShapeClass {
    /// For file names: lower case, words joined by "_".
    std::string name;
    std::string title;
    /// Of the surface without its boundary filled: handles, and loops of the boundary (0 or 1).
    int genus;
    int boundary_loops;
    /// Each with a name of its own.
    std::vector<std::string> members;
    Figure (*build)(Index member);

    Index member_count() const { return static_cast<Index>(members.size()); }
    /// 2 - 2 genus - boundary loops.
    long euler_characteristic() const { return 2 - 2 * genus - boundary_loops; }
};

/// All classes, in the order of a gallery. At least ten are closed and of genus 0.
const std::vector<ShapeClass>& shape_classes();

/// The class of this name, or nothing.
const ShapeClass* find_shape_class(const std::string& name);

struct ShapeOptions {
    /// About how many vertices, 500 to 200 000; 0 for the member's own number, 2 to 50 thousand.
    Index vertices = 0;
    /// Another seed is another triangulation and other noise of the same shape.
    std::uint64_t seed = 0;
};

/// A triangle mesh with its landmarks.
struct Shape {
    PolygonMesh mesh;
    /// Vertex ids, all different; landmark i has the same meaning throughout a class.
    std::vector<Index> landmarks;
    std::vector<std::string> landmark_names;
};

/// Member `member` of a class. Figures are about one to three units large, stand upright along y
/// and look along z, with their left side at positive x. Deterministic, and the same on every
/// platform with IEEE arithmetic. The topology is confirmed to be that of the class, and the mesh
/// passes check_surface() as a target.
///
/// Errors: invalidOption (no such member, or number of vertices out of range); internal (the
/// figure does not have the topology of its class or a landmark does not meet its surface: a
/// defect of the figure). About a second for 10 000 vertices.
Result<Shape> make_shape(const ShapeClass& shape_class, Index member,
                         const ShapeOptions& options = {});

/// The number of vertices that a member has if nothing else is asked for.
Index default_vertex_count(const ShapeClass& shape_class, Index member);

}  // namespace layout_embedding::shapes
