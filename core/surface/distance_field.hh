#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/types.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {

/// Lower bounds on the distance to one landmark, as the heuristic of A* searches: distances in the
/// path graph without any strand, other landmarks not passable (design, Sec. 1).
///
/// Edge lengths are rounded down to 32 bits before they are added, so that the bounds are those of
/// a metric of its own: admissible and consistent for the exact one, at 4 bytes per node. The field
/// grows only as far as it is asked to; beyond its radius the radius itself is the bound.
class DistanceField {
public:
    /// `passable[node]` is false at landmarks. O(#nodes) memory, no time yet.
    DistanceField(const PathGraph& graph, const std::vector<bool>& passable, Index source);

    /// Grows the field until `node` is settled (or everything reachable is). If walks from `node`
    /// to the source are only looked for below a length `limit`, it goes on as far as these can
    /// come: a walk over a node at distance d is no shorter than 2 d less the distance of `node`.
    void extend_to(Index node, Length limit = 0);

    /// At most the distance between the node and the source; consistent along every dart as long
    /// as the field is not extended in between.
    Length bound(Index node) const
    {
        const std::uint32_t distance = distances_[node];
        return Length{distance < radius_ ? distance : radius_} << kShift;
    }

    /// Nodes settled so far: the work this field has cost.
    std::uint64_t settled_count() const { return settled_count_; }

    static std::uint64_t bytes(const PathGraph& graph)
    {
        return std::uint64_t{graph.node_count()} * sizeof(std::uint32_t);
    }

private:
    void settle_next();

    // Lengths are stored in units of 2^28, 2^-26 of the bounding-box diagonal.
    static constexpr unsigned kShift = 28;
    static constexpr std::uint32_t kFar = UINT32_MAX;

    const PathGraph& graph_;
    const std::vector<bool>& passable_;
    Index source_;
    std::vector<std::uint32_t> distances_;  // tentative beyond radius_
    std::uint32_t radius_ = 0;
    std::uint64_t settled_count_ = 0;
    std::vector<std::uint64_t> heap_;  // distance << 32 | node
};

/// The distance fields of all landmarks, made when first asked for. When they would take more than
/// the memory allowed, the one used longest ago is dropped; it is computed again when needed.
class DistanceFields {
public:
    /// At least one field is kept, however small `max_bytes`.
    DistanceFields(const PathGraph& graph, const std::vector<bool>& passable,
                   std::uint64_t max_bytes);

    /// The field of the landmark at node `source`, extended as by DistanceField::extend_to(). The
    /// reference is valid until the next call.
    const DistanceField& get(Index source, Index node, Length limit = 0);

    /// Nodes settled by all fields so far.
    std::uint64_t settled_count() const { return settled_count_; }

private:
    struct Entry {
        Index source;
        std::uint64_t last_use;
        std::unique_ptr<DistanceField> field;
    };
    const PathGraph& graph_;
    const std::vector<bool>& passable_;
    std::size_t capacity_;
    std::vector<Entry> entries_;
    std::uint64_t uses_ = 0;
    std::uint64_t settled_count_ = 0;
};

}  // namespace layout_embedding
