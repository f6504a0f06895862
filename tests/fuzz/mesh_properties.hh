#pragma once

#include <cmath>
#include <cstring>

#include "fuzz.hh"
#include "layout/layout.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/repair.hh"
#include "mesh/triangle_mesh.hh"
#include "mesh/validation.hh"

namespace layout_embedding {

/// Whether two meshes are the same, positions to the bit but for the kind of not-a-number.
inline bool identical(const PolygonMesh& a, const PolygonMesh& b)
{
    if (a.positions.size() != b.positions.size() || a.face_offsets != b.face_offsets ||
        a.corners != b.corners) {
        return false;
    }
    for (std::size_t v = 0; v < a.positions.size(); ++v) {
        for (int i = 0; i < 3; ++i) {
            const double x = a.positions[v][i];
            const double y = b.positions[v][i];
            if (!(std::isnan(x) && std::isnan(y)) && std::memcmp(&x, &y, sizeof x) != 0) {
                return false;
            }
        }
    }
    return true;
}

/// What must hold for any mesh whatever: validation and repair end, and agree with each other and
/// with what is built on them.
inline void check_mesh_properties(const PolygonMesh& mesh)
{
    for (const SurfaceKind kind : {SurfaceKind::target, SurfaceKind::layout}) {
        const Status status = check_surface(mesh, kind, "the mesh");
        FUZZ_CHECK(status.ok() || !status.error().message.empty());
        const RepairResult repaired = repair_surface(mesh, kind);
        FUZZ_CHECK(repaired.vertex_map.size() == mesh.positions.size());
        for (const Index v : repaired.vertex_map) {
            FUZZ_CHECK(v == kNone || v < repaired.mesh.positions.size());
        }
        if (status.ok()) {
            FUZZ_CHECK(identical(repaired.mesh, mesh) && repaired.notes.empty());
        }
        const Status after = check_surface(repaired.mesh, kind, "the mesh");
        if (after.ok()) {
            FUZZ_CHECK(status.ok() || !repaired.notes.empty());
            if (kind == SurfaceKind::target) {
                const TriangleMesh triangles(repaired.mesh);
                const long genus_and_holes = 2 - triangles.euler_characteristic();
                const long loops = triangles.boundary_loop_count();
                FUZZ_CHECK(genus_and_holes >= loops && (genus_and_holes - loops) % 2 == 0);
            } else {
                const Result<Layout> layout = Layout::from_polygons(repaired.mesh, "the layout");
                FUZZ_CHECK(layout.ok());
                const long genus_and_holes = 2 - layout->euler_characteristic();
                const long loops = static_cast<long>(layout->boundary_loops().size());
                FUZZ_CHECK(genus_and_holes >= loops && (genus_and_holes - loops) % 2 == 0);
            }
        }
    }
}

inline void check_values(const PolygonMesh& mesh, const CornerValues& values)
{
    FUZZ_CHECK(values.empty() || values.ids.size() == mesh.corners.size());
    for (const Index id : values.ids) {
        FUZZ_CHECK(id == kNone || id < values.count());
    }
    for (const double number : values.numbers) {
        FUZZ_CHECK(std::isfinite(number));
    }
}

inline void check_names(const PolygonMesh& mesh, const FaceNames& names)
{
    FUZZ_CHECK(names.empty() || names.ids.size() == mesh.face_count());
    for (const Index id : names.ids) {
        FUZZ_CHECK(id == kNone || id < names.names.size());
    }
}

inline void check_attributes(const PolygonMesh& mesh, const MeshAttributes& attributes)
{
    check_values(mesh, attributes.texture_coordinates);
    check_values(mesh, attributes.colours);
    check_names(mesh, attributes.groups);
    check_names(mesh, attributes.materials);
}

/// What must hold of attributes whatever the file: they fit the mesh that was read with them, which
/// is the same without them, and what a repair makes of it.
inline void check_attribute_properties(const PolygonMesh& mesh, const MeshAttributes& attributes,
                                       const Result<PolygonMesh>& without)
{
    FUZZ_CHECK(without.ok() && identical(mesh, *without));
    check_attributes(mesh, attributes);
    const RepairResult repaired = repair_surface(mesh, SurfaceKind::target);
    check_attributes(repaired.mesh, through_repair(attributes, mesh, repaired.face_origins));
}

}  // namespace layout_embedding
