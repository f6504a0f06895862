#include "embedding/crossing_room.hh"

#include <algorithm>

#include "embedding/isotonic.hh"

namespace layout_embedding {

Room room_of(const NormalForm& form, Index crossing, double gap)
{
    const NormalForm::Element& x = form.element(crossing);
    double low = 0;
    double high = 1;
    double low_gap = gap;
    double high_gap = gap;
    if (x.edge_previous != kNone) {
        const NormalForm::Element& before = form.element(x.edge_previous);
        low = before.parameter;
        if (before.strand == x.strand) {
            low = 0.5 * (low + x.parameter);
            low_gap = 0.5 * gap;
        }
    }
    if (x.edge_next != kNone) {
        const NormalForm::Element& after = form.element(x.edge_next);
        high = after.parameter;
        if (after.strand == x.strand) {
            high = 0.5 * (high + x.parameter);
            high_gap = 0.5 * gap;
        }
    }
    if (high - low <= low_gap + high_gap) {
        const double middle = low + (high - low) * (low_gap / (low_gap + high_gap));
        return {middle, middle};
    }
    return {low + low_gap, high - high_gap};
}

void keep_gaps(NormalForm& form, double spacing)
{
    IsotonicRegression regression;
    std::vector<Index> crossings;
    std::vector<double> places;
    std::vector<double> weights;
    for (Index start = 0; start < form.element_count(); ++start) {
        if (!form.element(start).is_crossing() || form.element(start).edge_previous != kNone) {
            continue;
        }
        const double gap = gap_on_edge(form, form.edge(start), spacing);
        crossings.clear();
        places.clear();
        for (Index id = start; id != kNone; id = form.element(id).edge_next) {
            crossings.push_back(id);
            places.push_back(form.element(id).parameter -
                             static_cast<double>(crossings.size()) * gap);
        }
        weights.assign(places.size(), 1);
        regression.fit(places, weights, 0, 1 - spacing);
        for (std::size_t i = 0; i < crossings.size(); ++i) {
            form.set_parameter(crossings[i], places[i] + static_cast<double>(i + 1) * gap);
        }
    }
}

}  // namespace layout_embedding
