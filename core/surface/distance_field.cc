#include "surface/distance_field.hh"

#include <algorithm>
#include <functional>

namespace layout_embedding {

DistanceField::DistanceField(const PathGraph& graph, const std::vector<bool>& passable,
                             Index source)
    : graph_(graph), passable_(passable), source_(source), distances_(graph.node_count(), kFar)
{
    distances_[source] = 0;
    heap_.push_back(source);
}

void DistanceField::extend_to(Index node, Length limit)
{
    // Everything nearer than the radius is settled, and the radius itself is exact.
    while (!heap_.empty() && distances_[node] > radius_) {
        settle_next();
    }
    const std::uint64_t reach = (distances_[node] + (limit >> kShift)) / 2 + 1;
    while (!heap_.empty() && radius_ < reach) {
        settle_next();
    }
    if (heap_.empty()) {
        radius_ = kFar - 1;
    }
    if (heap_.capacity() > heap_.size() + heap_.size() / 4) {
        heap_.shrink_to_fit();  // there are many fields, and few go on
    }
}

void DistanceField::settle_next()
{
    const auto distance = static_cast<std::uint32_t>(heap_.front() >> 32U);
    const auto current = static_cast<Index>(heap_.front());
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    heap_.pop_back();
    if (distance > distances_[current]) {
        return;
    }
    radius_ = distance;
    ++settled_count_;
    if (current != source_ && !passable_[current]) {
        return;
    }
    const Index end = graph_.first_dart(current + 1);
    for (Index d = graph_.first_dart(current); d < end; ++d) {
        const Dart& dart = graph_.dart(d);
        // Saturates below kFar: the minimum of a distance and a constant stays consistent.
        const std::uint64_t candidate =
            std::min<std::uint64_t>(distance + (dart.length >> kShift), kFar - 1);
        if (candidate < distances_[dart.head]) {
            distances_[dart.head] = static_cast<std::uint32_t>(candidate);
            heap_.push_back(candidate << 32U | dart.head);
            std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
        }
    }
}

DistanceFields::DistanceFields(const PathGraph& graph, const std::vector<bool>& passable,
                               std::uint64_t max_bytes)
    : graph_(graph),
      passable_(passable),
      capacity_(std::max<std::uint64_t>(1, max_bytes / DistanceField::bytes(graph)))
{}

const DistanceField& DistanceFields::get(Index source, Index node, Length limit)
{
    auto entry = std::find_if(entries_.begin(), entries_.end(),
                              [&](const Entry& e) { return e.source == source; });
    if (entry == entries_.end()) {
        if (entries_.size() >= capacity_) {
            entries_.erase(std::min_element(
                entries_.begin(), entries_.end(),
                [](const Entry& a, const Entry& b) { return a.last_use < b.last_use; }));
        }
        entries_.push_back({source, 0, std::make_unique<DistanceField>(graph_, passable_, source)});
        entry = entries_.end() - 1;
    }
    entry->last_use = ++uses_;
    settled_count_ -= entry->field->settled_count();
    entry->field->extend_to(node, limit);
    settled_count_ += entry->field->settled_count();
    return *entry->field;
}

}  // namespace layout_embedding
