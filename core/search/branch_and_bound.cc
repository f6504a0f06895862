#include "search/branch_and_bound.hh"

#include <algorithm>

#include "base/random.hh"
#include "surface/conflicts.hh"

namespace layout_embedding {

BranchAndBound::BranchAndBound(PartialEmbedding& embedding, PathOracle& oracle,
                               const BranchAndBoundOptions& options)
    : embedding_(embedding),
      oracle_(oracle),
      options_(options),
      edge_count_(embedding.strands().layout().edge_count()),
      candidates_(edge_count_, kNone)
{}

Length BranchAndBound::prune_threshold() const
{
    if (incumbent_cost_ == kInfiniteLength) {
        return kInfiniteLength;
    }
    return incumbent_cost_ -
           static_cast<Length>(options_.gap * static_cast<double>(incumbent_cost_));
}

Length BranchAndBound::lower_bound() const
{
    if (next_root_ < edge_count_) {
        return 0;
    }
    if (nodes_.empty() && incumbent_.empty()) {
        return root_bound_;
    }
    Length bound = std::min(pruned_bound_, incumbent_cost_);
    if (!open_bounds_.empty()) {
        bound = std::min(bound, open_bounds_.begin()->first);
    }
    if (current_ != kNone) {
        bound = std::min(bound, nodes_[current_].bound);
    }
    return std::max(bound, root_bound_);
}

bool BranchAndBound::offer(const std::vector<Index>& walks, Length cost)
{
    if (cost >= incumbent_cost_) {
        return false;
    }
    incumbent_ = walks;
    incumbent_cost_ = cost;
    return true;
}

void BranchAndBound::drop(Length bound)
{
    ++(bound == kInfiniteLength ? counters_.dead_ends : counters_.pruned);
    pruned_bound_ = std::min(pruned_bound_, bound);
}

std::vector<Index> BranchAndBound::sequence(Index node) const
{
    std::vector<Index> walks;
    for (; nodes_[node].parent != kNone; node = nodes_[node].parent) {
        walks.push_back(nodes_[node].walk);
    }
    std::reverse(walks.begin(), walks.end());
    return walks;
}

bool BranchAndBound::is_redundant(std::uint64_t hash, Index walk)
{
    // The state is the present one and `walk`, whatever the order; walks tell states apart.
    const auto [begin, end] = nodes_by_hash_.equal_range(hash);
    if (begin == end) {
        return false;
    }
    std::vector<Index> here = embedding_.sequence();
    here.push_back(walk);
    std::sort(here.begin(), here.end());
    return std::any_of(begin, end, [&](const auto& entry) {
        std::vector<Index> there = sequence(entry.second);
        std::sort(there.begin(), there.end());
        return here == there;
    });
}

/// The edges to branch on in the present state; none if it is a solution.
std::vector<Index> BranchAndBound::find_branches(std::size_t& conflict_count) const
{
    std::vector<CandidateWalk> candidates;
    std::vector<Index> open;
    for (Index e = 0; e < edge_count_; ++e) {
        if (embedding_.walk(e) == kNone) {
            candidates.push_back({e, embedding_.pool().darts(candidates_[e])});
            open.push_back(e);
        }
    }
    const Conflicts conflicts = find_conflicts(embedding_.strands(), candidates);
    std::vector<bool> is_conflicting(open.size(), false);
    for (const auto& [a, b] : conflicts.pairs) {
        is_conflicting[a] = is_conflicting[b] = true;
    }
    for (const auto& triple : conflicts.triples) {
        for (const Index c : triple) {
            is_conflicting[c] = true;
        }
    }
    std::vector<Index> conflicting;
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (is_conflicting[i]) {
            conflicting.push_back(open[i]);
        }
    }
    conflict_count = conflicting.size();
    return options_.delay_non_conflicting ? conflicting : open;
}

