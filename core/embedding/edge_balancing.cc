#include "embedding/edge_balancing.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

/// Segments that meet at a right angle at least this much curve the length; straight ones would
/// have no second derivative.
constexpr double kLeastCurvature = 1e-3;
constexpr int kMostHalvings = 12;

}  // namespace

double EdgeBalancing::length_at(const Vec3& tail, const Vec3& along,
                                const std::vector<double>& places) const
{
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Vec3 x = tail + places[i] * along;
        sum += (x - crossings_[i].before).norm() + (crossings_[i].after - x).norm();
    }
    return sum;
}

double EdgeBalancing::balance(NormalForm& form, Index edge, const CrossingGaps& gaps)
{
    const TriangleMesh& mesh = form.mesh();
    const Vec3& tail = mesh.position(mesh.tail(mesh.halfedge(edge)));
    const Vec3 along = mesh.position(mesh.head(mesh.halfedge(edge))) - tail;
    const double square = along.squaredNorm();
    if (!(square > 0)) {
        return 0;
    }
    gaps.gather(form, edge, widths_);
    crossings_.clear();
    places_.clear();
    goals_.clear();
    weights_.clear();
    for (Index id = form.first_on_edge(edge); id != kNone; id = form.element(id).edge_next) {
        const NormalForm::Element& x = form.element(id);
        const Vec3 before = form.position(x.previous);
        const Vec3 after = form.position(x.next);
        crossings_.push_back({id, before, after});
        const Vec3 here = tail + x.parameter * along;
        double slope = 0;
        double curvature = 0;
        for (const Vec3& other : {before, after}) {
            const Vec3 arm = here - other;
            const double length = arm.norm();
            if (!(length > 0)) {
                continue;
            }
            const double cosine = arm.dot(along) / length;
            slope += cosine;
            curvature += std::max(square - cosine * cosine, kLeastCurvature * square) / length;
        }
        places_.push_back(x.parameter);
        goals_.push_back(curvature > 0 ? x.parameter - slope / curvature : x.parameter);
        weights_.push_back(curvature > 0 ? curvature : 1);
    }
    double sum = 0;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
        sum += widths_[i];
        goals_[i] -= sum;
    }
    regression_.fit(goals_, weights_, 0, 1 - (sum + widths_.back()));
    sum = 0;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
        sum += widths_[i];
        goals_[i] += sum;
    }
    const double length = length_at(tail, along, places_);
    double share = 1;
    for (int halving = 0; halving < kMostHalvings; ++halving, share *= 0.5) {
        tried_.clear();
        for (std::size_t i = 0; i < goals_.size(); ++i) {
            tried_.push_back(places_[i] + share * (goals_[i] - places_[i]));
        }
        const double now = length_at(tail, along, tried_);
        if (now < length) {
            for (std::size_t i = 0; i < tried_.size(); ++i) {
                form.set_parameter(crossings_[i].id, tried_[i]);
            }
            return length - now;
        }
    }
    return 0;
}

}  // namespace layout_embedding
