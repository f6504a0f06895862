#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// A lower bound on the cheapest choice of one label per variable, where labels of two variables
/// may exclude each other, and three variables around a triangle may only have certain labels
/// together: the linear relaxation of that problem, in its dual form. Costs move between variables,
/// pairs and triangles as messages, sweep by sweep (sequential reweighted message passing:
/// Kolmogorov 2006, 2015); the total cost of every choice stays what it is, so that the sum of all
/// smallest terms is a bound whenever it is taken, in exact integers.
///
/// Each label belongs to a *group* of its variable; triangles see groups. Labels, exclusions and
/// tuples may be added at any time, and labels may be ruled out, for a while or for good; messages
/// stay, so that the bound goes on from where it was.
class ChoiceRelaxation {
public:
    using Cost = std::int64_t;
    /// More than every bound.
    static constexpr Cost kNever = Cost{1} << 60U;

    explicit ChoiceRelaxation(Index variable_count) : variables_(variable_count) {}

    /// One more label, of a group known or new. `like`: a label of the variable whose messages it
    /// takes over, since it was part of that label's meaning; kNone for none.
    Index add_label(Index variable, Index group, Cost cost, Index like);
    void exclude(Index variable_a, Index label_a, Index variable_b, Index label_b);
    /// Three variables of which nothing is allowed yet.
    Index add_triangle(const std::array<Index, 3>& variables);
    Index add_tuple(Index triangle, const std::array<Index, 3>& groups);
    void remove_tuple(Index triangle, Index tuple);
    /// Never to be chosen any more.
    void rule_out_for_good(Index variable, Index label);
    bool is_out_for_good(Index variable, Index label) const
    {
        return variables_[variable].labels[label].is_out_for_good;
    }

    Index label_count(Index variable) const
    {
        return static_cast<Index>(variables_[variable].labels.size());
    }
    /// The labels that are not ruled out, ascending.
    const std::vector<Index>& left(Index variable) const { return variables_[variable].left; }
    Index group(Index variable, Index label) const
    {
        return variables_[variable].labels[label].group;
    }

    /// Brings back all labels but those ruled out for good.
    void bring_back();
    void rule_out(Index variable, Index label);
    /// No choice is left.
    bool is_contradictory() const { return is_contradictory_; }

    /// Keeps the messages as they are; takes them up again, with nothing added in between.
    void save_messages();
    void restore_messages();

    /// Moves costs along all variables and back. Rules out labels that fit nothing.
    void sweep();
    /// Of the choices that are left; kNever if there is none.
    Cost bound();
    /// Rules out labels with which every choice costs `limit` or more. Finds what may be said of
    /// the others meanwhile: see best_group() and margin().
    void rule_out_costly(Cost limit);

    /// As of rule_out_costly(): the group with the smallest bound, and how much larger that of the
    /// next one is; kNever where no other is left.
    Index best_group(Index variable) const { return variables_[variable].best_group; }
    Cost margin(Index variable) const { return variables_[variable].margin; }

    /// About how many bytes exclusions and tuples take.
    std::uint64_t table_size() const { return table_size_; }
    /// Table entries looked at so far.
    std::uint64_t look_count() const { return look_count_; }

private:
    struct Label {
        Index group;
        bool is_out_for_good;
    };
    /// A pair or triangle that a variable is part of.
    struct Link {
        Index factor;
        Index place;
        bool is_triangle;
        /// Whether other variables of it come earlier, or later, in the order of sweeps.
        bool has_earlier;
        bool has_later;
    };
    struct Variable {
        std::vector<Label> labels;
        std::vector<Cost> costs;  // per label: its own cost and what came from pairs and triangles
        std::vector<Index> left;
        std::vector<Index> left_in_group;  // how many labels, per group
        std::vector<Link> links;
        Index best_group = kNone;
        Cost margin = 0;
    };
    /// Bits in rows, which may grow both ways.
    class BitTable {
    public:
        BitTable(Index rows, Index width);
        void add_row() { words_.resize(words_.size() + stride_, 0); }
        /// So that every row has at least so many bits.
        void widen(Index width);
        void set(Index row, Index bit)
        {
            words_[std::size_t{row} * stride_ + bit / 64] |= std::uint64_t{1} << (bit % 64);
        }
        const std::uint64_t* row(Index row) const { return &words_[std::size_t{row} * stride_]; }

    private:
        std::size_t stride_;  // in words, at least one
        std::vector<std::uint64_t> words_;
    };
    /// `taken[k]`: per label (in triangles: per group) of variable k, the cost that has gone from
    /// here to that variable.
    struct Pair {
        std::array<Index, 2> variables;
        std::array<std::vector<Cost>, 2> taken;
        std::array<BitTable, 2> excluded;  // by labels of variable k: labels of the other one
    };
    struct Triangle {
        std::array<Index, 3> variables;
        std::array<std::vector<Cost>, 3> taken;
        std::vector<std::array<Index, 3>> tuples;  // groups; kNone in removed ones
    };

    Index pair_of(Index variable_a, Index variable_b);
    void find_marginals(const Link& link);
    Cost marginal(const Variable& variable, const Link& link, Index label) const
    {
        return marginals_[link.is_triangle ? variable.labels[label].group : label];
    }
    void pass(Index variable, bool forward);
    void pull(Index variable, const Link& link);
    void push(Index variable, const Link& link, Index shares);

    struct Messages {
        std::vector<std::vector<Cost>> costs;
        std::vector<std::array<std::vector<Cost>, 2>> pairs;
        std::vector<std::array<std::vector<Cost>, 3>> triangles;
    };

    std::vector<Variable> variables_;
    Messages saved_;
    std::vector<Pair> pairs_;
    std::vector<Triangle> triangles_;
    bool is_contradictory_ = false;
    std::uint64_t look_count_ = 0;
    std::uint64_t table_size_ = 0;
    std::vector<Cost> marginals_;  // per label or group, of find_marginals()
    std::vector<Cost> sums_;
    std::vector<Cost> shares_;
    std::vector<Index> by_taken_;
    std::vector<Index> gone_;
};

}  // namespace layout_embedding
