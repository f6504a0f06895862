#pragma once

#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Merges pairs of neighbouring triangles into quads where these are well-shaped: convex, with
/// angles between 26 and 154 degrees, bent by less than 70 degrees along the edge that goes. The
/// sum of the quads' qualities (their worst angle, times the cosine of the bend) is locally
/// greatest: no exchange of one quad for its neighbours improves it. Inner vertices keep at least
/// three edges.
///
/// `triangles` must be a layout (layout/layout.hh) of triangles; the result is one, too, with the
/// same vertices. Faces keep the order of their first triangles. O(#F log #F) for the start and a
/// small number of rounds.
PolygonMesh merged_into_quads(const PolygonMesh& triangles);

}  // namespace layout_embedding
