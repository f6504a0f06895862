#include "search/branch_and_bound.hh"

#include <algorithm>

#include "base/random.hh"
#ifdef LAYOUT_EMBEDDING_DEBUG_CHECKS
#include <cassert>

#include "surface/conflicts.hh"
#endif

namespace layout_embedding {

namespace {

// What the evaluation of a child charges: with all answers remembered it takes about as long as
// this many expansions.
std::uint64_t child_work(Index edge_count, Index pair_count)
{
    return 4 + edge_count / 12 + pair_count / 8;
}

#ifdef LAYOUT_EMBEDDING_DEBUG_CHECKS
/// What delayed insertion stands on (paper, Appendix A): conflicts are those that the strands
/// themselves show, and inserting a candidate leaves every other one that does not conflict with it
/// as it is.
void assert_conflicts(PartialEmbedding& embedding, const std::vector<Index>& candidates,
                      const CandidateConflicts& conflicts)
{
    const WalkPool& pool = embedding.pool();
    [[maybe_unused]] const bool moved = embedding.move_strands();
    assert(moved);
    std::vector<CandidateWalk> walks;
    std::vector<Index> edges;
    for (Index e = 0; e < candidates.size(); ++e) {
        if (embedding.walk(e) == kNone) {
            assert(embedding.strands().trace(e, pool.darts(candidates[e])));
            walks.push_back({e, pool.darts(candidates[e])});
            edges.push_back(e);
        }
    }
    CandidateConflicts seen;
    const Conflicts on_strands = find_conflicts(embedding.strands(), walks);
    for (const auto& [a, b] : on_strands.pairs) {
        seen.pairs.emplace_back(edges[a], edges[b]);
    }
    for (const auto& [a, b, c] : on_strands.triples) {
        seen.triples.push_back({edges[a], edges[b], edges[c]});
    }
    assert(seen.pairs == conflicts.pairs);
    assert(seen.triples == conflicts.triples);
    for (const Index e : edges) {
        std::vector<Index> partners;
        for (const auto& [a, b] : conflicts.pairs) {
            if (a == e || b == e) {
                partners.push_back(a == e ? b : a);
            }
        }
        std::sort(partners.begin(), partners.end());
        assert(partners == embedding.conflicting_with(e, candidates));
    }
}
#endif

}  // namespace

BranchAndBound::BranchAndBound(PartialEmbedding& embedding, PathOracle& oracle,
                               DistanceFields& fields, Incumbent& incumbent,
                               const BranchAndBoundOptions& options)
    : embedding_(embedding),
      oracle_(oracle),
      incumbent_(incumbent),
      options_(options),
      edge_count_(embedding.layout().edge_count()),
      pairs_(embedding, oracle, fields),
      candidates_(edge_count_, kNone)
{}

Length BranchAndBound::prune_threshold() const
{
    if (!incumbent_.exists()) {
        return kInfiniteLength;
    }
    return incumbent_.cost() -
           static_cast<Length>(options_.gap * static_cast<double>(incumbent_.cost()));
}

Length BranchAndBound::lower_bound() const
{
    if (next_root_ < edge_count_) {
        return 0;
    }
    if (nodes_.empty() && !finished_) {
        return root_bound_;
    }
    Length bound = std::min(pruned_bound_, incumbent_.cost());
    if (!open_bounds_.empty()) {
        bound = std::min(bound, open_bounds_.begin()->first);
    }
    if (current_ != kNone) {
        bound = std::min(bound, nodes_[current_].bound);
    }
    return std::max(bound, root_bound_);
}

bool BranchAndBound::bound_has_risen()
{
    const Length bound = lower_bound();
    if (bound == kInfiniteLength || bound < told_bound_ + told_bound_ / 1000 + 1) {
        return false;
    }
    told_bound_ = bound;
    return true;
}

void BranchAndBound::drop(Length bound)
{
    ++(bound == kInfiniteLength ? counters_.dead_ends : counters_.states_pruned);
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
std::vector<Index> BranchAndBound::find_branches(std::size_t& conflict_count)
{
    const CandidateConflicts conflicts = embedding_.conflicts(candidates_);
#ifdef LAYOUT_EMBEDDING_DEBUG_CHECKS
    assert_conflicts(embedding_, candidates_, conflicts);
#endif
    std::vector<Index> conflicting = conflicts.edges();
    conflict_count = conflicting.size();
    if (options_.delay_non_conflicting) {
        return conflicting;
    }
    std::vector<Index> open;
    for (Index e = 0; e < edge_count_; ++e) {
        if (embedding_.walk(e) == kNone) {
            open.push_back(e);
        }
    }
    return open;
}

BranchAndBound::Outcome BranchAndBound::find_root(WorkBudget& budget)
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
        ++next_root_;
    }
    // The root state; it is the solution already if no candidates conflict.
    child_ = {};
    child_.bound = root_bound_;
    child_.updates = candidates_;
    told_bound_ = root_bound_;
    if (options_.pairwise_bounds && options_.candidate_bounds) {
        pairs_.begin(candidates_);
    } else {
        has_pairs_ = true;
    }
    return Outcome::bounded;
}

/// What conflicting pairs cost together, at the root.
BranchAndBound::Outcome BranchAndBound::find_pairs(WorkBudget& budget)
{
    switch (pairs_.run(budget)) {
        case PairwiseBound::Outcome::running:
            return Outcome::running;
        case PairwiseBound::Outcome::tied:
            return Outcome::tied;
        case PairwiseBound::Outcome::finished:
            break;
    }
    has_pairs_ = true;
    root_bound_ += std::min(pair_surplus(), kInfiniteLength - root_bound_);
    if (root_bound_ == kInfiniteLength) {
        finished_ = true;
        return Outcome::finished;
    }
    told_bound_ = root_bound_;
    return Outcome::bounded;
}

