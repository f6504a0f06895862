#include "apps/path_shaping.hh"

#include <utility>

#include "embedding/angle_widening.hh"

namespace layout_embedding {

namespace {

StraighteningOptions straightening_options(std::span<const double> edge_costs)
{
    StraighteningOptions options;
    options.edge_costs = edge_costs;
    return options;
}

}  // namespace

PathShaping::PathShaping(const Layout& layout, NormalForm form, const std::vector<Index>& landmarks,
                         std::span<const double> edge_costs, bool is_fair)
    : layout_(layout),
      landmarks_(landmarks),
      edge_costs_(edge_costs),
      is_fair_(is_fair),
      straightening_(std::move(form), landmarks_, straightening_options(edge_costs))
{}

bool PathShaping::step()
{
    if (fairing_) {
        return fairing_->step();
    }
    if (straightening_.step()) {
        return true;
    }
    if (!is_fair_) {
        return false;
    }
    FairingOptions options;
    options.edge_costs = edge_costs_;
    fairing_ = std::make_unique<Fairing>(layout_, straightening_.take(), options);
    return true;
}

double PathShaping::progress() const
{
    if (!is_fair_) {
        return straightening_.progress();
    }
    return (fairing_ ? 1 + fairing_->progress() : straightening_.progress()) / 2;
}

void PathShaping::finish()
{
    if (fairing_) {
        fairing_->finish();
    } else {
        straightening_.finish();
        is_fair_ = false;
    }
}

NormalForm PathShaping::take()
{
    if (!fairing_) {
        return straightening_.take();
    }
    NormalForm form = fairing_->take();
    open_angles(form, landmarks_, FairingOptions{}.spacing, edge_costs_);
    return form;
}

}  // namespace layout_embedding