BranchAndBound::Outcome BranchAndBound::run(std::uint64_t budget)
{
    while (next_root_ < edge_count_) {
        const auto answer = oracle_.find(next_root_, kInfiniteLength, budget);
        switch (answer.outcome) {
            case PathOracle::Outcome::running:
                return Outcome::running;
            case PathOracle::Outcome::tied:
                return Outcome::tied;
            case PathOracle::Outcome::found:
                candidates_[next_root_] = answer.walk;
                root_bound_ += answer.bound;
                break;
            default:
                // An edge without any path: no embedding exists.
                next_root_ = edge_count_;
                root_bound_ = kInfiniteLength;
                finished_ = true;
                return Outcome::finished;
        }
        if (++next_root_ == edge_count_) {
            return Outcome::bounded;
        }
    }
    if (nodes_.empty() && !finished_) {
        // The root state; it is the solution already if no candidates conflict.
        child_.bound = root_bound_;
        child_.updates = candidates_;
        if (add_state(kNone, 0) == Outcome::improved) {
            return Outcome::improved;
        }
    }
    while (!finished_) {
        if (current_ == kNone) {
            if (!take_node()) {
                finished_ = true;
                break;
            }
        }
        while (next_branch_ < branches_.size()) {
            const Outcome outcome = evaluate_child(budget);
            if (outcome != Outcome::finished) {
                return outcome;
            }
        }
        current_ = kNone;
    }
    return Outcome::finished;
}

/// Takes the next state from the queue and goes there; false if there is nothing left to do.
bool BranchAndBound::take_node()
{
    for (;;) {
        if (queue_.empty() || lower_bound() >= prune_threshold()) {
            return false;
        }
        const Index node = queue_.front().node;
        std::pop_heap(queue_.begin(), queue_.end());
        queue_.pop_back();
        open_bounds_.erase({nodes_[node].bound, node});
        if (nodes_[node].bound >= prune_threshold()) {
            drop(nodes_[node].bound);
            continue;
        }
        ++counters_.expanded;
        current_ = node;
        embedding_.go_to(sequence(node));
        // Candidates: the latest update of every edge on the way up to the root.
        candidates_.assign(edge_count_, kNone);
        for (Index n = node; n != kNone; n = nodes_[n].parent) {
            for (const Index walk : nodes_[n].updates) {
                Index& candidate = candidates_[embedding_.pool().layout_edge(walk)];
                if (candidate == kNone) {
                    candidate = walk;
                }
            }
        }
        std::size_t conflict_count = 0;
        branches_ = find_branches(conflict_count);
        next_branch_ = 0;
        in_child_ = false;
        return true;
    }
}

/// Evaluates the next child of the current node: `finished` if that is done.
BranchAndBound::Outcome BranchAndBound::evaluate_child(std::uint64_t& budget)
{
    const Index edge = branches_[next_branch_];
    if (!in_child_) {
        // Remembered answers cost no expansions, but the work of tracing all candidates.
        if (budget < edge_count_) {
            return Outcome::running;
        }
        budget -= edge_count_;
        begin_child(edge);
        if (!in_child_) {
            return Outcome::finished;
        }
    }
    while (child_.next < child_.open.size()) {
        const Index open = child_.open[child_.next];
        const Length known =
            std::max(embedding_.pool().cost(candidates_[open]), oracle_.known_bound(open));
        const Length others = child_.bound - known;
        const Length threshold = prune_threshold();
        const Length limit = threshold == kInfiniteLength || !options_.candidate_bounds
                                 ? kInfiniteLength
                                 : threshold - std::min(threshold, others);
        const auto answer = oracle_.find(open, limit, budget);
        switch (answer.outcome) {
            case PathOracle::Outcome::running:
                return Outcome::running;
            case PathOracle::Outcome::tied:
                return Outcome::tied;
            case PathOracle::Outcome::found:
                child_.updates.push_back(answer.walk);
                child_.bound = others + answer.bound;
                break;
            case PathOracle::Outcome::blocked:
                drop(kInfiniteLength);
                end_child();
                return Outcome::finished;
            case PathOracle::Outcome::exceeded:
                drop(others + answer.bound);
                end_child();
                return Outcome::finished;
        }
        ++child_.next;
    }
    return finish_child(edge);
}

