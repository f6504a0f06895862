#include "embedding/realisation.hh"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "embedding/face_cutting.hh"
#include "embedding/weak_to_normal_form.hh"

namespace layout_embedding {

namespace {

/// No chain has said yet which patch a piece belongs to (kNone is the patch outside the layout).
constexpr Index kUnknownPatch = kNone - 1;

/// Pieces of faces merged into patches (disjoint sets with path halving); the smaller id is the
/// representative.
class PieceSets {
public:
    Index add()
    {
        parents_.push_back(static_cast<Index>(parents_.size()));
        return parents_.back();
    }
    Index count() const { return static_cast<Index>(parents_.size()); }
    Index find(Index piece)
    {
        while (parents_[piece] != piece) {
            piece = parents_[piece] = parents_[parents_[piece]];
        }
        return piece;
    }
    void merge(Index a, Index b)
    {
        a = find(a);
        b = find(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }
    void reserve(Index pieces) { parents_.reserve(pieces); }

private:
    std::vector<Index> parents_;
};

/// Cuts the mesh along the strands of a normal form. A "piece" is a whole face or, where strands
/// run through it, a part of one; a "stretch" is a part of an edge between two of its crossings or
/// ends.
class MeshCutter {
public:
    MeshCutter(const Layout& layout, const NormalForm& form)
        : layout_(layout), mesh_(form.mesh()), form_(form)
    {}

    Result<RefinedMesh> run();

private:
    void place_vertices();
    Status find_chain_edges();
    Status cut_faces();
    Status cut(Index face);
    void gather_perimeter(Index face);
    void keep(Index face);
    /// A piece of a face has the chord between two places of the perimeter on its border.
    void note_patch_left_of(Index from_place, Index to_place, Index face, Index piece);
    void merge_across_edges();
    Status assign_patches();

    bool is_crossed(Index edge) const { return form_.first_on_edge(edge) != kNone; }
    /// The piece at the given stretch of a halfedge, counted from its tail.
    Index piece_at(Index halfedge, Index stretch) const;

    const Layout& layout_;
    const TriangleMesh& mesh_;
    const NormalForm& form_;
    RefinedMesh refined_;

    std::vector<Index> vertex_of_;     // per element: its refined vertex
    std::vector<Index> strand_of_;     // per element
    std::vector<bool> is_chain_edge_;  // per mesh edge
    std::vector<Index> first_piece_;   // per face
    std::vector<Index> cut_index_;     // per face: its rank among the cut ones, or kNone
    /// Per cut face and side: where the side begins in stretch_pieces_.
    std::vector<std::array<Index, 3>> side_begins_;
    /// Per stretch of a cut face's perimeter: the piece there.
    std::vector<Index> stretch_pieces_;
    std::vector<Index> piece_first_triangle_;
    PieceSets sets_;
    /// Pieces with the patch that a chain at their border says.
    std::vector<std::pair<Index, Index>> known_patches_;

