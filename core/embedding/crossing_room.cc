#include "embedding/crossing_room.hh"

#include <algorithm>

#include "embedding/isotonic.hh"

namespace layout_embedding {

namespace {

/// The share of an edge that gaps may take.
constexpr double kMostSpacing = 0.92;

/// How far along an edge one has to go so that `angle` lies in between, as seen from a point.
double step_for(double tangent, const Vec3& to_tail, const Vec3& to_head)
{
    const double area = to_tail.cross(to_head).norm();
    return area > 0 ? tangent * std::max(to_tail.squaredNorm(), to_head.squaredNorm()) / area : 0;
}

}  // namespace

void CrossingGaps::gather(const NormalForm& form, Index edge, std::vector<double>& gaps) const
{
    gaps.assign(std::size_t{form.crossing_count(edge)} + 1, gap_on_edge(form, edge, spacing_));
    if (are_equal()) {
        return;
    }
    const TriangleMesh& mesh = form.mesh();
    const Index h = mesh.halfedge(edge);
    const double equal = gaps[0];
    double more = 0;
    std::size_t place = 0;
    for (Index id = form.first_on_edge(edge); id != kNone;
         id = form.element(id).edge_next, ++place) {
        const NormalForm::Element& x = form.element(id);
        if (id < raised_.size()) {
            gaps[place] = std::max(gaps[place], raised_[id][0]);
            gaps[place + 1] = std::max(gaps[place + 1], raised_[id][1]);
        }
        for (const bool behind : {true, false}) {
            if (angles_ == nullptr) {
                break;
            }
            const NormalForm::Element& y = form.element(behind ? x.previous : x.next);
            if (y.is_crossing()) {
                continue;
            }
            const Vec3& apex = mesh.position(y.vertex);
            const Index face =
                TriangleMesh::face_of(behind ? x.halfedge : mesh.opposite(x.halfedge));
            const double step =
                step_for(angles_->tangent_in(face), mesh.position(mesh.tail(h)) - apex,
                         mesh.position(mesh.head(h)) - apex);
            gaps[place] = std::max(gaps[place], step);
            gaps[place + 1] = std::max(gaps[place + 1], step);
        }
    }
    for (const double gap : gaps) {
        more += gap - equal;
    }
    const double room = std::max(kMostSpacing, spacing_) - spacing_;
    if (more > room) {
        for (double& gap : gaps) {
            gap = equal + (gap - equal) * (room / more);
        }
    }
}

void CrossingGaps::prepare(const NormalForm& form)
{
    if (are_equal()) {
        return;
    }
    around_.resize(form.element_count());
    std::vector<double> gaps;
    for (Index start = 0; start < form.element_count(); ++start) {
        if (!form.element(start).is_crossing() || form.element(start).edge_previous != kNone) {
            continue;
        }
        gather(form, form.edge(start), gaps);
        std::size_t place = 0;
        for (Index id = start; id != kNone; id = form.element(id).edge_next, ++place) {
            around_[id] = {gaps[place], gaps[place + 1]};
        }
    }
}

std::array<double, 2> CrossingGaps::around(const NormalForm& form, Index crossing) const
{
    if (are_equal()) {
        const double gap = gap_on_edge(form, form.edge(crossing), spacing_);
        return {gap, gap};
    }
    return around_[crossing];
}

void CrossingGaps::raise(Index crossing, bool towards_tail, double gap)
{
    if (crossing >= raised_.size()) {
        raised_.resize(std::size_t{crossing} + 1, {0, 0});
    }
    double& raised = raised_[crossing][towards_tail ? 0 : 1];
    raised = std::max(raised, gap);
}

Room room_of(const NormalForm& form, Index crossing, double low_gap, double high_gap)
{
    const NormalForm::Element& x = form.element(crossing);
    double low = 0;
    double high = 1;
    if (x.edge_previous != kNone) {
        const NormalForm::Element& before = form.element(x.edge_previous);
        low = before.parameter;
        if (before.strand == x.strand) {
            low = 0.5 * (low + x.parameter);
            low_gap = 0.5 * low_gap;
        }
    }
    if (x.edge_next != kNone) {
        const NormalForm::Element& after = form.element(x.edge_next);
        high = after.parameter;
        if (after.strand == x.strand) {
            high = 0.5 * (high + x.parameter);
            high_gap = 0.5 * high_gap;
        }
    }
    if (high - low <= low_gap + high_gap) {
        const double middle = low + (high - low) * (low_gap / (low_gap + high_gap));
        return {middle, middle};
    }
    return {low + low_gap, high - high_gap};
}

void keep_gaps(NormalForm& form, const CrossingGaps& gaps)
{
    IsotonicRegression regression;
    std::vector<Index> crossings;
    std::vector<double> widths;
    std::vector<double> places;
    std::vector<double> weights;
    for (Index start = 0; start < form.element_count(); ++start) {
        if (!form.element(start).is_crossing() || form.element(start).edge_previous != kNone) {
            continue;
        }
        gaps.gather(form, form.edge(start), widths);
        crossings.clear();
        places.clear();
        double sum = 0;
        for (Index id = start; id != kNone; id = form.element(id).edge_next) {
            sum += widths[crossings.size()];
            crossings.push_back(id);
            places.push_back(form.element(id).parameter - sum);
        }
        weights.assign(places.size(), 1);
        regression.fit(places, weights, 0, 1 - (sum + widths.back()));
        sum = 0;
        for (std::size_t i = 0; i < crossings.size(); ++i) {
            sum += widths[i];
            form.set_parameter(crossings[i], places[i] + sum);
        }
    }
}

}  // namespace layout_embedding
