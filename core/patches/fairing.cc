#include "patches/fairing.hh"

#include <algorithm>
#include <cmath>
#include <utility>

#include "embedding/crossing_room.hh"
#include "embedding/realisation.hh"
#include "embedding/vertex_moves.hh"
#include "patches/parametrisation.hh"
#include "patches/patch_shape.hh"
#include "patches/patch_union.hh"
#include "patches/straight_line.hh"
#include "patches/target_places.hh"

namespace layout_embedding {
namespace {

/// By how much a trace has to raise the smaller quotient of its patches.
constexpr double kLeastGain = 0.01;
/// Paths between patches of at least this quotient stay as they are: traces would only make them
/// turn more.
constexpr double kRoundEnough = 0.3;
constexpr double kQuotientRounding = 1e-9;
/// Traces are jagged where the target's triangles are few or thin. So often all crossings are moved
/// to shorten the two segments at them, which takes waves of a few edges away and leaves longer
/// ones, as long as the smallest quotient stays this high.
constexpr int kSmoothingSweeps = 8;
constexpr double kKeptQuotient = 0.9;
/// Patches of a quotient below this one get wider gaps where paths leave them no other room.
constexpr double kThin = 0.05;
constexpr double kWidening = 2;
constexpr int kMostWidenings = 6;
/// By how much this has to raise the smallest quotient once it is larger than at first: all paths
/// beside turn more for it.
constexpr double kWorthWidening = 0.25;

/// Puts strands on the free vertices that their gaps would bend them around.
void snap_to_vertices(NormalForm& form, const CrossingGaps& gaps)
{
    std::vector<Index> landmarks;
    for (Index strand = 0; strand < form.strand_count(); ++strand) {
        landmarks.push_back(form.element(form.first(strand)).vertex);
        landmarks.push_back(form.element(form.last(strand)).vertex);
    }
    VertexMoves moves(form, landmarks);
    bool any = false;
    for (Index strand = 0; strand < form.strand_count(); ++strand) {
        for (Index id = form.first(strand); id != kNone; id = form.element(id).next) {
            if (!form.element(id).is_crossing()) {
                continue;
            }
            if (const Index snapped = moves.snap(id); snapped != kNone) {
                id = snapped;
                any = true;
            }
        }
    }
    if (any) {
        // Fewer crossings on an edge keep wider gaps.
        keep_gaps(form, gaps);
    }
}

Index place_in(std::span<const Index> halfedges, Index halfedge)
{
    return static_cast<Index>(std::find(halfedges.begin(), halfedges.end(), halfedge) -
                              halfedges.begin());
}

double worst_of(const std::vector<double>& quotients)
{
    return quotients.empty() ? 0 : *std::min_element(quotients.begin(), quotients.end());
}

std::vector<double> quotients_of(const Layout& layout, const RefinedMesh& refined)
{
    std::vector<double> quotients;
    for (const PatchShape& shape : patch_shapes(layout, refined)) {
        quotients.push_back(shape.quotient());
    }
    return quotients;
}

}  // namespace

Fairing::Fairing(const Layout& layout, NormalForm form, FairingOptions options)
    : layout_(layout),
      options_(options),
      original_(std::move(form)),
      angles_(original_.mesh()),
      gaps_(options.spacing, &angles_),
      waiting_(layout.edge_count()),
      attempts_(layout.edge_count(), 0)
{
    for (Index edge = 0; edge < layout.edge_count(); ++edge) {
        const Index left = layout.face(2 * edge);
        const Index right = layout.face(2 * edge + 1);
        if (runs_along_cheap_edge(edge)) {
            attempts_[edge] = options_.rounds;  // never
        } else {
            waiting_[edge] = left != kNone && right != kNone && left != right;
        }
    }
}

bool Fairing::runs_along_cheap_edge(Index strand) const
{
    if (options_.edge_costs.empty()) {
        return false;
    }
    for (Index id = original_.first(strand); original_.element(id).next != kNone;
         id = original_.element(id).next) {
        const Index edge = original_.segment_edge(id);
        if (edge != kNone && options_.edge_costs[edge] < 1) {
            return true;
        }
    }
    return false;
}

bool Fairing::step()
{
    switch (stage_) {
        case Stage::choose:
            choose();
            break;
        case Stage::trace:
            trace(batch_[traces_.size()]);
            break;
        case Stage::compare:
            compare();
            break;
        case Stage::widen:
            widen();
            break;
        case Stage::smooth:
            smooth();
            break;
        case Stage::done:
            break;
    }
    return stage_ != Stage::done;
}

std::optional<Fairing::State> Fairing::state_of(std::vector<Path> paths, bool make_room) const
{
    const TriangleMesh& mesh = original_.mesh();
    NormalForm form(mesh, static_cast<Index>(paths.size()));
    struct Crossing {
        Index edge;
        double parameter;
        Index id;
    };
    std::vector<Crossing> crossings;
    for (Index strand = 0; strand < paths.size(); ++strand) {
        for (const Place& place : paths[strand]) {
            const bool crosses = place.halfedge != kNone;
            const Index id =
                crosses ? form.add_crossing(place.halfedge) : form.add_vertex(place.vertex);
            form.append_to_strand(strand, id);
            if (crosses) {
                form.set_parameter(id, place.parameter);
                crossings.push_back({mesh.edge(place.halfedge), place.parameter, id});
            }
        }
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.parameter < b.parameter;
    });
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        if (i > 0 && crossings[i].edge == crossings[i - 1].edge &&
            !(crossings[i].parameter > crossings[i - 1].parameter)) {
            return std::nullopt;
        }
        form.append_to_edge(crossings[i].id);
    }
    form.remove_bigons();
    if (make_room) {
        keep_gaps(form, gaps_);
        snap_to_vertices(form, gaps_);
    }
    form.compact();
    auto refined = cut_along(layout_, form);
    if (!refined) {
        return std::nullopt;
    }
    auto patches = patches_of(layout_, *refined);
    if (!patches) {
        return std::nullopt;
    }
    std::vector<double> quotients = quotients_of(layout_, *refined);
    for (Index strand = 0; strand < paths.size(); ++strand) {
        paths[strand].clear();
        for (Index id = form.first(strand); id != kNone; id = form.element(id).next) {
            const NormalForm::Element& e = form.element(id);
            paths[strand].push_back({e.vertex, e.halfedge, e.parameter});
        }
    }
    return State{std::move(paths), std::move(form), std::move(*refined), std::move(*patches),
                 std::move(quotients)};
}

