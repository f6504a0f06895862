#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/types.hh"
#include "embedding/normal_form.hh"
#include "embedding/straightening.hh"
#include "layout/layout.hh"
#include "patches/fairing.hh"

namespace layout_embedding {

/// Gives the paths of an embedding their shape, step by step: shortened within their homotopy
/// classes (Straightening), and if they are to be fair, smoothed after that (Fairing).
class PathShaping {
public:
    /// Keeps references. `landmarks`: per layout vertex, a target vertex. `edge_costs`: as in
    /// StraighteningOptions.
    PathShaping(const Layout& layout, NormalForm form, const std::vector<Index>& landmarks,
                std::span<const double> edge_costs, bool is_fair);

    /// False once the paths have their shape.
    bool step();
    /// In [0, 1].
    double progress() const;
    /// Leaves the paths as far as they are. Idempotent.
    void finish();
    /// After step() has returned false, once.
    NormalForm take();

private:
    const Layout& layout_;
    const std::vector<Index>& landmarks_;
    std::span<const double> edge_costs_;
    bool is_fair_;
    Straightening straightening_;
    std::unique_ptr<Fairing> fairing_;  // once the paths are short
};

}  // namespace layout_embedding
