#include "search/choice_relaxation.hh"

#include <algorithm>
#include <bit>

namespace layout_embedding {

namespace {

// With what its owner keeps to find it again.
constexpr std::uint64_t kBytesPerTuple = 64;
// A bit in either direction.
constexpr std::uint64_t kPairsPerByte = 4;

}  // namespace

ChoiceRelaxation::BitTable::BitTable(Index rows, Index width)
    : stride_((width + 63) / 64), words_(rows * stride_, 0)
{}

void ChoiceRelaxation::BitTable::widen(Index width)
{
    if (width <= stride_ * 64) {
        return;
    }
    const std::size_t stride = 2 * stride_;
    std::vector<std::uint64_t> words(words_.size() / stride_ * stride, 0);
    for (std::size_t row = 0; row * stride < words.size(); ++row) {
        std::copy_n(&words_[row * stride_], stride_, &words[row * stride]);
    }
    stride_ = stride;
    words_ = std::move(words);
}

Index ChoiceRelaxation::add_label(Index variable, Index group, Cost cost, Index like)
{
    Variable& v = variables_[variable];
    const auto label = static_cast<Index>(v.labels.size());
    const bool is_new_group = group >= v.left_in_group.size();
    if (is_new_group) {
        v.left_in_group.resize(group + 1, 0);
    }
    const Index like_group = like == kNone ? kNone : v.labels[like].group;
    Cost moved = 0;
    for (const Link& link : v.links) {
        if (link.is_triangle) {
            std::vector<Cost>& taken = triangles_[link.factor].taken[link.place];
            if (is_new_group) {
                taken.resize(group + 1, 0);
                taken[group] = like == kNone ? 0 : taken[like_group];
            }
            moved += taken[group];
        } else {
            Pair& pair = pairs_[link.factor];
            pair.taken[link.place].push_back(like == kNone ? 0 : pair.taken[link.place][like]);
            moved += pair.taken[link.place].back();
            table_size_ += pair.taken[1 - link.place].size() / kPairsPerByte;
            pair.excluded[link.place].add_row();
            pair.excluded[1 - link.place].widen(label + 1);
        }
    }
    v.labels.push_back({group, false});
    v.costs.push_back(cost + moved);
    v.left.push_back(label);
    ++v.left_in_group[group];
    return label;
}

Index ChoiceRelaxation::pair_of(Index variable_a, Index variable_b)
{
    for (const Link& link : variables_[variable_a].links) {
        if (!link.is_triangle && pairs_[link.factor].variables[1 - link.place] == variable_b) {
            return link.factor;
        }
    }
    const auto factor = static_cast<Index>(pairs_.size());
    const Index count_a = label_count(variable_a);
    const Index count_b = label_count(variable_b);
    pairs_.push_back({{variable_a, variable_b},
                      {std::vector<Cost>(count_a, 0), std::vector<Cost>(count_b, 0)},
                      {BitTable(count_a, count_b), BitTable(count_b, count_a)}});
    table_size_ += std::uint64_t{count_a} * count_b / kPairsPerByte;
    variables_[variable_a].links.push_back(
        {factor, 0, false, variable_b<variable_a, variable_b> variable_a});
    variables_[variable_b].links.push_back(
        {factor, 1, false, variable_a<variable_b, variable_a> variable_b});
    return factor;
}

void ChoiceRelaxation::exclude(Index variable_a, Index label_a, Index variable_b, Index label_b)
{
    Pair& pair = pairs_[pair_of(variable_a, variable_b)];
    const int place = pair.variables[0] == variable_a ? 0 : 1;
    pair.excluded[place].set(label_a, label_b);
    pair.excluded[1 - place].set(label_b, label_a);
}

Index ChoiceRelaxation::add_triangle(const std::array<Index, 3>& variables)
{
    const auto factor = static_cast<Index>(triangles_.size());
    Triangle triangle{variables, {}, {}};
    for (Index k = 0; k < 3; ++k) {
        const Index a = variables[(k + 1) % 3];
        const Index b = variables[(k + 2) % 3];
        Variable& v = variables_[variables[k]];
        triangle.taken[k].resize(v.left_in_group.size(), 0);
        v.links.push_back(
            {factor, k, true, std::min(a, b) < variables[k], std::max(a, b) > variables[k]});
    }
    triangles_.push_back(std::move(triangle));
    return factor;
}

Index ChoiceRelaxation::add_tuple(Index triangle, const std::array<Index, 3>& groups)
{
    triangles_[triangle].tuples.push_back(groups);
    table_size_ += kBytesPerTuple;
    return static_cast<Index>(triangles_[triangle].tuples.size() - 1);
}

void ChoiceRelaxation::remove_tuple(Index triangle, Index tuple)
{
    triangles_[triangle].tuples[tuple][0] = kNone;
}

void ChoiceRelaxation::rule_out(Index variable, Index label)
{
    Variable& v = variables_[variable];
    const auto place = std::lower_bound(v.left.begin(), v.left.end(), label);
    if (place == v.left.end() || *place != label) {
        return;
    }
    v.left.erase(place);
    --v.left_in_group[v.labels[label].group];
    is_contradictory_ = is_contradictory_ || v.left.empty();
}

void ChoiceRelaxation::rule_out_for_good(Index variable, Index label)
{
    variables_[variable].labels[label].is_out_for_good = true;
    rule_out(variable, label);
}

void ChoiceRelaxation::bring_back()
{
    is_contradictory_ = false;
    for (Variable& v : variables_) {
        v.left.clear();
        std::fill(v.left_in_group.begin(), v.left_in_group.end(), 0);
        for (Index label = 0; label < v.labels.size(); ++label) {
            if (!v.labels[label].is_out_for_good) {
                v.left.push_back(label);
                ++v.left_in_group[v.labels[label].group];
            }
        }
        is_contradictory_ = is_contradictory_ || v.left.empty();
    }
}

void ChoiceRelaxation::save_messages()
{
    saved_.costs.resize(variables_.size());
    for (Index v = 0; v < variables_.size(); ++v) {
        saved_.costs[v] = variables_[v].costs;
    }
    saved_.pairs.resize(pairs_.size());
    for (Index f = 0; f < pairs_.size(); ++f) {
        saved_.pairs[f] = pairs_[f].taken;
    }
    saved_.triangles.resize(triangles_.size());
    for (Index f = 0; f < triangles_.size(); ++f) {
        saved_.triangles[f] = triangles_[f].taken;
    }
}

void ChoiceRelaxation::restore_messages()
{
    for (Index v = 0; v < saved_.costs.size(); ++v) {
        variables_[v].costs = saved_.costs[v];
    }
    for (Index f = 0; f < saved_.pairs.size(); ++f) {
        pairs_[f].taken = saved_.pairs[f];
    }
    for (Index f = 0; f < saved_.triangles.size(); ++f) {
        triangles_[f].taken = saved_.triangles[f];
    }
}

/// Per label (group) of the link's variable that is left: the smallest term of the pair (triangle)
/// with it, kNever where it fits nothing.
void ChoiceRelaxation::find_marginals(const Link& link)
{
    if (link.is_triangle) {
        const Triangle& triangle = triangles_[link.factor];
        const Index b = (link.place + 1) % 3;
        const Index c = (link.place + 2) % 3;
        const Variable& here = variables_[triangle.variables[link.place]];
        const Variable& at_b = variables_[triangle.variables[b]];
        const Variable& at_c = variables_[triangle.variables[c]];
        marginals_.assign(here.left_in_group.size(), kNever);
        look_count_ += triangle.tuples.size();
        for (const std::array<Index, 3>& tuple : triangle.tuples) {
            if (tuple[0] != kNone && at_b.left_in_group[tuple[b]] > 0 &&
                at_c.left_in_group[tuple[c]] > 0) {
                Cost& least = marginals_[tuple[link.place]];
                least = std::min(least, -triangle.taken[b][tuple[b]] - triangle.taken[c][tuple[c]]);
            }
        }
        for (Index group = 0; group < marginals_.size(); ++group) {
            if (here.left_in_group[group] == 0) {
                marginals_[group] = kNever;
            } else if (marginals_[group] != kNever) {
                marginals_[group] -= triangle.taken[link.place][group];
            }
        }
        return;
    }
    const Pair& pair = pairs_[link.factor];
    const Variable& here = variables_[pair.variables[link.place]];
    const Variable& there = variables_[pair.variables[1 - link.place]];
    const std::vector<Cost>& taken = pair.taken[1 - link.place];
    marginals_.assign(here.labels.size(), kNever);
    look_count_ += here.left.size();
    // Most labels go with one of those that have most to give.
    by_taken_.assign(there.left.begin(), there.left.end());
    look_count_ += by_taken_.size() * std::bit_width(by_taken_.size());
    std::sort(by_taken_.begin(), by_taken_.end(),
              [&](Index a, Index b) { return taken[a] != taken[b] ? taken[a] > taken[b] : a < b; });
    for (const Index label : here.left) {
        const std::uint64_t* excluded = pair.excluded[link.place].row(label);
        const auto is_excluded = [&](Index other) {
            return ((excluded[other / 64] >> (other % 64)) & 1U) != 0;
        };
        const auto best = std::find_if_not(by_taken_.begin(), by_taken_.end(), is_excluded);
        look_count_ += static_cast<std::uint64_t>(best - by_taken_.begin());
        if (best != by_taken_.end()) {
            marginals_[label] = -taken[*best] - pair.taken[link.place][label];
        }
    }
}

/// Takes all that a pair or triangle can give to the variable.
void ChoiceRelaxation::pull(Index variable, const Link& link)
{
    Variable& v = variables_[variable];
    find_marginals(link);
    gone_.clear();
    for (const Index label : v.left) {
        if (marginal(v, link, label) == kNever) {
            gone_.push_back(label);
        }
    }
    for (const Index label : gone_) {
        rule_out(variable, label);
    }
    if (link.is_triangle) {
        std::vector<Cost>& taken = triangles_[link.factor].taken[link.place];
        for (Index group = 0; group < marginals_.size(); ++group) {
            if (marginals_[group] == kNever) {
                marginals_[group] = 0;
            }
            taken[group] += marginals_[group];
        }
        for (Index label = 0; label < v.labels.size(); ++label) {
            v.costs[label] += marginals_[v.labels[label].group];
        }
    } else {
        std::vector<Cost>& taken = pairs_[link.factor].taken[link.place];
        for (const Index label : v.left) {
            taken[label] += marginals_[label];
            v.costs[label] += marginals_[label];
        }
    }
}

/// Gives the variable's share of costs to a pair or triangle.
void ChoiceRelaxation::push(Index variable, const Link& link, Index shares)
{
    Variable& v = variables_[variable];
    if (!link.is_triangle) {
        std::vector<Cost>& taken = pairs_[link.factor].taken[link.place];
        for (const Index label : v.left) {
            taken[label] -= shares_[label] / shares;
            v.costs[label] -= shares_[label] / shares;
        }
        return;
    }
    // A group gives what its cheapest label can.
    sums_.assign(v.left_in_group.size(), kNever);
    for (const Index label : v.left) {
        Cost& least = sums_[v.labels[label].group];
        least = std::min(least, shares_[label] / shares);
    }
    std::vector<Cost>& taken = triangles_[link.factor].taken[link.place];
    for (Index group = 0; group < sums_.size(); ++group) {
        sums_[group] = sums_[group] == kNever ? 0 : sums_[group];
        taken[group] -= sums_[group];
    }
    for (Index label = 0; label < v.labels.size(); ++label) {
        v.costs[label] -= sums_[v.labels[label].group];
    }
}

/// Takes from all pairs and triangles of a variable, and gives to those with variables ahead.
void ChoiceRelaxation::pass(Index variable, bool forward)
{
    const Variable& v = variables_[variable];
    Index ahead = 0;
    Index behind = 0;
    for (const Link& link : v.links) {
        pull(variable, link);
        if (is_contradictory_) {
            return;
        }
        ahead += (forward ? link.has_later : link.has_earlier) ? 1 : 0;
        behind += (forward ? link.has_earlier : link.has_later) ? 1 : 0;
    }
    shares_ = v.costs;
    for (const Link& link : v.links) {
        if (forward ? link.has_later : link.has_earlier) {
            push(variable, link, std::max(ahead, behind));
        }
    }
}

void ChoiceRelaxation::sweep()
{
    const auto count = static_cast<Index>(variables_.size());
    for (Index k = 0; k < 2 * count && !is_contradictory_; ++k) {
        pass(k < count ? k : 2 * count - 1 - k, k < count);
    }
}

ChoiceRelaxation::Cost ChoiceRelaxation::bound()
{
    if (is_contradictory_) {
        return kNever;
    }
    Cost sum = 0;
    for (const Variable& v : variables_) {
        Cost least = kNever;
        for (const Index label : v.left) {
            least = std::min(least, v.costs[label]);
        }
        sum += least;
        for (const Link& link : v.links) {
            if (link.place != 0) {
                continue;  // once per pair and triangle
            }
            find_marginals(link);
            const Cost least_term = *std::min_element(marginals_.begin(), marginals_.end());
            if (least_term == kNever) {
                is_contradictory_ = true;
                return kNever;
            }
            sum += least_term;
        }
    }
    return sum;
}

void ChoiceRelaxation::rule_out_costly(Cost limit)
{
    const Cost all = bound();
    for (Index variable = 0; variable < variables_.size() && !is_contradictory_; ++variable) {
        Variable& v = variables_[variable];
        // What the rest of the problem costs at least; then with each label, too.
        Cost elsewhere = all;
        Cost least = kNever;
        sums_.assign(v.labels.size(), kNever);
        for (const Index label : v.left) {
            sums_[label] = v.costs[label];
            least = std::min(least, v.costs[label]);
        }
        elsewhere -= least;
        for (const Link& link : v.links) {
            find_marginals(link);
            least = kNever;
            for (const Index label : v.left) {
                const Cost term = marginal(v, link, label);
                least = std::min(least, term);
                sums_[label] =
                    term == kNever || sums_[label] == kNever ? kNever : sums_[label] + term;
            }
            if (least == kNever) {
                is_contradictory_ = true;
                return;
            }
            elsewhere -= least;
        }
        gone_.clear();
        Cost best = kNever;
        for (const Index label : v.left) {
            if (sums_[label] == kNever || elsewhere + sums_[label] >= limit) {
                gone_.push_back(label);
                sums_[label] = kNever;
            } else if (sums_[label] < best) {
                best = sums_[label];
                v.best_group = v.labels[label].group;
            }
        }
        v.margin = kNever;
        for (const Index label : v.left) {
            if (sums_[label] != kNever && v.labels[label].group != v.best_group) {
                v.margin = std::min(v.margin, sums_[label] - best);
            }
        }
        for (const Index label : gone_) {
            rule_out(variable, label);
        }
    }
}

}  // namespace layout_embedding