    // Scratch, for one face at a time.
    std::vector<PerimeterPoint> perimeter_;
    std::vector<Index> perimeter_elements_;  // kNone for a corner
    std::vector<Index> perimeter_vertices_;
    std::array<Index, 3> corner_places_;
    std::vector<Index> place_of_;  // per element: its place on the perimeter
    FacePieces pieces_;
    std::vector<std::array<Index, 3>> triangles_;
};

Error failed(const std::string& what, const char* place, Index id)
{
    return make_error(ErrorCode::realisationFailed,
                      what + " at " + place + " " + std::to_string(id) + " of the target",
                      {{place, id}});
}

void MeshCutter::place_vertices()
{
    refined_.positions = mesh_.positions();
    vertex_of_.assign(form_.element_count(), kNone);
    strand_of_.assign(form_.element_count(), kNone);
    refined_.chains.resize(form_.strand_count());
    for (Index strand = 0; strand < form_.strand_count(); ++strand) {
        for (Index id = form_.first(strand); id != kNone; id = form_.element(id).next) {
            const NormalForm::Element& e = form_.element(id);
            strand_of_[id] = strand;
            vertex_of_[id] = e.vertex;
            if (e.is_crossing()) {
                vertex_of_[id] = static_cast<Index>(refined_.positions.size());
                const Index h = mesh_.halfedge(form_.edge(id));
                std::array<double, 3> barycentrics{};
                barycentrics[h % 3] = 1 - e.parameter;
                barycentrics[TriangleMesh::next(h) % 3] = e.parameter;
                refined_.positions.push_back(form_.position(id));
                refined_.vertex_faces.push_back(TriangleMesh::face_of(h));
                refined_.vertex_barycentrics.push_back(barycentrics);
            }
            refined_.chains[strand].push_back(vertex_of_[id]);
        }
    }
}

Status MeshCutter::find_chain_edges()
{
    is_chain_edge_.assign(mesh_.edge_count(), false);
    for (Index strand = 0; strand < form_.strand_count(); ++strand) {
        for (Index id = form_.first(strand); form_.element(id).next != kNone;
             id = form_.element(id).next) {
            if (form_.segment_face(id) != kNone) {
                continue;
            }
            const Index edge = form_.segment_edge(id);
            if (edge == kNone) {
                return failed("a path jumps between vertices that no edge joins", "vertex",
                              form_.element(id).vertex);
            }
            if (is_chain_edge_[edge] || is_crossed(edge)) {
                return failed("another path meets the one that runs along an edge,", "edge", edge);
            }
            is_chain_edge_[edge] = true;
        }
    }
    return {};
}

void MeshCutter::gather_perimeter(Index face)
{
    perimeter_.clear();
    perimeter_elements_.clear();
    perimeter_vertices_.clear();
    for (Index side = 0; side < 3; ++side) {
        const Index h = 3 * face + side;
        const Index corner = mesh_.tail(h);
        corner_places_[side] = static_cast<Index>(perimeter_.size());
        perimeter_.push_back({side, 0, kNone, mesh_.position(corner)});
        perimeter_elements_.push_back(kNone);
        perimeter_vertices_.push_back(corner);
        const Index edge = mesh_.edge(h);
        const bool forward = mesh_.halfedge(edge) == h;
        for (Index id = forward ? form_.first_on_edge(edge) : form_.last_on_edge(edge); id != kNone;
             id = forward ? form_.element(id).edge_next : form_.element(id).edge_previous) {
            const double parameter = form_.element(id).parameter;
            place_of_[id] = static_cast<Index>(perimeter_.size());
            // The partner is set below.
            perimeter_.push_back(
                {side, forward ? parameter : 1 - parameter, 0, refined_.positions[vertex_of_[id]]});
            perimeter_elements_.push_back(id);
            perimeter_vertices_.push_back(vertex_of_[id]);
        }
    }
    for (std::size_t i = 0; i < perimeter_.size(); ++i) {
        const Index id = perimeter_elements_[i];
        if (id == kNone) {
            continue;
        }
        const NormalForm::Element& e = form_.element(id);
        const Index other = TriangleMesh::face_of(e.halfedge) == face ? e.previous : e.next;
        const NormalForm::Element& o = form_.element(other);
        // What is not on this perimeter gets a partner that cut_face() refuses.
        Index partner = kNone - 1;
        if (o.is_crossing()) {
            const Index place = place_of_[other];
            if (place < perimeter_.size() && perimeter_elements_[place] == other) {
                partner = place;
            }
        } else {
            for (const Index place : corner_places_) {
                if (perimeter_vertices_[place] == o.vertex) {
                    partner = place;
                }
            }
        }
        perimeter_[i].partner = partner;
    }
}

void MeshCutter::keep(Index face)
{
    first_piece_[face] = sets_.add();
    piece_first_triangle_.push_back(static_cast<Index>(refined_.triangle_faces.size()));
    for (const Index vertex : mesh_.face(face)) {
        refined_.corners.push_back(vertex);
    }
    refined_.triangle_faces.push_back(face);
}

void MeshCutter::note_patch_left_of(Index from_place, Index to_place, Index face, Index piece)
{
    // At least one end of a chord is a crossing and knows its neighbours.
    const Index from = perimeter_elements_[from_place];
    const Index to = perimeter_elements_[to_place];
    const Index crossing = from != kNone ? from : to;
    const bool leaves_face = TriangleMesh::face_of(form_.element(crossing).halfedge) == face;
    const bool along = leaves_face == (crossing == to);
    const Index edge = strand_of_[crossing];
    known_patches_.emplace_back(piece, layout_.face(along ? 2 * edge : 2 * edge + 1));
}

Status MeshCutter::cut(Index face)
{
    gather_perimeter(face);
    if (!cut_face(perimeter_, pieces_)) {
        return failed("paths meet", "face", face);
    }
    const Index count = static_cast<Index>(perimeter_.size());
    first_piece_[face] = sets_.count();
    const Index begin = static_cast<Index>(stretch_pieces_.size());
    cut_index_[face] = static_cast<Index>(side_begins_.size());
    side_begins_.push_back(
        {begin + corner_places_[0], begin + corner_places_[1], begin + corner_places_[2]});
    stretch_pieces_.resize(begin + count, kNone);
    for (Index i = 0; i < pieces_.count(); ++i) {
        const std::span<const Index> polygon = pieces_.piece(i);
        const Index piece = sets_.add();
        piece_first_triangle_.push_back(static_cast<Index>(refined_.triangle_faces.size()));
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Index from = polygon[k];
            const Index to = polygon[k + 1 < polygon.size() ? k + 1 : 0];
            if (to == (from + 1 < count ? from + 1 : 0)) {
                stretch_pieces_[begin + from] = piece;
            } else {
                note_patch_left_of(from, to, face, piece);
            }
        }
        triangles_.clear();
        triangulate_piece(perimeter_, polygon, triangles_);
        for (const std::array<Index, 3>& triangle : triangles_) {
            for (const Index place : triangle) {
                refined_.corners.push_back(perimeter_vertices_[place]);
            }
            refined_.triangle_faces.push_back(face);
        }
    }
    return {};
}

Status MeshCutter::cut_faces()
{
    const Index faces = mesh_.face_count();
    first_piece_.resize(faces);
    cut_index_.assign(faces, kNone);
    place_of_.assign(form_.element_count(), kNone);
    // Every crossing adds two triangles; fewer than that many pieces.
    const std::size_t triangles = std::size_t{faces} + 2 * refined_.vertex_faces.size();
    refined_.corners.reserve(3 * triangles);
    refined_.triangle_faces.reserve(triangles);
    piece_first_triangle_.reserve(triangles + 1);
    sets_.reserve(triangles);
    for (Index face = 0; face < faces; ++face) {
        if (is_crossed(mesh_.edge(3 * face)) || is_crossed(mesh_.edge(3 * face + 1)) ||
            is_crossed(mesh_.edge(3 * face + 2))) {
            if (const Status status = cut(face); !status) {
                return status;
            }
        } else {
            keep(face);
        }
    }
    piece_first_triangle_.push_back(static_cast<Index>(refined_.triangle_faces.size()));
    return {};
}

Index MeshCutter::piece_at(Index halfedge, Index stretch) const
{
    const Index face = TriangleMesh::face_of(halfedge);
    const Index cut = cut_index_[face];
    return cut == kNone ? first_piece_[face]
                        : stretch_pieces_[side_begins_[cut][halfedge % 3] + stretch];
}

void MeshCutter::merge_across_edges()
{
    for (Index edge = 0; edge < mesh_.edge_count(); ++edge) {
        const Index h = mesh_.halfedge(edge);
        const Index twin = mesh_.opposite(h);
        if (twin == kNone || is_chain_edge_[edge]) {
            continue;
        }
        Index crossings = 0;
        for (Index id = form_.first_on_edge(edge); id != kNone; id = form_.element(id).edge_next) {
            ++crossings;
        }
        for (Index i = 0; i <= crossings; ++i) {
            sets_.merge(piece_at(h, i), piece_at(twin, crossings - i));
        }
    }
}

Status MeshCutter::assign_patches()
{
    // Chains made of mesh edges have whole stretches on both sides.
    for (Index strand = 0; strand < form_.strand_count(); ++strand) {
        for (Index id = form_.first(strand); form_.element(id).next != kNone;
             id = form_.element(id).next) {
            if (form_.segment_face(id) != kNone) {
                continue;
            }
            const Index h = mesh_.halfedge(form_.segment_edge(id));
            const bool along = mesh_.tail(h) == form_.element(id).vertex;
            known_patches_.emplace_back(piece_at(h, 0), layout_.face(2 * strand + (along ? 0 : 1)));
            if (const Index twin = mesh_.opposite(h); twin != kNone) {
                known_patches_.emplace_back(piece_at(twin, 0),
                                            layout_.face(2 * strand + (along ? 1 : 0)));
            }
        }
    }
    std::vector<Index> patches(sets_.count(), kUnknownPatch);
    for (const auto& [piece, patch] : known_patches_) {
        Index& known = patches[sets_.find(piece)];
        if (known != kUnknownPatch && known != patch) {
            const auto name = [](Index face) {
                return face == kNone ? "the outside" : "layout face " + std::to_string(face);
            };
            return failed("the paths do not separate " + name(known) + " from " + name(patch),
                          "face", refined_.triangle_faces[piece_first_triangle_[piece]]);
        }
        known = patch;
    }
    refined_.triangle_patches.reserve(refined_.triangle_faces.size());
    for (Index piece = 0; piece < sets_.count(); ++piece) {
        const Index patch = patches[sets_.find(piece)];
        if (patch == kUnknownPatch) {
            return failed("no path bounds the patch", "face",
                          refined_.triangle_faces[piece_first_triangle_[piece]]);
        }
        refined_.triangle_patches.resize(piece_first_triangle_[piece + 1], patch);
    }
    return {};
}

Result<RefinedMesh> MeshCutter::run()
{
    place_vertices();
    if (const Status status = find_chain_edges(); !status) {
        return status.error();
    }
    if (const Status status = cut_faces(); !status) {
        return status.error();
    }
    merge_across_edges();
    if (const Status status = assign_patches(); !status) {
        return status.error();
    }
    return std::move(refined_);
}

}  // namespace

Result<RefinedMesh> cut_along(const Layout& layout, const NormalForm& form)
{
    return MeshCutter(layout, form).run();
}

Result<RefinedMesh> realise(const EmbeddingProblem& problem, const PathGraph& graph,
                            const WeakEmbedding& embedding)
{
    const Result<NormalForm> form = normal_form_of(problem, graph, embedding);
    if (!form) {
        return form.error();
    }
    return cut_along(*problem.layout, *form);
}

}  // namespace layout_embedding
