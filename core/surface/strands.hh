#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/types.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// A partial embedding as strands of zero width in the path graph, and the surface cut open along
/// them (design, Sec. 1).
///
/// Terms. The strands over a path-graph edge lie side by side; a *slot* is a gap between them,
/// numbered from the right as seen along a dart: dart d with m strands has the slots 0 .. m, and
/// slot s of d is slot m - s of its twin. Around a node, slots and strand ends follow each other
/// counter-clockwise. The strands that pass a node cut the disk around it into *regions*; those
/// that end at a landmark cut it into *sectors*, which are numbered as regions too. A *state* of
/// the cut surface is a node with one of its regions; states have dense ids, that of an untouched
/// node is the node itself.
///
/// Strands are inserted and removed like a stack, which is how a search moves between its states;
/// nothing is copied.
class Strands {
public:
    /// Keeps a reference to `graph`.
    Strands(const EmbeddingProblem& problem, const PathGraph& graph);
    Strands(const Strands&) = delete;
    Strands& operator=(const Strands&) = delete;

    const PathGraph& graph() const { return *graph_; }
    const Layout& layout() const { return *layout_; }
    const EdgeWeights& weights() const { return weights_; }
    /// The path-graph node of a layout vertex.
    Index landmark_node(Index layout_vertex) const { return landmark_nodes_[layout_vertex]; }
    /// False at landmarks: paths only end there.
    const std::vector<bool>& passable() const { return passable_; }

    bool is_embedded(Index layout_edge) const { return !strands_[layout_edge].empty(); }
    /// The darts of an embedded edge from tail(2e) to head(2e), empty otherwise.
    const std::vector<Index>& darts(Index layout_edge) const { return strands_[layout_edge]; }
    /// Embedded edges, oldest first.
    const std::vector<Index>& insertion_order() const { return order_; }

    // The cut surface.

    /// More than every state id.
    Index state_bound() const
    {
        return graph_->node_count() + static_cast<Index>(extra_nodes_.size());
    }
    Index node_of_state(Index state) const
    {
        return state < graph_->node_count() ? state : extra_nodes_[state - graph_->node_count()];
    }
    Index region_of_state(Index state) const
    {
        return state < graph_->node_count() ? 0 : extra_regions_[state - graph_->node_count()];
    }
    bool is_touched(Index node) const { return records_of_nodes_[node] != kNone; }
    /// The number of strands over a dart's edge, given the dart's tail.
    Index strand_count(Index tail, Index dart) const;
    /// The region next to a slot of a dart, at the dart's tail.
    Index region(Index tail, Index dart, Index slot) const;
    /// The slot of a dart next to the given region of its tail, which is no landmark; kNone if
    /// none.
    Index slot_in_region(Index tail, Index dart, Index region) const;
    Index state(Index node, Index region) const;
    /// The place of a slot in the counter-clockwise sequence of all slots around the dart's tail.
    Index slot_place(Index tail, Index dart, Index slot) const;

    /// A layout halfedge whose strand runs along the border of a state's region, the region on its
    /// left; kNone at untouched nodes.
    Index bordering_halfedge(Index state) const;

    /// Appends the layout edges whose strands border a state's region, some perhaps twice.
    void append_bordering(Index state, std::vector<Index>& layout_edges) const;
    /// Appends the embedded edges next to layout halfedge h in the cyclic order of tail(h): they
    /// bound its sector. None if nothing is embedded there.
    void append_sector_neighbours(Index layout_halfedge, std::vector<Index>& layout_edges) const;

    /// The sector at landmark tail(h) in which halfedge h of the layout has to leave, given the
    /// edges embedded there.
    Index sector(Index layout_halfedge) const;
    /// Calls visit(dart, slot, strands over the dart's edge) for every way out of that sector.
    template <typename Visit>
    void for_each_way_out(Index layout_halfedge, const Visit& visit) const
    {
        const Index start = landmark_node(layout().tail(layout_halfedge));
        const Index own_sector = sector(layout_halfedge);
        for (Index d = graph().first_dart(start); d < graph().first_dart(start + 1); ++d) {
            const Index strands = strand_count(start, d);
            for (Index slot = 0; slot <= strands; ++slot) {
                if (region(start, d, slot) == own_sector) {
                    visit(d, slot, strands);
                }
            }
        }
    }

    /// A walk with its slots in the present cut surface.
    struct Trace {
        /// Per dart: its slot at the dart's tail.
        std::vector<Index> slots;
        /// Per dart but the first: the state at its tail.
        std::vector<Index> states;
    };
    /// Follows a walk between the landmarks of a layout edge through the cut surface, within the
    /// edge's sectors; nothing if a strand is in the way. It may use a slot twice.
    std::optional<Trace> trace(Index layout_edge, std::span<const Index> darts) const;

    /// Embeds a layout edge along a walk that traces; false, without any change, if it does not.
    bool insert(Index layout_edge, std::vector<Index> darts);
    /// Removes the strand inserted last.
    void undo();

    /// The strands with their lanes.
    WeakEmbedding weak_embedding() const;

private:
    /// The end of a strand on one side of a node: an incoming or outgoing pass of its `visit`-th
    /// node.
    struct End {
        Index place;  // of the dart among those that leave the node
        Index layout_edge;
        Index visit;
    };
    /// What is known of a node that strands touch.
    struct Record {
        Index node = kNone;
        std::vector<End> ends;            // counter-clockwise
        std::vector<Index> slot_offsets;  // per dart of the node, and one more
        std::vector<Index> slot_regions;
        Index region_count = 1;
        Index first_extra = 0;  // id, past the node count, of the state of region 1
    };
    struct SavedRecord {
        Index record;
        Index first_extra;
    };
    struct Undo {
        Index extra_count;
        std::vector<SavedRecord> records;
    };

    const Record* record_at(Index node) const
    {
        const Index r = records_of_nodes_[node];
        return r == kNone ? nullptr : &records_[r];
    }
    Record& touch(Index node);
    void insert_end(Index node, Index dart, Index lane, Index layout_edge, Index visit);
    void update_regions(Record& record);
    bool lies_right(std::span<const Index> darts, Index i, bool turned_i, Index j,
                    bool turned_j) const;
    std::optional<Trace> trace_from(Index layout_edge, std::span<const Index> darts,
                                    Index first_slot) const;

    const PathGraph* graph_;
    std::shared_ptr<const Layout> layout_;
    EdgeWeights weights_;
    std::vector<Index> landmark_nodes_;
    std::vector<bool> passable_;  // per node

    std::vector<std::vector<Index>> strands_;  // per layout edge
    std::vector<Index> order_;
    std::vector<Undo> undos_;

    std::vector<Index> records_of_nodes_;
    std::vector<Record> records_;
    std::vector<Index> free_records_;
    std::vector<Index> extra_nodes_;    // per state past the nodes
    std::vector<Index> extra_regions_;  // likewise
};

}  // namespace layout_embedding
