#include "surface/cut_surface_search.hh"

#include <algorithm>

namespace layout_embedding {

namespace {
constexpr std::uint32_t kClosed = 1;
constexpr std::uint32_t kTied = 2;
constexpr std::uint32_t kFlags = 4;
}  // namespace

CutSurfaceSearch::CutSurfaceSearch(const Strands& strands, DistanceFields& fields)
    : strands_(strands), fields_(fields), met_numbers_(strands.layout().edge_count(), 0)
{}

void CutSurfaceSearch::begin(Index layout_edge, Length limit)
{
    weights_ = {};
    start(2 * layout_edge, limit);
}

void CutSurfaceSearch::begin_backwards(Index layout_edge)
{
    weights_ = {};
    start(2 * layout_edge + 1, kInfiniteLength);
}

void CutSurfaceSearch::begin_weighted(Index layout_edge, std::span<const NodeWeight> weights)
{
    weights_ = weights;
    start(2 * layout_edge, kInfiniteLength);
}

void CutSurfaceSearch::start(Index layout_halfedge, Length limit)
{
    const Layout& layout = strands_.layout();
    ++search_count_;
    layout_halfedge_ = layout_halfedge;
    limit_ = limit;
    skipped_ = kInfiniteLength;
    met_.clear();
    start_ = strands_.landmark_node(layout.tail(layout_halfedge));
    goal_ = strands_.landmark_node(layout.head(layout_halfedge));
    goal_sector_ = strands_.sector(Layout::twin(layout_halfedge));
    goal_distance_ = kInfiniteLength;
    goal_dart_ = kNone;
    goal_state_ = kNone;
    goal_tied_ = false;
    tied_ = false;
    darts_.clear();
    queue_.clear();
    field_ = weights_.empty() ? &fields_.get(goal_, start_) : nullptr;
    lower_bound_ = weights_.empty() ? field_->bound(start_) : 0;
    if (labels_.size() < strands_.state_bound()) {
        labels_.resize(strands_.state_bound(), Label{kInfiniteLength, kNone, 0});
    }
    if (++number_ >= UINT32_MAX / kFlags) {
        std::fill(labels_.begin(), labels_.end(), Label{kInfiniteLength, kNone, 0});
        std::fill(met_numbers_.begin(), met_numbers_.end(), 0);
        number_ = 1;
    }
    strands_.for_each_way_out(layout_halfedge, [&](Index dart, Index slot, Index strands) {
        weights_.empty() ? relax<false>(kNone, start_, dart, slot, strands, 0)
                         : relax<true>(kNone, start_, dart, slot, strands, 0);
    });
}

CutSurfaceSearch::Outcome CutSurfaceSearch::run(std::uint64_t max_expansions)
{
    // Goes on until the queue has passed the goal: only then have all walks of the same length been
    // seen.
    while (!queue_.empty() && queue_.top().estimate <= goal_distance_) {
        const QueueItem item = queue_.top();
        Label& label = labels_[item.state];
        if ((label.mark & kClosed) == 0) {
            lower_bound_ = std::max(lower_bound_, item.estimate);
            if (max_expansions-- == 0) {
                return Outcome::running;
            }
            label.mark |= kClosed;
            ++expansion_count_;
            queue_.pop();
            if (!queue_.empty()) {
                // Most likely the next to be expanded: its darts are far away in memory.
                strands_.graph().prefetch_darts(strands_.node_of_state(queue_.top().state));
            }
            weights_.empty() ? expand<false>(item.state) : expand<true>(item.state);
        } else {
            queue_.pop();
        }
    }
    if (goal_distance_ >= limit_ && skipped_ != kInfiniteLength) {
        // Everything below was expanded; what was skipped could lead to the goal, or the goal lies
        // at the limit itself.
        lower_bound_ = std::max(lower_bound_, std::min(skipped_, goal_distance_));
        return Outcome::exceeded;
    }
    lower_bound_ = goal_distance_;
    if (goal_distance_ == kInfiniteLength) {
        return Outcome::blocked;
    }
    collect_walk();
    return tied_ ? Outcome::tied : Outcome::found;
}

template <bool kWeighted>
void CutSurfaceSearch::expand(Index state)
{
    const PathGraph& graph = strands_.graph();
    const Length distance = labels_[state].distance;
    const Index node = strands_.node_of_state(state);
    const Index end = graph.first_dart(node + 1);
    if (!strands_.is_touched(node)) {
        for (Index d = graph.first_dart(node); d < end; ++d) {
            relax<kWeighted>(state, node, d, 0, 0, distance);
        }
        return;
    }
    bordering_.clear();
    strands_.append_bordering(state, bordering_);
    for (const Index edge : bordering_) {
        if (met_numbers_[edge] != number_) {
            met_numbers_[edge] = number_;
            met_.push_back(edge);
        }
    }
    const Index region = strands_.region_of_state(state);
    for (Index d = graph.first_dart(node); d < end; ++d) {
        const Index slot = strands_.slot_in_region(node, d, region);
        if (slot != kNone) {
            relax<kWeighted>(state, node, d, slot, strands_.strand_count(node, d), distance);
        }
    }
}

// `strand_count`: the strands over the dart's edge.
template <bool kWeighted>
void CutSurfaceSearch::relax(Index from_state, Index tail, Index dart, Index slot,
                             Index strand_count, Length distance)
{
    const Dart& along = strands_.graph().dart(dart);
    const Length reached =
        distance + (kWeighted ? weighted_length(along.length, weights_[tail], weights_[along.head])
                              : along.length);
    const bool is_landmark = !strands_.passable()[along.head];
    if (is_landmark && along.head != goal_) {
        return;
    }
    const Index region = strands_.is_touched(along.head)
                             ? strands_.region(along.head, along.twin, strand_count - slot)
                             : 0;
    if (is_landmark) {
        if (region != goal_sector_) {
            return;
        }
        if (reached < goal_distance_) {
            goal_distance_ = reached;
            goal_dart_ = dart;
            goal_state_ = from_state;
            goal_tied_ = false;
        } else if (reached == goal_distance_) {
            goal_tied_ = true;
        }
        return;
    }
    const Index state = region == 0 ? along.head : strands_.state(along.head, region);
    Label& label = labels_[state];
    if (label.mark / kFlags == number_) {
        if (reached > label.distance) {
            return;
        }
        if (reached == label.distance) {
            label.mark |= kTied;
            return;
        }
    }
    const Length estimate = kWeighted ? reached : reached + field_->bound(along.head);
    if (estimate > goal_distance_) {
        return;
    }
    if (estimate >= limit_) {
        skipped_ = std::min(skipped_, estimate);
        return;
    }
    label = {reached, dart, number_ * kFlags};
    queue_.push({estimate, state});
}

std::vector<Index> CutSurfaceSearch::blockers() const
{
    // The strands at both ends belong to it although no expanded region may touch them: a cheaper
    // walk may be wrong in the cyclic order only.
    std::vector<Index> blockers = met_;
    strands_.append_sector_neighbours(layout_halfedge_, blockers);
    strands_.append_sector_neighbours(Layout::twin(layout_halfedge_), blockers);
    std::sort(blockers.begin(), blockers.end());
    blockers.erase(std::unique(blockers.begin(), blockers.end()), blockers.end());
    return blockers;
}

void CutSurfaceSearch::collect_walk()
{
    const PathGraph& graph = strands_.graph();
    tied_ = goal_tied_;
    darts_.push_back(goal_dart_);
    Index state = goal_state_;
    while (state != kNone) {
        const Label& label = labels_[state];
        tied_ = tied_ || (label.mark & kTied) != 0;
        const Index dart = label.parent_dart;
        darts_.push_back(dart);
        const Index tail = graph.tail(dart);
        if (tail == start_) {
            break;
        }
        const Index twin = graph.twin(dart);
        const Index node = strands_.node_of_state(state);
        const Index slot_here =
            strands_.slot_in_region(node, twin, strands_.region_of_state(state));
        const Index slot = strands_.strand_count(node, twin) - slot_here;
        state = strands_.state(tail, strands_.region(tail, dart, slot));
    }
    if (layout_halfedge_ % 2 == 1) {
        // From its head: the twins in the order in which they were collected lead there.
        std::transform(darts_.begin(), darts_.end(), darts_.begin(),
                       [&](Index dart) { return graph.twin(dart); });
    } else {
        std::reverse(darts_.begin(), darts_.end());
    }
}

}  // namespace layout_embedding
