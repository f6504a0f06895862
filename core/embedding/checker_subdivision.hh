#pragma once

#include <vector>

#include "embedding/checker_surface.hh"

namespace layout_embedding::checker {

/// The smallest element of the target that holds a point.
struct Carrier {
    enum class Kind : std::uint8_t { vertex, edge, face };
    Kind kind = Kind::vertex;
    /// The vertex, the edge as Surface::edge() of the target, or the face.
    Index id = kNone;
};

/// Confirms that `refined` is a subdivision of the target and fills the connectivity `surface` of
/// it and the carrier of each of its vertices. False if one of these two could not be made.
///
/// The argument: let every refined triangle be mapped linearly into the plane of its target face,
/// by the coordinates of its corners there. Triangles on two sides of an edge agree on it if they
/// lie in one face or the edge lies in an edge of the target that joins their faces; this is tested
/// on the zeros of the coordinates alone. The orientation of each image is tested in exact
/// arithmetic. Then the map is continuous, it takes boundary to boundary, and it covers every point
/// in general position of a face equally often, at least once; the areas say: once. So it is one to
/// one, and no fold or overlap is left.
bool check_subdivision(const PolygonMesh& target_mesh, const Surface& target,
                       const RefinedMesh& refined, Violations& violations, Surface& surface,
                       std::vector<Carrier>& carriers);

}  // namespace layout_embedding::checker