double Fairing::quotient_beside(const State& state, Index edge) const
{
    return std::min(state.quotients[layout_.face(2 * edge)],
                    state.quotients[layout_.face(2 * edge + 1)]);
}

void Fairing::choose()
{
    if (!state_) {
        std::vector<Path> paths(original_.strand_count());
        for (Index strand = 0; strand < paths.size(); ++strand) {
            for (Index id = original_.first(strand); id != kNone; id = original_.element(id).next) {
                const NormalForm::Element& e = original_.element(id);
                paths[strand].push_back({e.vertex, e.halfedge, e.parameter});
            }
        }
        state_ = state_of(std::move(paths), false);
        if (!state_) {
            stage_ = Stage::done;
            return;
        }
        first_quotient_ = worst_of(state_->quotients);
    }
    std::vector<std::pair<double, Index>> order;
    for (Index edge = 0; edge < layout_.edge_count(); ++edge) {
        if (waiting_[edge] && quotient_beside(*state_, edge) < kRoundEnough) {
            order.emplace_back(quotient_beside(*state_, edge), edge);
        }
    }
    progress_ = std::max(progress_, 1 - static_cast<double>(order.size()) /
                                            std::max(Index{1}, layout_.edge_count()));
    if (order.empty()) {
        stage_ = Stage::widen;
        return;
    }
    std::sort(order.begin(), order.end());
    batch_.clear();
    traces_.clear();
    std::vector<bool> used(layout_.face_count(), false);
    for (const auto& [quotient, edge] : order) {
        const Index left = layout_.face(2 * edge);
        const Index right = layout_.face(2 * edge + 1);
        if (!used[left] && !used[right]) {
            used[left] = used[right] = true;
            batch_.push_back(edge);
        }
    }
    stage_ = Stage::trace;
}

void Fairing::trace(Index edge)
{
    waiting_[edge] = false;
    ++attempts_[edge];
    traces_.push_back(straightened(edge).value_or(Path()));
    if (traces_.size() == batch_.size()) {
        stage_ = Stage::compare;
    }
}

std::optional<Fairing::Path> Fairing::straightened(Index edge) const
{
    const Index left = layout_.face(2 * edge);
    const Index right = layout_.face(2 * edge + 1);
    const Index left_side = place_in(layout_.face_halfedges(left), 2 * edge);
    const Index right_side = place_in(layout_.face_halfedges(right), 2 * edge + 1);
    const RefinedMesh& refined = state_->refined;
    const Patch disk = united(state_->patches[left], left_side, state_->patches[right], right_side);
    const auto map = parametrise(disk, refined.positions,
                                 inscribed_polygon(side_lengths(disk, refined.positions)), {0});
    if (!map) {
        return std::nullopt;
    }
    // The union begins where the chain ends.
    const Index start = disk.sides[state_->patches[left].side_count() - 1];
    const auto line = straight_line(disk, *map, start, 0);
    if (!line) {
        return std::nullopt;
    }
    const TriangleMesh& target = original_.mesh();
    const TargetPlaces places(target, refined, disk, *map);
    Path path{state_->paths[edge].front()};
    for (const LineCrossing& crossing : *line) {
        const Index crossed = places.common_edge(crossing.right, crossing.left);
        if (crossed == kNone) {
            continue;  // inside of a face of the target
        }
        const Index face = refined.triangle_faces[disk.triangles[map->parents[crossing.triangle]]];
        Index h = 3 * face;
        while (target.edge(h) != crossed) {
            ++h;
        }
        const double from = places.parameter_on(crossed, crossing.right);
        const double to = places.parameter_on(crossed, crossing.left);
        path.push_back({kNone, h, (1 - crossing.share) * from + crossing.share * to});
    }
    path.push_back(state_->paths[edge].back());
    return path;
}

