#include "search/choice_tree.hh"

#include <algorithm>
#include <bit>

namespace layout_embedding {

namespace {

// Bits of the upper bound that the relaxation computes with.
constexpr unsigned kBits = 44;
// Sweeps between two looks at the bound.
constexpr int kSweeps = 2;
// A node is left for its children when a round raises its bound by less than this share of what is
// missing, or after so many rounds; the root gets more.
constexpr ChoiceRelaxation::Cost kLeastGain = 200;
constexpr int kMostRounds = 6;
constexpr ChoiceRelaxation::Cost kLeastGainOfRoot = 3000;
constexpr int kMostRoundsOfRoot = 400;
// From a node down to a choice, as long as its bound is above the smallest by no more than this
// share of what is missing there.
constexpr ChoiceRelaxation::Cost kDive = 8;
// Table entries looked at in the time of a unit of work.
constexpr std::uint64_t kLooksPerWork = 64;

}  // namespace

ChoiceTree::ChoiceTree(Index edge_count, Length upper_bound)
    : relaxation_(edge_count),
      edges_(edge_count),
      upper_bound_(upper_bound),
      choices_(edge_count, kNone)
{
    const auto width = static_cast<unsigned>(std::bit_width(upper_bound));
    shift_ = width > kBits ? width - kBits : 0;
    lower_upper_bound(upper_bound);
    for (Index e = 0; e < edge_count; ++e) {
        add_label(e, kRest, kNone, 0, kNone);
    }
    open({0, next_id_++, {}, std::nullopt, {}});
}

void ChoiceTree::lower_upper_bound(Length cost)
{
    upper_bound_ = std::min(upper_bound_, cost);
    limit_ = scaled(upper_bound_ + ((Length{1} << shift_) - 1));
}

void ChoiceTree::expect_news()
{
    if (std::exchange(root_is_saved_, false)) {
        relaxation_.restore_messages();
    }
}

void ChoiceTree::add_label(Index edge, Index group, Index walk, Length cost, Index like)
{
    relaxation_.add_label(edge, group, scaled(cost), like);
    edges_[edge].labels.push_back({walk, cost});
    ++version_;
}

/// The label for a rest that costs at least so much, which is less than the upper bound.
Index ChoiceTree::rest_label(Index edge, Length cost)
{
    Edge& here = edges_[edge];
    Index below = kNone;
    for (Index label = 0; label < here.labels.size(); ++label) {
        const Label& known = here.labels[label];
        if (known.walk != kNone || known.cost > cost) {
            continue;
        }
        if (known.cost == cost) {
            return label;
        }
        below = below == kNone || known.cost > here.labels[below].cost ? label : below;
    }
    const auto label = static_cast<Index>(here.labels.size());
    add_label(edge, kRest, kNone, cost, below);
    for (const RestBound& bound : here.rest_bounds) {
        if (bound.cost > cost) {
            relaxation_.exclude(edge, label, places_[bound.walk].edge, places_[bound.walk].label);
        }
    }
    return label;
}

void ChoiceTree::add_class(Index edge, Index walk, Length cost)
{
    places_.resize(std::max<std::size_t>(places_.size(), walk + 1));
    if (places_[walk].edge != kNone || cost >= upper_bound_) {
        return;
    }
    Edge& here = edges_[edge];
    // It was part of the rest that costs no more.
    Index like = kNone;
    for (Index label = 0; label < here.labels.size(); ++label) {
        const Label& known = here.labels[label];
        if (known.walk == kNone && known.cost <= cost &&
            (like == kNone || known.cost > here.labels[like].cost)) {
            like = label;
        }
    }
    here.walks.push_back(walk);
    const auto group = static_cast<Index>(here.walks.size());
    places_[walk] = {edge, static_cast<Index>(here.labels.size()), group};
    add_label(edge, group, walk, cost, like);
}

void ChoiceTree::exclude(Index walk_a, Index walk_b)
{
    const Place& a = places_[walk_a];
    const Place& b = places_[walk_b];
    relaxation_.exclude(a.edge, a.label, b.edge, b.label);
    ++version_;
}

Index ChoiceTree::add_triangle(const std::array<Index, 3>& edges)
{
    ++version_;
    return relaxation_.add_triangle(edges);
}

Index ChoiceTree::add_tuple(Index triangle, const std::array<Index, 3>& walks)
{
    std::array<Index, 3> groups;
    for (int i = 0; i < 3; ++i) {
        groups[i] = walks[i] == kNone ? kRest : places_[walks[i]].group;
    }
    ++version_;
    return relaxation_.add_tuple(triangle, groups);
}

void ChoiceTree::add_bound(Index edge, std::span<const Index> walks, Length cost)
{
    Edge& here = edges_[edge];
    if (cost <= here.rest ||
        !std::all_of(walks.begin(), walks.end(), [&](Index walk) { return knows(walk); })) {
        return;
    }
    ++version_;
    if (cost < upper_bound_) {
        rest_label(edge, cost);
    }
    const auto for_each_cheaper = [&](const auto& visit) {
        for (Index label = 0; label < here.labels.size(); ++label) {
            if (here.labels[label].walk == kNone && here.labels[label].cost < cost) {
                visit(label);
            }
        }
    };
    if (walks.empty()) {
        here.rest = cost;
        for_each_cheaper([&](Index label) { relaxation_.rule_out_for_good(edge, label); });
    } else if (walks.size() == 1) {
        here.rest_bounds.push_back({walks[0], cost});
        const Place& blocker = places_[walks[0]];
        for_each_cheaper(
            [&](Index label) { relaxation_.exclude(edge, label, blocker.edge, blocker.label); });
    } else {
        Nogood nogood{{}, edge, cost};
        for (const Index walk : walks) {
            nogood.classes.push_back(places_[walk]);
        }
        nogoods_.push_back(std::move(nogood));
    }
}

void ChoiceTree::forbid(std::span<const Index> walks)
{
    if (!std::all_of(walks.begin(), walks.end(), [&](Index walk) { return knows(walk); })) {
        return;
    }
    ++version_;
    Nogood nogood{{}, kNone, 0};
    for (const Index walk : walks) {
        nogood.classes.push_back(places_[walk]);
    }
    nogoods_.push_back(std::move(nogood));
}

void ChoiceTree::open(Node node)
{
    open_.push_back(std::move(node));
    std::push_heap(open_.begin(), open_.end(), is_later);
}

ChoiceTree::Node ChoiceTree::take_best()
{
    std::pop_heap(open_.begin(), open_.end(), is_later);
    Node node = std::move(open_.back());
    open_.pop_back();
    return node;
}

/// Whether the class is the only one left of its edge.
bool ChoiceTree::is_decided(const Place& place) const
{
    const std::vector<Index>& left = relaxation_.left(place.edge);
    return left.size() == 1 && left[0] == place.label;
}

void ChoiceTree::apply(const std::vector<Decision>& decisions)
{
    relaxation_.bring_back();
    for (const Decision& decision : decisions) {
        take(decision);
    }
}

void ChoiceTree::take(const Decision& decision)
{
    const std::vector<Index> labels = relaxation_.left(decision.edge);
    for (const Index label : labels) {
        const Index group = relaxation_.group(decision.edge, label);
        // Classes that have become known since were part of the rest.
        const bool belongs =
            group == decision.group || (decision.group == kRest && group >= decision.group_count);
        if (belongs != decision.is_taken) {
            relaxation_.rule_out(decision.edge, label);
        }
    }
}

/// Rules out what would complete a set of classes that cannot be chosen together; whether that
/// changed anything.
bool ChoiceTree::apply_nogoods()
{
    bool changed = false;
    std::vector<Index> labels;
    for (const Nogood& nogood : nogoods_) {
        const Place* undecided = nullptr;
        bool is_far = false;
        for (const Place& place : nogood.classes) {
            if (!is_decided(place)) {
                is_far = undecided != nullptr || nogood.rest_edge != kNone;
                undecided = &place;
                if (is_far) {
                    break;
                }
            }
        }
        if (is_far) {
            continue;
        }
        if (nogood.rest_edge == kNone) {
            const Place& place = undecided != nullptr ? *undecided : nogood.classes.front();
            const std::vector<Index>& left = relaxation_.left(place.edge);
            if (std::binary_search(left.begin(), left.end(), place.label)) {
                relaxation_.rule_out(place.edge, place.label);
                changed = true;
            }
            continue;
        }
        labels = relaxation_.left(nogood.rest_edge);
        for (const Index label : labels) {
            const Label& here = edges_[nogood.rest_edge].labels[label];
            if (here.walk == kNone && here.cost < nogood.rest_cost) {
                relaxation_.rule_out(nogood.rest_edge, label);
                changed = true;
            }
        }
    }
    return changed;
}

/// Whether one class, or the rest, is left of every edge.
bool ChoiceTree::is_leaf() const
{
    for (Index e = 0; e < edges_.size(); ++e) {
        const std::vector<Index>& left = relaxation_.left(e);
        const Index group = relaxation_.group(e, left.front());
        if (std::any_of(left.begin(), left.end(),
                        [&](Index label) { return relaxation_.group(e, label) != group; })) {
            return false;
        }
    }
    return true;
}

/// Reads the choice that is left; what it costs.
Length ChoiceTree::take_choices()
{
    Length cost = 0;
    for (Index e = 0; e < edges_.size(); ++e) {
        const std::vector<Index>& left = relaxation_.left(e);
        choices_[e] = edges_[e].labels[left.front()].walk;
        Length least = kInfiniteLength;
        for (const Index label : left) {
            least = std::min(least, edges_[e].labels[label].cost);
        }
        cost += least;
    }
    return cost;
}

/// At the root: what is ruled out there is ruled out for good.
void ChoiceTree::rule_out_for_good()
{
    for (Index e = 0; e < edges_.size(); ++e) {
        const std::vector<Index>& left = relaxation_.left(e);
        std::vector<bool> is_left(edges_[e].labels.size(), false);
        bool rest_is_left = false;
        for (const Index label : left) {
            is_left[label] = true;
            rest_is_left = rest_is_left || edges_[e].labels[label].walk == kNone;
        }
        bool rest_is_new = false;
        for (Index label = 0; label < is_left.size(); ++label) {
            if (is_left[label] || relaxation_.is_out_for_good(e, label)) {
                continue;
            }
            relaxation_.rule_out_for_good(e, label);
            if (edges_[e].labels[label].walk != kNone) {
                ruled_out_.push_back(edges_[e].labels[label].walk);
            } else {
                rest_is_new = true;
            }
        }
        if (rest_is_new && !rest_is_left) {
            ruled_out_rests_.push_back(e);
        }
    }
}

void ChoiceTree::take_ruled_out(std::vector<Index>& walks, std::vector<Index>& rests)
{
    walks.clear();
    rests.clear();
    walks.swap(ruled_out_);
    rests.swap(ruled_out_rests_);
}

void ChoiceTree::raise_lower_bound()
{
    Cost least = limit_;
    if (current_ && current_->decisions.empty()) {
        // It says something about all nodes.
        lower_bound_ = std::max(lower_bound_, static_cast<Length>(current_->bound) << shift_);
    }
    if (current_) {
        least = std::min(least, current_->bound);
    }
    if (!open_.empty()) {
        least = std::min(least, open_.front().bound);
    }
    lower_bound_ = std::max(lower_bound_,
                            least >= limit_ ? upper_bound_ : static_cast<Length>(least) << shift_);
}

/// Finds the edges whose rest the relaxation takes; whether there are any.
bool ChoiceTree::find_wanted()
{
    wanted_.clear();
    for (Index e = 0; e < edges_.size(); ++e) {
        if (relaxation_.best_group(e) == kRest) {
            wanted_.push_back(e);
        }
    }
    return !wanted_.empty();
}

/// Makes two nodes of the present one: with the best class of the edge that has most to lose from
/// another, and without it.
void ChoiceTree::branch()
{
    Index edge = kNone;
    for (Index e = 0; e < edges_.size(); ++e) {
        const Index group = relaxation_.best_group(e);
        const std::vector<Index>& left = relaxation_.left(e);
        if (std::all_of(left.begin(), left.end(),
                        [&](Index label) { return relaxation_.group(e, label) == group; })) {
            continue;
        }
        if (edge == kNone || relaxation_.margin(e) > relaxation_.margin(edge)) {
            edge = e;
        }
    }
    Node other{current_->bound, next_id_++, current_->decisions, std::nullopt, {}};
    const auto count = static_cast<Index>(edges_[edge].walks.size() + 1);
    other.decisions.push_back({edge, relaxation_.best_group(edge), count, false});
    open(std::move(other));
    current_->decisions.push_back({edge, relaxation_.best_group(edge), count, true});
    current_->id = next_id_++;
    rounds_ = 0;
    const Cost best = open_.front().bound;
    if (current_->bound - best > (limit_ - best) / kDive) {
        open(std::move(*current_));
        current_.reset();
    } else {
        take(current_->decisions.back());
    }
}

ChoiceTree::Outcome ChoiceTree::run(WorkBudget& budget)
{
    for (;;) {
        if (budget.is_spent()) {
            return Outcome::running;
        }
        const std::uint64_t looks = relaxation_.look_count();
        const auto charge = [&] {
            budget.charge(1 + (relaxation_.look_count() - looks) / kLooksPerWork);
        };
        if (root_version_ != version_) {
            // What is new is felt everywhere.
            if (current_ && !current_->decisions.empty()) {
                open(std::move(*current_));
            }
            root_version_ = version_;
            current_ = Node{0, next_id_++, {}, std::nullopt, {}};
            rounds_ = 0;
            applied_version_ = 0;
        }
        if (!current_) {
            raise_lower_bound();
            charge();
            if (lower_bound_ >= upper_bound_) {
                return Outcome::exceeded;
            }
            current_ = take_best();
            rounds_ = 0;
            applied_version_ = 0;
            if (root_is_saved_) {
                relaxation_.restore_messages();
            }
            if (current_->leaf_version == version_) {
                choices_ = current_->choices;
                open(std::move(*current_));
                current_.reset();
                return Outcome::optimal;
            }
            current_->leaf_version.reset();
            continue;
        }
        if (rounds_ == 0) {
            ++node_count_;
        }
        const Length before = lower_bound_;
        const Outcome outcome = improve_node();
        raise_lower_bound();
        charge();
        if (outcome != Outcome::running) {
            return outcome;
        }
        if (lower_bound_ > before) {
            return Outcome::raised;
        }
    }
}

/// A round of sweeps for the present node, which ends as a choice, with children, or not at all if
/// that was not the last round; `satisfied` if a choice was found.
ChoiceTree::Outcome ChoiceTree::improve_node()
{
    if (applied_version_ != version_) {
        apply(current_->decisions);
        applied_version_ = version_;
    }
    const auto tighten = [&] {
        for (int i = 0; i < kSweeps; ++i) {
            relaxation_.sweep();
        }
        relaxation_.rule_out_costly(limit_);
        while (!relaxation_.is_contradictory() && apply_nogoods()) {
        }
        return relaxation_.bound();
    };
    const Cost before = current_->bound;
    Cost bound = tighten();
    if (bound < limit_ && is_leaf()) {
        bound = tighten();  // what was ruled out last may rule out more
        const Length cost = bound < limit_ ? take_choices() : upper_bound_;
        if (cost < upper_bound_) {
            current_->bound = scaled(cost);
            current_->leaf_version = version_;
            current_->choices = choices_;
            open(std::move(*current_));
            current_.reset();
            return Outcome::satisfied;
        }
        bound = limit_;
    }
    if (bound >= limit_) {
        current_.reset();
        return Outcome::running;
    }
    current_->bound = std::max(before, bound);
    ++rounds_;
    const bool is_root = current_->decisions.empty();
    const Cost missing = limit_ - current_->bound;
    const auto gains_less_than = [&](Cost share) {
        return rounds_ > 1 && (current_->bound - before) < missing / share;
    };
    if (is_root && wanted_version_ != version_ && gains_less_than(kLeastGain)) {
        wanted_version_ = version_;
        if (find_wanted()) {
            return Outcome::wants_classes;
        }
    }
    const bool gains_little = gains_less_than(is_root ? kLeastGainOfRoot : kLeastGain);
    if (gains_little || rounds_ >= (is_root ? kMostRoundsOfRoot : kMostRounds)) {
        if (is_root) {
            rule_out_for_good();
            relaxation_.save_messages();
            root_is_saved_ = true;
            // Nodes made when less was known are kept where they tell more.
            if (!open_.empty() && open_.front().bound > current_->bound) {
                current_.reset();
                return Outcome::running;
            }
            open_.clear();
        }
        branch();
    }
    return Outcome::running;
}

}  // namespace layout_embedding
