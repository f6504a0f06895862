#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/types.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// What an OBJ file can hold beside positions and faces.
struct ObjExtras {
    /// Per face the number of its group; empty for no groups. kNone: outside all of them.
    std::span<const Index> face_groups;
    /// Group n is called <group_prefix>n.
    std::string group_prefix = "group_";
    /// Chains of vertex ids, written as `l` lines in a group of their own, "layout_edges".
    std::span<const std::vector<Index>> chains;
    /// Of the mesh, or null: `vt` lines, colours behind the positions of vertices (the first of
    /// several; their opacity is left out), groups as further ones of the face, materials.
    const MeshAttributes* attributes = nullptr;
};

/// `mesh` as Wavefront OBJ. Vertices and faces keep their order (a group is opened again wherever
/// the next face belongs to it), and positions the shortest digits that read_obj() turns back into
/// the same doubles. The same bytes on every platform.
std::string write_obj(const PolygonMesh& mesh, const ObjExtras& extras = {});

/// `mesh` as ASCII OFF, with the same digits.
std::string write_off(const PolygonMesh& mesh);

/// `mesh` as binary PLY (little-endian, positions in double precision). Faces with more than 255
/// corners cannot be written.
std::string write_ply(const PolygonMesh& mesh);

}  // namespace layout_embedding