void Fairing::compare()
{
    const auto state_with = [&](const std::vector<bool>& chosen) {
        std::vector<Path> paths = state_->paths;
        for (std::size_t i = 0; i < batch_.size(); ++i) {
            if (chosen[i]) {
                paths[batch_[i]] = traces_[i];
            }
        }
        return state_of(std::move(paths), true);
    };
    std::vector<bool> chosen;
    for (const Path& path : traces_) {
        chosen.push_back(!path.empty());
    }
    std::optional<State> next = state_with(chosen);
    bool all = true;
    bool any = false;
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        const Index edge = batch_[i];
        const bool better =
            next && chosen[i] &&
            quotient_beside(*next, edge) > (1 + kLeastGain) * quotient_beside(*state_, edge);
        all = all && better == chosen[i];
        any = any || better;
        chosen[i] = better;
    }
    stage_ = Stage::choose;
    if (any && !all) {
        next = state_with(chosen);
    }
    // Gaps that were made for others may cost a thin patch more than was gained.
    if (!any || !next ||
        worst_of(next->quotients) < (1 - kQuotientRounding) * worst_of(state_->quotients)) {
        return;
    }
    state_ = std::move(next);
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        if (!chosen[i]) {
            continue;
        }
        ++kept_;
        changed_ = true;
        for (const Index side : {2 * batch_[i], 2 * batch_[i] + 1}) {
            for (const Index h : layout_.face_halfedges(layout_.face(side))) {
                const Index other = Layout::edge(h);
                const Index face = layout_.face(Layout::twin(h));
                waiting_[other] = waiting_[other] ||
                                  (other != batch_[i] && face != kNone && face != layout_.face(h) &&
                                   attempts_[other] < options_.rounds);
            }
        }
    }
}

void Fairing::widen()
{
    const auto worst = std::min_element(state_->quotients.begin(), state_->quotients.end());
    stage_ = Stage::smooth;
    if (worst == state_->quotients.end() || *worst >= kThin || rounds_++ == kMostWidenings) {
        return;
    }
    // Those that are nearly as thin would only lose what one of them gains.
    const auto is_thin = [&](Index face) {
        return face != kNone && state_->quotients[face] < kWidening * *worst;
    };
    const TriangleMesh& mesh = original_.mesh();
    NormalForm form = state_->form;
    CrossingGaps gaps = gaps_;
    for (Index strand = 0; strand < form.strand_count(); ++strand) {
        for (Index id = form.first(strand); id != kNone; id = form.element(id).next) {
            const NormalForm::Element& x = form.element(id);
            if (!x.is_crossing()) {
                continue;
            }
            // The head of the halfedge lies on the left of the strand.
            const bool along = mesh.halfedge(form.edge(id)) == x.halfedge;
            for (const bool on_left : {true, false}) {
                if (!is_thin(layout_.face(2 * strand + (on_left ? 0 : 1)))) {
                    continue;
                }
                const bool towards_tail = on_left != along;
                const Index beside = towards_tail ? x.edge_previous : x.edge_next;
                const double other = beside != kNone ? form.element(beside).parameter
                                     : towards_tail  ? 0
                                                     : 1;
                gaps.raise(id, towards_tail, kWidening * std::abs(x.parameter - other));
            }
        }
    }
    keep_gaps(form, gaps);
    const auto refined = cut_along(layout_, form);
    if (!refined) {
        return;
    }
    std::vector<double> quotients = quotients_of(layout_, *refined);
    const bool has_risen = *worst > (1 + kLeastGain) * first_quotient_;
    if (worst_of(quotients) > (1 + (has_risen ? kWorthWidening : kLeastGain)) * *worst) {
        gaps_ = std::move(gaps);
        state_->form = std::move(form);
        state_->quotients = std::move(quotients);
        changed_ = true;
        stage_ = Stage::widen;
    }
}

void Fairing::smooth()
{
    if (!changed_ || sweeps_ == kSmoothingSweeps) {
        conclude();
        return;
    }
    if (sweeps_++ == 0) {
        least_quotient_ = std::max(first_quotient_, kKeptQuotient * worst_of(state_->quotients));
    }
    NormalForm form = state_->form;
    for (Index edge = 0; edge < form.mesh().edge_count(); ++edge) {
        if (form.crossing_count(edge) > 0) {
            balancing_.balance(form, edge, gaps_);
        }
    }
    const auto refined = cut_along(layout_, form);
    if (!refined || worst_of(quotients_of(layout_, *refined)) < least_quotient_) {
        conclude();
        return;
    }
    state_->form = std::move(form);
}

void Fairing::conclude()
{
    if (state_ && changed_) {
        original_ = std::move(state_->form);
    }
    state_.reset();
    progress_ = 1;
    stage_ = Stage::done;
}

void Fairing::finish()
{
    if (stage_ != Stage::done) {
        conclude();
    }
}

NormalForm Fairing::take()
{
    return std::move(original_);
}

}  // namespace layout_embedding
