#pragma once

#include <span>
#include <vector>

#include "base/types.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// Disjoint strands on a triangle mesh in normal form: each strand is a sequence of elements, which
/// are crossings with mesh edges and mesh vertices, joined by straight segments inside faces or
/// along edges (design, Sec. 4). Everything that happens to paths once the search is over
/// (removing bigons, straightening, smoothing) is a change of elements or of their parameters here;
/// realise() then cuts the mesh along the strands.
///
/// What holds for a complete form: the elements of a strand are a doubly linked list that starts
/// and ends at a landmark vertex; two consecutive ones share a face. The crossings of a mesh edge
/// are a doubly linked list as well, in the edge's own direction (that of mesh.halfedge(edge)), and
/// their parameters increase strictly. Inside a face the segments are pairwise disjoint but for
/// common landmarks. A vertex that is no landmark carries at most one strand. Boundary edges are
/// never crossed.
///
/// Elements are 0-based ids; those of erased ones are given to new ones.
class NormalForm {
public:
    struct Element {
        /// A vertex element: the mesh vertex. A crossing: kNone.
        Index vertex = kNone;
        /// A crossing: the halfedge of the crossed edge in the face that the strand leaves (it goes
        /// on in the face of the opposite halfedge). A vertex element: kNone.
        Index halfedge = kNone;
        /// A crossing: its place on the edge, 0 at the tail and 1 at the head of
        /// mesh.halfedge(edge), whichever way the strand goes.
        double parameter = 0.5;
        /// The neighbours along the strand; kNone at its ends.
        Index previous = kNone;
        Index next = kNone;
        /// A crossing: the neighbours along the edge; kNone at the ends.
        Index edge_previous = kNone;
        Index edge_next = kNone;
        /// The strand it belongs to.
        Index strand = kNone;

        bool is_crossing() const { return halfedge != kNone; }
    };

    /// No strand has elements yet. `mesh` must outlive the normal form. O(#E + strands).
    NormalForm(const TriangleMesh& mesh, Index strand_count);

    // Reading.
    const TriangleMesh& mesh() const { return *mesh_; }
    Index strand_count() const { return static_cast<Index>(strand_firsts_.size()); }
    /// The number of element ids, erased ones included.
    Index element_count() const { return static_cast<Index>(elements_.size()); }
    const Element& element(Index id) const { return elements_[id]; }
    /// The end elements of a strand; kNone while it is empty.
    Index first(Index strand) const { return strand_firsts_[strand]; }
    Index last(Index strand) const { return strand_lasts_[strand]; }
    /// The crossings of an edge that lie next to the tail and the head of mesh.halfedge(edge);
    /// kNone where nothing crosses.
    Index first_on_edge(Index edge) const { return edge_firsts_[edge]; }
    Index last_on_edge(Index edge) const { return edge_lasts_[edge]; }
    /// How many crossings an edge has.
    Index crossing_count(Index edge) const { return edge_counts_[edge]; }
    /// The mesh edge of a crossing.
    Index edge(Index crossing) const { return mesh_->edge(elements_[crossing].halfedge); }
    /// The position of an element on the mesh.
    Vec3 position(Index id) const;
    /// The length of a strand on the mesh. O(elements of the strand).
    double length(Index strand) const;
    /// Of all strands.
    double total_length() const;

    /// The face that the segment from `id` to its next element runs in; kNone where it runs from
    /// vertex to vertex along an edge (see segment_edge). O(1).
    Index segment_face(Index id) const;
    /// The edge that the segment from `id` to its next element runs along; kNone for a segment
    /// inside a face. O(vertex degree).
    Index segment_edge(Index id) const;

    // Building: elements are made first, then put in their lists, each from first to last.
    Index add_vertex(Index vertex);
    Index add_crossing(Index halfedge);
    void append_to_strand(Index strand, Index id);
    void append_to_edge(Index crossing);

    // Changing.
    /// Takes a crossing out of its strand and its edge. O(1).
    void erase_crossing(Index crossing);
    /// Moves a crossing along its edge; to keep the order on the edge is the caller's business.
    void set_parameter(Index crossing, double parameter)
    {
        elements_[crossing].parameter = parameter;
    }
    /// Puts a vertex in the place of the consecutive crossings `first` .. `last` of a strand. They
    /// cross edges at this vertex, and there is no other crossing between it and them; so the
    /// strand moves onto the vertex without meeting another one. The vertex carries no strand.
    /// Returns the new element. O(crossings).
    Index snap_to_vertex(Index first, Index last, Index vertex);
    /// The reverse: puts crossings in the place of an inner vertex element, one for each of
    /// `halfedges` (Element::halfedge), in order. Their edges end at the vertex and are all those
    /// on one side of the strand; each crossing becomes the one nearest to the vertex. `distances`
    /// are measured from the vertex as parameters. O(crossings).
    void pop_off_vertex(Index id, std::span<const Index> halfedges,
                        std::span<const double> distances);
    /// Replaces all elements of a strand between its ends by vertices, each joined to the next by
    /// an edge; that it gets there by an isotopy is the caller's business. O(elements of the
    /// strand).
    void reroute(Index strand, std::span<const Index> vertices);
    /// Erases the bigon of `id` and the next element of its strand, if there is one, and those that
    /// this makes of their neighbours. Returns `id`, or the last element before it that is left.
    Index remove_bigon(Index id);
    /// Erases every bigon: two consecutive crossings of one edge, and a crossing next to a vertex
    /// that its edge ends at. What lies inside a bigon belongs to bigons too, so strands stay
    /// disjoint, and each moves by an isotopy that fixes the vertices. Returns the number of
    /// crossings erased. O(elements).
    Index remove_bigons();
    /// Forgets erased elements and numbers the others strand by strand, from first to last.
    /// O(elements).
    void compact();
    /// Moves the k crossings of every edge to 1/(k+1), ..., k/(k+1). O(elements).
    void spread_evenly();

private:
    Index new_element();
    /// Whether two consecutive elements are a bigon.
    bool is_bigon(Index a, Index b) const;

    const TriangleMesh* mesh_;
    std::vector<Element> elements_;
    std::vector<Index> strand_firsts_;  // per strand
    std::vector<Index> strand_lasts_;   // per strand
    std::vector<Index> edge_firsts_;    // per mesh edge
    std::vector<Index> edge_lasts_;     // per mesh edge
    std::vector<Index> edge_counts_;    // per mesh edge
    std::vector<Index> unused_;         // erased elements
};

}  // namespace layout_embedding