/// How much more than embedded paths and candidates the present state costs at least, by pairs.
Length BranchAndBound::pair_surplus()
{
    if (pairs_.pair_count() == 0) {
        return 0;
    }
    costs_.clear();
    for (Index e = 0; e < edge_count_; ++e) {
        const Index walk = embedding_.walk(e) == kNone ? candidates_[e] : embedding_.walk(e);
        costs_.push_back(embedding_.pool().cost(walk));
    }
    return pairs_.surplus(costs_);
}

SearchCounters BranchAndBound::counters() const
{
    SearchCounters counters = counters_;
    counters.expansions += pairs_.expansion_count();
    return counters;
}

BranchAndBound::Outcome BranchAndBound::run(WorkBudget& budget)
{
    if (next_root_ < edge_count_) {
        return find_root(budget);
    }
    if (!has_pairs_ && !finished_) {
        return find_pairs(budget);
    }
    if (nodes_.empty() && !finished_) {
        const Outcome outcome = add_state(kNone, 0);
        if (outcome != Outcome::finished) {
            return outcome;
        }
    }
    while (!finished_) {
        if (current_ == kNone && !take_node()) {
            finished_ = true;
            break;
        }
        while (next_branch_ < branches_.size()) {
            const Outcome outcome = evaluate_child(budget);
            if (outcome != Outcome::finished) {
                return outcome;
            }
        }
        current_ = kNone;
        if (bound_has_risen()) {
            return Outcome::bounded;
        }
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
        ++counters_.states_expanded;
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
        candidate_bound_ = embedding_.cost();
        for (Index e = 0; e < edge_count_; ++e) {
            if (embedding_.walk(e) == kNone) {
                candidate_bound_ += embedding_.pool().cost(candidates_[e]);
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
BranchAndBound::Outcome BranchAndBound::evaluate_child(WorkBudget& budget)
{
    const Index edge = branches_[next_branch_];
    if (!in_child_) {
        if (budget.is_spent()) {
            return Outcome::running;
        }
        budget.charge(child_work(edge_count_, pairs_.pair_count()));
        const Outcome outcome = begin_child(edge);
        if (!in_child_) {
            return outcome;
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
            case PathOracle::Outcome::given_up:
                drop(others + answer.bound);
                end_child();
                return Outcome::finished;
        }
        ++child_.next;
    }
    return finish_child(edge);
}

/// Goes to the child; `running` if it is to be evaluated, `finished` if that is done already.
BranchAndBound::Outcome BranchAndBound::begin_child(Index edge)
{
    const Index walk = candidates_[edge];
    const std::uint64_t hash = nodes_[current_].hash + Random::mix(walk + 1);
    if (options_.detect_redundant_states && is_redundant(hash, walk)) {
        ++counters_.states_redundant;
        ++next_branch_;
        return Outcome::finished;
    }
    std::vector<Index> open = embedding_.conflicting_with(edge, candidates_);
    switch (embedding_.insert(walk)) {
        case PartialEmbedding::Insertion::done:
            break;
        case PartialEmbedding::Insertion::refused:
            // The hole would stay where it is.
            drop(kInfiniteLength);
            ++next_branch_;
            return Outcome::finished;
        case PartialEmbedding::Insertion::torn:
            return Outcome::tied;
    }
    child_ = {};
    child_.bound = candidate_bound_;
    for (const Index e : open) {
        const Length candidate = embedding_.pool().cost(candidates_[e]);
        const Length bound = std::max(candidate, oracle_.known_bound(e));
        if (bound == kInfiniteLength) {
            drop(kInfiniteLength);
            embedding_.undo();
            ++next_branch_;
            return Outcome::finished;
        }
        child_.bound += bound - candidate;
    }
    child_.open = std::move(open);
    if (options_.candidate_bounds && child_.bound >= prune_threshold()) {
        drop(child_.bound);
        embedding_.undo();
        ++next_branch_;
        return Outcome::finished;
    }
    in_child_ = true;
    return Outcome::running;
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
    const Length bound =
        options_.candidate_bounds
            ? child_.bound + std::min(pair_surplus(), kInfiniteLength - child_.bound)
            : embedding_.cost();
    if (bound >= prune_threshold() || nodes_.size() >= options_.max_states) {
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
    ++counters_.states_created;
    return Outcome::finished;
}

/// Embeds all candidates of the present state, which do not conflict, and goes back to it.
BranchAndBound::Outcome BranchAndBound::accept_candidates()
{
    const std::size_t depth = embedding_.sequence().size();
    auto insertion = PartialEmbedding::Insertion::done;
    for (Index e = 0; e < edge_count_ && insertion == PartialEmbedding::Insertion::done; ++e) {
        if (embedding_.walk(e) == kNone) {
            insertion = embedding_.insert(candidates_[e]);
        }
    }
    auto outcome = Incumbent::Outcome::rejected;
    if (insertion == PartialEmbedding::Insertion::done) {
        outcome = incumbent_.offer(embedding_);
    } else if (insertion == PartialEmbedding::Insertion::torn) {
        outcome = Incumbent::Outcome::tied;
    }
    while (embedding_.sequence().size() > depth) {
        embedding_.undo();
    }
    switch (outcome) {
        case Incumbent::Outcome::accepted:
            return Outcome::improved;
        case Incumbent::Outcome::tied:
            return Outcome::tied;
        case Incumbent::Outcome::rejected:
        case Incumbent::Outcome::excluded:
            break;
    }
    return Outcome::finished;
}

void BranchAndBound::end_child()
{
    embedding_.undo();
    in_child_ = false;
    ++next_branch_;
}

}  // namespace layout_embedding
