#include "search/second_class.hh"

namespace layout_embedding {

namespace {

// Expansions that looking for the second class of an edge may take.
constexpr std::uint64_t kMaxExpansions = 20'000;

}  // namespace

SecondClass::Outcome SecondClass::run(Index layout_edge, WorkBudget& budget)
{
    if (!is_running_) {
        enumeration_.begin(cuts_.of(layout_edge), layout_edge);
        is_running_ = true;
        found_ = 0;
        expansions_left_ = kMaxExpansions;
    }
    while (!budget.is_spent()) {
        const std::uint64_t expansions = enumeration_.expansion_count();
        const std::uint64_t work = enumeration_.work_count();
        const auto outcome = enumeration_.run(expansions_left_, budget.left());
        expansions_left_ -= enumeration_.expansion_count() - expansions;
        budget.charge(enumeration_.work_count() - work);
        if (outcome == ClassEnumeration::Outcome::tied) {
            is_running_ = false;
            return Outcome::tied;
        }
        found_ += outcome == ClassEnumeration::Outcome::found ? 1 : 0;
        if (found_ == 2) {
            length_ = enumeration_.cost();
            is_running_ = false;
            return Outcome::found;
        }
        if (outcome == ClassEnumeration::Outcome::exceeded || expansions_left_ == 0) {
            length_ = enumeration_.frontier();
            is_running_ = false;
            return Outcome::bounded;
        }
    }
    return Outcome::running;
}

}  // namespace layout_embedding