void BranchAndBound::begin_child(Index edge)
{
    const Index walk = candidates_[edge];
    const std::uint64_t hash = nodes_[current_].hash + Random::mix(walk + 1);
    if (options_.detect_redundant_states && is_redundant(hash, walk)) {
        ++counters_.redundant;
        ++next_branch_;
        return;
    }
    if (!embedding_.insert(walk)) {
        // A hole would get into the wrong face, and stay there.
        drop(kInfiniteLength);
        ++next_branch_;
        return;
    }
    child_ = {};
    child_.bound = embedding_.cost();
    for (Index e = 0; e < edge_count_; ++e) {
        if (embedding_.walk(e) != kNone) {
            continue;
        }
        Length bound = embedding_.pool().cost(candidates_[e]);
        if (!embedding_.traces(candidates_[e])) {
            bound = std::max(bound, oracle_.known_bound(e));
            child_.open.push_back(e);
        }
        if (bound == kInfiniteLength) {
            drop(kInfiniteLength);
            embedding_.undo();
            ++next_branch_;
            return;
        }
        child_.bound += bound;
    }
    if (options_.candidate_bounds && child_.bound >= prune_threshold()) {
        drop(child_.bound);
        embedding_.undo();
        ++next_branch_;
        return;
    }
    in_child_ = true;
}

BranchAndBound::Outcome BranchAndBound::finish_child(Index edge)
{
    const Index walk = candidates_[edge];
    std::vector<Index> replaced;
    for (const Index update : child_.updates) {
        Index& candidate = candidates_[embedding_.pool().layout_edge(update)];
        replaced.push_back(candidate);
        candidate = update;
    }
    const Outcome outcome = add_state(walk, nodes_[current_].hash + Random::mix(walk + 1));
    for (const Index candidate : replaced) {
        candidates_[embedding_.pool().layout_edge(candidate)] = candidate;
    }
    end_child();
    return outcome;
}

/// Gives the present state, child_ with its candidates in place, to the queue, or takes it as a
/// solution if no candidates conflict any more.
BranchAndBound::Outcome BranchAndBound::add_state(Index walk, std::uint64_t hash)
{
    std::size_t conflict_count = 0;
    const std::vector<Index> branches = find_branches(conflict_count);
    if (branches.empty()) {
        return accept_candidates();
    }
    const Length bound = options_.candidate_bounds ? child_.bound : embedding_.cost();
    if (bound >= prune_threshold()) {
        drop(bound);
        return Outcome::finished;
    }
    const auto id = static_cast<Index>(nodes_.size());
    nodes_.push_back({current_, walk, bound, hash, std::move(child_.updates)});
    nodes_by_hash_.emplace(hash, id);
    const double priority = static_cast<double>(bound) *
                            (options_.mixed_priority ? static_cast<double>(conflict_count) : 1.0);
    queue_.push_back({priority, id});
    std::push_heap(queue_.begin(), queue_.end());
    open_bounds_.emplace(bound, id);
    ++counters_.created;
    return Outcome::finished;
}

/// Embeds all candidates of the present state, which do not conflict, and goes back to it.
BranchAndBound::Outcome BranchAndBound::accept_candidates()
{
    const std::size_t depth = embedding_.sequence().size();
    bool fits = true;
    for (Index e = 0; e < edge_count_ && fits; ++e) {
        fits = embedding_.walk(e) != kNone || embedding_.insert(candidates_[e]);
    }
    Outcome outcome = Outcome::finished;
    if (fits && offer(embedding_.sequence(), embedding_.cost())) {
        outcome = Outcome::improved;
    }
    while (embedding_.sequence().size() > depth) {
        embedding_.undo();
    }
    return outcome;
}

void BranchAndBound::end_child()
{
    embedding_.undo();
    in_child_ = false;
    ++next_branch_;
}

}  // namespace layout_embedding
