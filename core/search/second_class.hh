#pragma once

#include "search/work_budget.hh"
#include "surface/class_enumeration.hh"
#include "surface/cut_systems.hh"

namespace layout_embedding {

/// Looks for the second shortest homotopy class of a layout edge beside what is embedded. Stepped;
/// gives up after some work.
class SecondClass {
public:
    enum class Outcome {
        running,
        /// darts() and length() are its shortest walk.
        found,
        /// All classes but the shortest are at least length() long.
        bounded,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    /// Keeps references.
    SecondClass(CutSystems& cuts, const Strands& strands, DistanceFields& fields)
        : cuts_(cuts), enumeration_(strands, fields)
    {}

    /// Begins with an edge that is not embedded, or goes on; the strands must not change meanwhile.
    Outcome run(Index layout_edge, WorkBudget& budget);

    const std::vector<Index>& darts() const { return enumeration_.darts(); }
    Length length() const { return length_; }
    /// States expanded so far, for all edges.
    std::uint64_t expansion_count() const { return enumeration_.expansion_count(); }

private:
    CutSystems& cuts_;
    ClassEnumeration enumeration_;
    bool is_running_ = false;
    Index found_ = 0;
    std::uint64_t expansions_left_ = 0;
    Length length_ = 0;
};

}  // namespace layout_embedding
