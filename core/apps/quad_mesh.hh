#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/quad_statistics.hh"
#include "base/result.hh"
#include "embedding/refined_mesh.hh"
#include "layout/layout.hh"
#include "mesh/surface_point.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

struct QuadOptions {
    /// Wanted length of edges, in the target's units; 0: one that gives about 4000 quads.
    double edge_length = 0;
    /// Pairs of a layout edge and its number of segments, which rule its whole loops of quads.
    std::vector<std::pair<Index, Index>> segments;
    /// QuadMesh::segments of another mesh of the same layout, to get the same connectivity; the
    /// options above don't count then. Empty for none.
    std::vector<Index> segments_as;
    /// How often all vertices are moved to even the mesh out. 0: the resampled patches as they are.
    Index relaxation_rounds = 30;
};

/// A quad mesh on a target whose base complex is the layout (paper, Sec. 5.1).
struct QuadMesh {
    std::vector<Vec3> positions;
    /// Per vertex its place on the target.
    std::vector<SurfacePoint> points;
    /// Counter-clockwise.
    std::vector<std::array<Index, 4>> quads;
    /// Per quad: its layout face.
    std::vector<Index> quad_faces;
    /// The base complex as chains of vertices: the layout's edges in their order, then the edges of
    /// a midpoint subdivision inside of faces.
    std::vector<std::vector<Index>> chains;
    /// Whether the layout had a face without four sides, so that all faces were subdivided.
    bool is_subdivided = false;
    /// Numbers of segments, per edge of the base complex (apps/base_complex.hh).
    std::vector<Index> segments;
    /// Per layout edge: the dual loops of its two halves, the same without a subdivision.
    std::vector<std::array<Index, 2>> loops;
    /// The edge length that counts where none is given.
    double default_edge_length = 0;
    QuadStatistics statistics;
};

/// Makes a quad mesh of an embedding that check_embedding() accepts: patches are mapped to
/// rectangles (or regular polygons, divided by one midpoint subdivision), regular grids on them are
/// taken back to the surface, and vertices other than landmarks and those on a boundary relaxed on
/// it where that makes no quad around them worse than it may be. Connectivity depends on the layout
/// and the numbers of segments alone. Vertex order: landmarks, then edges, then faces.
///
/// Errors: invalidOption (choose_segments() in apps/base_complex.hh), parametrisationFailed,
/// tooLarge (more than 16 million vertices).
Result<QuadMesh> make_quad_mesh(const Layout& layout, const TriangleMesh& target,
                                const RefinedMesh& refined, const QuadOptions& options = {});

/// The same in steps: the patches as they are, then each round of relaxation.
class QuadMeshJob {
public:
    /// All but `options` must outlive this.
    QuadMeshJob(const Layout& layout, const TriangleMesh& target, const RefinedMesh& refined,
                const QuadOptions& options);
    ~QuadMeshJob();

    /// Does some work; false once there is nothing left to do.
    bool step();
    /// Share of the work that is done, at least, in [0, 1].
    double progress() const;
    /// The mesh as far as it is relaxed, or what went wrong; once.
    Result<QuadMesh> take();

private:
    class Mesher;
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// `mesh` as OBJ: the quads of each layout face as a group `patch_<face>`, the base complex as `l`
/// lines.
std::string write_quad_obj(const QuadMesh& mesh);

}  // namespace layout_embedding
