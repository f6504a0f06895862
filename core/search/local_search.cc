#include "search/local_search.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

// Random restarts in a row that bring nothing.
constexpr Index kMaxKicks = 12;
// Edges that a restart moves.
constexpr int kKickMoves = 3;
// What inserting one path of a trial charges, in expansions.
constexpr std::uint64_t kInsertionWork = 4;

}  // namespace

LocalSearch::LocalSearch(PartialEmbedding& embedding, PathOracle& oracle, Incumbent& incumbent,
                         std::vector<Index> root_walks)
    : embedding_(embedding),
      oracle_(oracle),
      incumbent_(incumbent),
      root_walks_(std::move(root_walks)),
      current_(incumbent.walks()),
      current_cost_(incumbent.cost())
{
    find_moves();
}

void LocalSearch::allow(std::uint64_t work)
{
    is_resumed_ = max_work_ > 0;
    max_work_ = work_ + work;
    kicks_ = 0;
    is_exhausted_ = current_.size() < 3;
    if (incumbent_.cost() < current_cost_ && !in_trial_) {
        current_ = incumbent_.walks();
        current_cost_ = incumbent_.cost();
        find_moves();
    }
}

/// Whether an embedded walk could keep another edge from taking its unconstrained path.
bool LocalSearch::in_the_way(Index walk, Index root_walk) const
{
    const WalkPool& pool = embedding_.pool();
    const Layout& layout = embedding_.layout();
    if (pool.cross(walk, root_walk)) {
        return true;
    }
    const Index a = pool.layout_edge(walk);
    const Index b = pool.layout_edge(root_walk);
    for (const Index h : {2 * a, 2 * a + 1}) {
        for (const Index g : {2 * b, 2 * b + 1}) {
            if (layout.tail(h) == layout.tail(g)) {
                return true;
            }
        }
    }
    return false;
}

void LocalSearch::find_moves()
{
    const WalkPool& pool = embedding_.pool();
    struct Rated {
        Length excess;
        Index place;
    };
    std::vector<Rated> rated;
    for (Index i = 0; i < current_.size(); ++i) {
        const Index root = root_walks_[pool.layout_edge(current_[i])];
        if (current_[i] != root) {
            rated.push_back({pool.cost(current_[i]) - pool.cost(root), i});
        }
    }
    std::sort(rated.begin(), rated.end(), [](const Rated& a, const Rated& b) {
        return a.excess != b.excess ? a.excess > b.excess : a.place < b.place;
    });
    moves_.clear();
    next_move_ = 0;
    for (const Rated& edge : rated) {
        const Index root = root_walks_[pool.layout_edge(current_[edge.place])];
        for (Index i = 0; i < edge.place; ++i) {
            if (in_the_way(current_[i], root)) {
                moves_.push_back({edge.place, i});
            }
        }
    }
}

void LocalSearch::begin_trial(const Move& move)
{
    const WalkPool& pool = embedding_.pool();
    trial_.clear();
    for (const Index walk : current_) {
        trial_.push_back(pool.layout_edge(walk));
    }
    std::rotate(trial_.begin() + move.to, trial_.begin() + move.from,
                trial_.begin() + move.from + 1);
    trial_next_ = move.to;
    trial_limit_ = current_cost_;
    in_trial_ = true;
    is_kick_ = false;
    embedding_.go_to(std::span(current_).first(trial_next_));
}

/// Begins a trial that takes out the walks of the edges at a random vertex, or at that and its
/// neighbours, and puts them back in a random order.
void LocalSearch::begin_reinsertion()
{
    const Layout& layout = embedding_.layout();
    const WalkPool& pool = embedding_.pool();
    std::vector<bool> is_near(layout.vertex_count(), false);
    const auto middle = static_cast<Index>(random_.below(layout.vertex_count()));
    is_near[middle] = true;
    if (random_.below(2) == 0) {
        for (const Index h : layout.outgoing(middle)) {
            is_near[layout.head(h)] = true;
        }
    }
    std::vector<Index> kept;
    std::vector<Index> taken_out;
    trial_.clear();
    for (const Index walk : current_) {
        const Index e = pool.layout_edge(walk);
        if (is_near[layout.tail(2 * e)] || is_near[layout.head(2 * e)]) {
            taken_out.push_back(e);
        } else {
            kept.push_back(walk);
            trial_.push_back(e);
        }
    }
    for (auto i = taken_out.size(); i > 1; --i) {
        std::swap(taken_out[i - 1], taken_out[random_.below(i)]);
    }
    trial_next_ = trial_.size();
    trial_.insert(trial_.end(), taken_out.begin(), taken_out.end());
    trial_limit_ = current_cost_;
    in_trial_ = true;
    is_kick_ = false;
    embedding_.go_to(kept);
}

