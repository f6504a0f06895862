#include "surface/class_enumeration.hh"

#include <algorithm>

#include "surface/stretch.hh"

namespace layout_embedding {

ClassEnumeration::ClassEnumeration(const Strands& strands, DistanceFields& fields,
                                   const CutSystem& cuts, Index layout_edge)
    : strands_(strands),
      fields_(fields),
      cuts_(cuts),
      start_vertex_(strands.layout().tail(2 * layout_edge)),
      goal_vertex_(strands.layout().head(2 * layout_edge)),
      start_(strands.landmark_node(start_vertex_)),
      goal_(strands.landmark_node(goal_vertex_))
{
    field_ = &fields_.get(goal_, start_);
    states_.push_back({start_, Words::kEmpty, 0, kNone, kNone, false, false});
    queue_.push({field_->bound(start_), 0});
}

Length ClassEnumeration::frontier() const
{
    return queue_.empty() ? kInfiniteLength : queue_.top().estimate;
}

ClassEnumeration::Outcome ClassEnumeration::run(Length limit, std::uint64_t max_expansions)
{
    const PathGraph& graph = strands_.graph();
    // Others may have used the fields meanwhile.
    field_ = &fields_.get(goal_, start_);
    while (!queue_.empty()) {
        const QueueItem item = queue_.top();
        if (states_[item.state].is_closed) {
            queue_.pop();
            continue;
        }
        if (item.estimate >= limit) {
            return Outcome::exceeded;
        }
        if (max_expansions-- == 0) {
            return Outcome::running;
        }
        queue_.pop();
        states_[item.state].is_closed = true;
        const Index node = states_[item.state].node;
        if (node == goal_) {
            if (classes_.insert(goal_class(states_[item.state].word)).second) {
                cost_ = states_[item.state].distance;
                return collect_walk(item.state) ? Outcome::tied : Outcome::found;
            }
            continue;
        }
        for (Index d = graph.first_dart(node); d < graph.first_dart(node + 1); ++d) {
            relax(item.state, d);
        }
    }
    return Outcome::exceeded;
}

void ClassEnumeration::relax(Index from_state, Index dart)
{
    const PathGraph& graph = strands_.graph();
    const Index head = graph.head(dart);
    if (head != goal_ && !strands_.passable()[head]) {
        return;
    }
    const Index word = cuts_.advance(words_, states_[from_state].word, dart, start_vertex_);
    const Length reached = states_[from_state].distance + graph.dart(dart).length;
    const auto [place, is_new] = states_by_key_.try_emplace(std::uint64_t{head} << 32U | word,
                                                            static_cast<Index>(states_.size()));
    if (is_new) {
        states_.push_back({head, word, reached, from_state, dart, false, false});
    } else {
        State& state = states_[place->second];
        if (reached >= state.distance) {
            state.is_tied = state.is_tied || reached == state.distance;
            return;
        }
        state.distance = reached;
        state.parent = from_state;
        state.parent_dart = dart;
        state.is_tied = false;
        // A field that was extended in between is not consistent with what it was.
        state.is_closed = false;
    }
    queue_.push({reached + field_->bound(head), place->second});
}

/// The word that stands for all that differ by turns around the goal.
Index ClassEnumeration::goal_class(Index word)
{
    const Words::Letter own = CutSystem::letter(goal_vertex_);
    while (words_.last(word) == own || words_.last(word) == -own) {
        word = words_.prefix(word);
    }
    return word;
}

/// Whether a tie lies on the way.
bool ClassEnumeration::collect_walk(Index state)
{
    darts_.clear();
    bool tied = false;
    for (; states_[state].parent != kNone; state = states_[state].parent) {
        tied = tied || states_[state].is_tied;
        darts_.push_back(states_[state].parent_dart);
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
