#include "surface/class_enumeration.hh"

#include <algorithm>
#include <utility>

#include "surface/stretch.hh"

namespace layout_embedding {

namespace {

// Marks the goal's labels in the queue, so that they leave it last among equals: only then have all
// walks of the same length been seen.
constexpr Index kIsGoal = Index{1} << 31U;
// An expansion takes about as long as so many in the cut surface, and that as looking at so many
// labels.
constexpr std::uint64_t kExpansionWork = 3;
constexpr std::uint64_t kLabelsPerWork = 16;
// Labels take at most so many times the memory that the last enumeration needed.
constexpr std::size_t kSpareCapacity = 8;
// Labels per bucket, at most on average.
constexpr std::size_t kBucketLoad = 2;
constexpr std::size_t kLeastBuckets = 1024;
constexpr std::uint64_t kHashFactor = 0x9E3779B97F4A7C15U;

}  // namespace

ClassEnumeration::ClassEnumeration(const Strands& strands, DistanceFields& fields)
    : strands_(strands), fields_(fields), is_met_(strands.layout().edge_count(), false)
{}

void ClassEnumeration::begin(const CutSystem& cuts, Index layout_edge, Length limit)
{
    const Layout& layout = strands_.layout();
    cuts_ = &cuts;
    layout_edge_ = layout_edge;
    limit_ = limit;
    start_vertex_ = layout.tail(2 * layout_edge);
    goal_vertex_ = layout.head(2 * layout_edge);
    start_ = strands_.landmark_node(start_vertex_);
    goal_ = strands_.landmark_node(goal_vertex_);
    goal_sector_ = strands_.sector(2 * layout_edge + 1);
    field_ = &fields_.get(goal_, start_, limit == kInfiniteLength ? 0 : limit);
    words_ = {};
    if (labels_.size() < labels_.capacity() / kSpareCapacity) {
        // One long enumeration does not take memory for all that follow.
        labels_.shrink_to_fit();
        jumps_.shrink_to_fit();
        buckets_ = {};
    }
    labels_.clear();
    jumps_.clear();
    buckets_.assign(std::max(buckets_.size(), kLeastBuckets), kNone);
    for (const Index state : used_states_) {
        label_counts_[state] = 0;
    }
    used_states_.clear();
    label_counts_.resize(std::max<std::size_t>(label_counts_.size(), strands_.state_bound()), 0);
    classes_.clear();
    queue_.clear();
    for (const Index edge : met_) {
        is_met_[edge] = false;
    }
    met_.clear();
    strands_.for_each_way_out(2 * layout_edge, [&](Index dart, Index slot, Index strands) {
        relax({}, dart, slot, strands);
    });
}

Length ClassEnumeration::frontier() const
{
    return queue_.empty() ? limit_ : std::min(limit_, queue_.top().estimate);
}

std::uint64_t ClassEnumeration::work_count() const
{
    return kExpansionWork * expansion_count_ + label_count_ / kLabelsPerWork;
}

ClassEnumeration::Outcome ClassEnumeration::run(std::uint64_t max_expansions,
                                                std::uint64_t max_work)
{
    const PathGraph& graph = strands_.graph();
    const std::uint64_t before = work_count();
    while (!queue_.empty()) {
        const Index current = queue_.top().label & ~kIsGoal;
        if (labels_[current].is_closed) {
            queue_.pop();
            continue;
        }
        if (max_expansions-- == 0 || work_count() - before >= max_work) {
            return Outcome::running;
        }
        queue_.pop();
        if (!queue_.empty()) {
            // Most likely the next to be expanded: its darts are far away in memory.
            graph.prefetch_darts(queue_.top().node);
        }
        ++expansion_count_;
        close(current);
        const Label label = labels_[current];
        const Index node = strands_.node_of_state(label.state);
        if (node == goal_) {
            // The word that stands for all that differ by turns around the goal.
            if (classes_.insert(words_.without_turns(label.word, cuts_->letter(goal_vertex_)))
                    .second) {
                cost_ = label.distance;
                const bool tied = collect_walk(current);
                if (!walk_crosses_itself(graph, darts_)) {
                    return tied ? Outcome::tied : Outcome::found;
                }
            }
            continue;
        }
        if (crosses_itself(current)) {
            continue;
        }
        const Origin from{current, label.distance, label.word, label.entry};
        const Index end = graph.first_dart(node + 1);
        const Index back = graph.twin(label.parent_dart);  // leads to the label before
        if (!strands_.is_touched(node)) {
            for (Index d = graph.first_dart(node); d < end; ++d) {
                if (d != back) {
                    relax(from, d, 0, 0);
                }
            }
            continue;
        }
        bordering_.clear();
        strands_.append_bordering(label.state, bordering_);
        for (const Index edge : bordering_) {
            if (!is_met_[edge]) {
                is_met_[edge] = true;
                met_.push_back(edge);
            }
        }
        const Index region = strands_.region_of_state(label.state);
        for (Index d = graph.first_dart(node); d < end; ++d) {
            const Index slot = strands_.slot_in_region(node, d, region);
            if (slot != kNone) {
                relax(from, d, slot, strands_.strand_count(node, d));
            }
        }
    }
    return Outcome::exceeded;
}

void ClassEnumeration::relax(const Origin& from, Index dart, Index slot, Index strand_count)
{
    const Dart& along = strands_.graph().dart(dart);
    if (along.head != goal_ && !strands_.passable()[along.head]) {
        return;
    }
    const Length reached = from.distance + along.length;
    const Length estimate = reached + field_->bound(along.head);
    if (estimate >= limit_) {
        return;
    }
    const Index region = strands_.is_touched(along.head)
                             ? strands_.region(along.head, along.twin, strand_count - slot)
                             : 0;
    if (along.head == goal_ && region != goal_sector_) {
        return;
    }
    const Index word = cuts_->advance(words_, from.word, dart, start_vertex_);
    const Index state = strands_.state(along.head, region);
    const std::size_t bucket = this->bucket(state, word);
    Index found = find(bucket, state, word);
    const bool goes_on = from.label != kNone && from.word == word;
    if (found == kNone) {
        if (label_counts_[state]++ == 0) {
            used_states_.push_back(state);
        }
        found = static_cast<Index>(labels_.size());
        labels_.push_back({reached, state, word, from.label, buckets_[bucket],
                           goes_on ? from.entry : found, dart, 0, 0});
        jumps_.push_back({found, 0});
        buckets_[bucket] = found;
        if (labels_.size() > kBucketLoad * buckets_.size()) {
            grow_buckets();
        }
    } else {
        Label& label = labels_[found];
        if (reached >= label.distance) {
            label.is_tied |= reached == label.distance ? 1U : 0U;
            return;
        }
        label.distance = reached;
        label.parent = from.label;
        label.parent_dart = dart;
        label.is_tied = 0;
        label.entry = goes_on ? from.entry : found;
    }
    queue_.push({estimate, along.head == goal_ ? found | kIsGoal : found, along.head});
}

/// Neighbouring states with the same word are in neighbouring buckets, as they come up together.
std::size_t ClassEnumeration::bucket(Index state, Index word) const
{
    return (state + (word * kHashFactor >> 32U)) & (buckets_.size() - 1);
}

/// The label of a state with a word, which is in this bucket if there is one; kNone.
Index ClassEnumeration::find(std::size_t bucket, Index state, Index word)
{
    Index label = buckets_[bucket];
    ++label_count_;
    while (label != kNone && (labels_[label].state != state || labels_[label].word != word)) {
        label = labels_[label].next;
        ++label_count_;
    }
    return label;
}

void ClassEnumeration::grow_buckets()
{
    const std::size_t size = 2 * buckets_.size();
    buckets_ = {};  // not both at a time
    buckets_.assign(size, kNone);
    for (Index label = 0; label < labels_.size(); ++label) {
        Index& first = buckets_[bucket(labels_[label].state, labels_[label].word)];
        labels_[label].next = std::exchange(first, label);
    }
}

/// No shorter walk will come to this label. Jumps are as long as those of the skew-binary numbers
/// (Myers 1983), so that a few of them lead anywhere.
void ClassEnumeration::close(Index label)
{
    labels_[label].is_closed = 1;
    const Index parent = labels_[label].parent;
    if (parent == kNone) {
        return;
    }
    const Jump of_parent = jumps_[parent];
    const Jump before = jumps_[of_parent.to];
    const bool goes_further =
        of_parent.depth - before.depth == before.depth - jumps_[before.to].depth;
    jumps_[label] = {goes_further ? before.to : parent, of_parent.depth + 1};
}

/// Whether the walk to the closed label `to` comes by `label`, which is nearer to the start.
bool ClassEnumeration::is_on_the_way(Index label, Index to)
{
    const Length distance = labels_[label].distance;
    while (labels_[to].distance > distance && labels_[to].parent != kNone) {
        ++label_count_;
        to = labels_[jumps_[to].to].distance >= distance ? jumps_[to].to : labels_[to].parent;
    }
    return to == label;
}

/// Whether a stretch that the walk to a label shares with itself ends right before it and crosses.
/// Beginnings of shortest walks of simple classes never have one (proof.md, Sec. 3).
bool ClassEnumeration::crosses_itself(Index label)
{
    const Index parent = labels_[label].parent;
    if (parent == kNone) {
        return false;
    }
    const Index state = labels_[parent].state;
    if (label_counts_[state] == 1) {
        return false;  // no other walk has been there
    }
    // The walk itself can only have been there with another word that it has had.
    bool returns = false;
    for (Index l = labels_[labels_[parent].entry].parent; l != kNone && !returns;
         l = labels_[labels_[l].entry].parent) {
        const Index word = labels_[l].word;
        const Index other = find(bucket(state, word), state, word);
        returns = other != kNone && other != parent && labels_[other].entry == labels_[l].entry &&
                  labels_[other].distance < labels_[parent].distance &&
                  is_on_the_way(other, parent);
    }
    if (!returns) {
        return false;
    }
    const PathGraph& graph = strands_.graph();
    reversed_.clear();
    for (Index l = label; l != kNone; l = labels_[l].parent) {
        ++label_count_;
        reversed_.push_back(graph.twin(labels_[l].parent_dart));
    }
    const Index node = strands_.node_of_state(state);
    for (Index k = 1; k + 1 < reversed_.size(); ++k) {
        if (graph.head(reversed_[k]) == node &&
            stretch_crosses(graph, reversed_, 0, reversed_, k)) {
            return true;
        }
    }
    return false;
}

std::vector<Index> ClassEnumeration::blockers() const
{
    std::vector<Index> blockers = met_;
    strands_.append_sector_neighbours(2 * layout_edge_, blockers);
    strands_.append_sector_neighbours(2 * layout_edge_ + 1, blockers);
    std::sort(blockers.begin(), blockers.end());
    blockers.erase(std::unique(blockers.begin(), blockers.end()), blockers.end());
    return blockers;
}

/// Whether a tie lies on the way.
bool ClassEnumeration::collect_walk(Index label)
{
    darts_.clear();
    bool tied = false;
    for (; label != kNone; label = labels_[label].parent) {
        tied = tied || labels_[label].is_tied;
        darts_.push_back(labels_[label].parent_dart);
    }
    std::reverse(darts_.begin(), darts_.end());
    return tied;
}

bool walk_crosses_itself(const PathGraph& graph, const std::vector<Index>& darts)
{
    struct Visit {
        Index node;
        Index place;
    };
    std::vector<Visit> visits;
    for (Index k = 0; k + 1 < darts.size(); ++k) {
        visits.push_back({graph.head(darts[k]), k});
    }
    std::sort(visits.begin(), visits.end(), [](const Visit& x, const Visit& y) {
        return x.node != y.node ? x.node < y.node : x.place < y.place;
    });
    for (std::size_t begin = 0; begin < visits.size();) {
        std::size_t end = begin;
        while (end < visits.size() && visits[end].node == visits[begin].node) {
            ++end;
        }
        for (std::size_t x = begin; x < end; ++x) {
            for (std::size_t y = begin; y < end; ++y) {
                if (x != y &&
                    stretch_crosses(graph, darts, visits[x].place, darts, visits[y].place)) {
                    return true;
                }
            }
        }
        begin = end;
    }
    return false;
}

}  // namespace layout_embedding