/// Begins a trial far from the best order: some edges moved, or all paths around a vertex put back
/// in another one. False if this has been tried often enough.
bool LocalSearch::begin_kick()
{
    if (kicks_ == kMaxKicks || current_.size() < 3) {
        return false;
    }
    ++kicks_;
    current_ = incumbent_.walks();
    if (random_.below(2) == 0) {
        begin_trial({0, 0});
        for (int i = 0; i < kKickMoves; ++i) {
            const Index from = static_cast<Index>(random_.below(trial_.size()));
            const Index to = static_cast<Index>(random_.below(from + 1));
            std::rotate(trial_.begin() + to, trial_.begin() + from, trial_.begin() + from + 1);
        }
    } else {
        begin_reinsertion();
    }
    trial_limit_ = kInfiniteLength;
    is_kick_ = true;
    return true;
}

LocalSearch::Outcome LocalSearch::run(WorkBudget& budget)
{
    for (;;) {
        if (!in_trial_) {
            // Between orders only: no search of the oracle is left unfinished.
            if (work_ >= max_work_) {
                return Outcome::finished;
            }
            if (is_resumed_ && random_.below(2) == 0) {
                begin_reinsertion();
            } else if (next_move_ < moves_.size()) {
                begin_trial(moves_[next_move_++]);
            } else if (!begin_kick()) {
                is_exhausted_ = true;
                return Outcome::finished;
            }
            budget.charge(1);
            ++work_;
            const WalkPool& pool = embedding_.pool();
            rest_bound_ = 0;
            for (std::size_t i = trial_next_; i < trial_.size(); ++i) {
                rest_bound_ += pool.cost(root_walks_[trial_[i]]);
            }
        }
        const std::uint64_t before = budget.spent();
        const Outcome outcome = evaluate(budget);
        work_ += budget.spent() - before;
        if (outcome == Outcome::running || outcome == Outcome::tied) {
            return outcome;
        }
        in_trial_ = false;
        if (outcome == Outcome::improved) {
            const auto offered = incumbent_.offer(embedding_);
            if (offered == Incumbent::Outcome::tied) {
                return Outcome::tied;
            }
            if (offered == Incumbent::Outcome::excluded) {
                continue;
            }
            current_ = embedding_.sequence();
            current_cost_ = embedding_.cost();
            find_moves();
            if (offered == Incumbent::Outcome::accepted) {
                kicks_ = 0;
                return Outcome::improved;
            }
        } else if (is_kick_) {
            // No embedding in this order.
            next_move_ = moves_.size();
        }
    }
}

/// Inserts the rest of the trial; `improved` if it is complete and below the limit, `finished` if
/// it is not.
LocalSearch::Outcome LocalSearch::evaluate(WorkBudget& budget)
{
    const WalkPool& pool = embedding_.pool();
    while (trial_next_ < trial_.size()) {
        if (budget.is_spent()) {
            return Outcome::running;
        }
        const Index edge = trial_[trial_next_];
        const Length root = pool.cost(root_walks_[edge]);
        const Length others = embedding_.cost() + rest_bound_ - root;
        if (others + root >= trial_limit_) {
            return Outcome::finished;
        }
        const Length limit =
            trial_limit_ == kInfiniteLength ? kInfiniteLength : trial_limit_ - others;
        const auto answer = oracle_.find(edge, limit, budget);
        switch (answer.outcome) {
            case PathOracle::Outcome::running:
                return Outcome::running;
            case PathOracle::Outcome::tied:
                return Outcome::tied;
            case PathOracle::Outcome::blocked:
            case PathOracle::Outcome::exceeded:
            case PathOracle::Outcome::given_up:
                return Outcome::finished;
            case PathOracle::Outcome::found:
                break;
        }
        budget.charge(kInsertionWork);
        switch (embedding_.insert(answer.walk)) {
            case PartialEmbedding::Insertion::done:
                break;
            case PartialEmbedding::Insertion::refused:
                return Outcome::finished;
            case PartialEmbedding::Insertion::torn:
                return Outcome::tied;
        }
        rest_bound_ -= root;
        ++trial_next_;
    }
    return embedding_.cost() < trial_limit_ ? Outcome::improved : Outcome::finished;
}

}  // namespace layout_embedding
