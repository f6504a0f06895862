#include "maps/seam_optimisation.hh"

#include <algorithm>
#include <cmath>
#include <map>

#include "embedding/realisation.hh"
#include "maps/map_distortion.hh"
#include "maps/map_optimisation.hh"
#include "maps/moving_patch.hh"
#include "patches/patch_union.hh"
#include "patches/straight_line.hh"
#include "patches/target_places.hh"

namespace layout_embedding {
namespace {

/// Rounds of optimisation in a union, and in the patches on both sides of a new path.
constexpr int kUnionRounds = 8;
constexpr int kPatchRounds = 4;
/// By how much of what it exceeds an isometry by a new path has to lower the energy of its patches.
constexpr double kSeamGain = 1e-3;
/// What a new crossing keeps of its room on an edge as distance to neighbours.
constexpr double kSeamGap = 0.1;
constexpr std::int64_t kLeastShareStep = 64;

Index side_place(const Layout& layout, Index halfedge)
{
    const auto halfedges = layout.face_halfedges(layout.face(halfedge));
    return static_cast<Index>(std::find(halfedges.begin(), halfedges.end(), halfedge) -
                              halfedges.begin());
}

/// The halfedges of the layout that are the sides of a union.
std::vector<Index> union_sides(const Layout& layout, Index edge)
{
    std::vector<Index> sides;
    for (const Index h : {2 * edge, 2 * edge + 1}) {
        const auto halfedges = layout.face_halfedges(layout.face(h));
        const std::size_t place = side_place(layout, h);
        for (std::size_t k = 1; k < halfedges.size(); ++k) {
            sides.push_back(halfedges[(place + k) % halfedges.size()]);
        }
    }
    return sides;
}

std::vector<Vec3> positions_in(const PlacedTarget& target, const PlacedPatch& placed)
{
    return placed.map.positions(placed.patch, target.refined().positions);
}

/// The map of a patch whose boundary vertices and whose inner vertices of the target lie where they
/// do in the map of another patch with the same boundary; nothing if that is not one-to-one.
std::optional<PlacedPatch> transferred(const PlacedPatch& old, const Patch& patch)
{
    if (old.patch.sides != patch.sides) {
        return std::nullopt;
    }
    std::map<Index, Index> inner;
    for (Index v = old.patch.boundary_size(); v < old.patch.vertices.size(); ++v) {
        inner[old.patch.vertices[v]] = v;
    }
    std::map<std::array<Index, 2>, Index> splits;
    for (std::size_t i = 0; i < old.map.splits.size(); ++i) {
        splits[old.map.splits[i]] = static_cast<Index>(old.patch.vertices.size() + i);
    }
    Parametrisation map = unplaced_map(patch);
    std::vector<Index> ids;
    for (Index v = 0; v < patch.vertices.size(); ++v) {
        if (v < patch.boundary_size()) {
            ids.push_back(v);
            continue;
        }
        const auto found = inner.find(patch.vertices[v]);
        if (found == inner.end()) {
            return std::nullopt;
        }
        ids.push_back(found->second);
    }
    for (const auto& [a, b] : map.splits) {
        const auto found = splits.find({std::min(ids[a], ids[b]), std::max(ids[a], ids[b])});
        if (found == splits.end()) {
            return std::nullopt;
        }
        ids.push_back(found->second);
    }
    for (const Index id : ids) {
        map.points.push_back(old.map.points[id]);
    }
    if (!is_positive(map)) {
        return std::nullopt;
    }
    TriangleMesh mesh = mesh_of_map(map);
    return PlacedPatch{patch, std::move(map), std::move(mesh)};
}

}  // namespace

SeamOptimisation::SeamOptimisation(const Layout& layout, PlacedTarget& a, PlacedTarget& b,
                                   MapEnergy judged_by)
    : layout_(layout), targets_{&a, &b}, scale_(area_ratio(a, b)), judged_by_(judged_by)
{}

bool SeamOptimisation::step()
{
    switch (stage_) {
        case Stage::measure:
            measure();
            break;
        case Stage::choose:
            choose();
            break;
        case Stage::trace:
            trace();
            break;
        case Stage::place:
            place();
            break;
        case Stage::improve:
            improve();
            break;
        case Stage::judge:
            judge();
            break;
        case Stage::over:
            break;
    }
    return stage_ != Stage::over;
}

double SeamOptimisation::progress() const
{
    if (stage_ == Stage::measure || stage_ == Stage::over) {
        return stage_ == Stage::over ? 1 : 0;
    }
    return edge_count_ > 0 ? 1 - double(waiting_.size() + batch_.size()) / edge_count_ : 0;
}

/// The energy of one patch.
void SeamOptimisation::measure()
{
    const auto face = static_cast<Index>(energies_.size());
    if (face < layout_.face_count()) {
        energies_.push_back(patch_energy(targets_[0]->patches()[face], targets_[0]->positions(face),
                                         targets_[1]->patches()[face], targets_[1]->positions(face),
                                         scale_));
        return;
    }
    for (Index edge = 0; edge < layout_.edge_count(); ++edge) {
        const Index left = layout_.face(2 * edge);
        const Index right = layout_.face(2 * edge + 1);
        if (left != kNone && right != kNone && left != right) {
            waiting_.push_back(edge);
        }
    }
    edge_count_ = static_cast<Index>(waiting_.size());
    stage_ = Stage::choose;
}

/// The next batch.
void SeamOptimisation::choose()
{
    if (waiting_.empty()) {
        stage_ = Stage::over;
        return;
    }
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [&](Index x, Index y) { return energy_beside(x) > energy_beside(y); });
    std::vector<bool> used(layout_.face_count(), false);
    std::vector<Index> later;
    for (const Index edge : waiting_) {
        const Index left = layout_.face(2 * edge);
        const Index right = layout_.face(2 * edge + 1);
        if (used[left] || used[right]) {
            later.push_back(edge);
            continue;
        }
        used[left] = used[right] = true;
        batch_.push_back(edge);
    }
    std::reverse(batch_.begin(), batch_.end());
    waiting_ = std::move(later);
    traces_.clear();
    stage_ = Stage::trace;
}

/// A round in the union of an edge's patches, on one side.
void SeamOptimisation::trace()
{
    if (!trace_) {
        if (batch_.empty()) {
            attempts_.clear();
            if (!traces_.empty()) {
                attempts_.push_back(std::move(traces_));
            }
            stage_ = attempts_.empty() ? Stage::choose : Stage::place;
        } else if (!begin_trace(batch_.back())) {
            trace_.reset();
            batch_.pop_back();
        }
        return;
    }
    if (union_steps_ < 2 * kUnionRounds) {
        improve_union(union_steps_++ % 2 == 0 ? 1 : 0);
        return;
    }
    if (end_trace()) {
        traces_.push_back(std::move(*trace_));
    }
    trace_.reset();
    batch_.pop_back();
}

double SeamOptimisation::energy_beside(Index edge) const
{
    return energies_[layout_.face(2 * edge)] + energies_[layout_.face(2 * edge + 1)];
}

std::vector<SeamOptimisation::Path> SeamOptimisation::paths_of(std::size_t side) const
{
    const TriangleMesh& target = targets_[side]->target();
    const RefinedMesh& refined = targets_[side]->refined();
    std::map<std::array<Index, 2>, Index> faces;
    for (const std::vector<Index>& chain : refined.chains) {
        for (std::size_t i = 1; i < chain.size(); ++i) {
            faces[{chain[i - 1], chain[i]}] = kNone;
        }
    }
    for (Index h = 0; h < refined.corners.size(); ++h) {
        const Index a = refined.corners[h];
        const Index b = refined.corners[TriangleMesh::next(h)];
        for (const std::array<Index, 2>& ends : {std::array{a, b}, std::array{b, a}}) {
            const auto found = faces.find(ends);
            if (found != faces.end()) {
                found->second = refined.triangle_faces[h / 3];
            }
        }
    }
    std::vector<Path> paths;
    for (std::size_t e = 0; e < refined.chains.size(); ++e) {
        const std::vector<Index>& chain = refined.chains[e];
        Path& path = paths.emplace_back();
        for (std::size_t i = 0; i < chain.size(); ++i) {
            Place place;
            place.share = targets_[side]->shares()[e][i];
            if (chain[i] < target.vertex_count()) {
                place.vertex = chain[i];
            } else {
                const auto [edge, parameter] = edge_place(target, refined, chain[i]);
                const Index face = faces.at({chain[i - 1], chain[i]});
                place.parameter = parameter;
                place.halfedge = 3 * face;
                while (target.edge(place.halfedge) != edge && place.halfedge < 3 * face + 2) {
                    ++place.halfedge;
                }
            }
            path.push_back(place);
        }
    }
    return paths;
}

/// Maps the unions of both targets; false if they have no map.
bool SeamOptimisation::begin_trace(Index edge)
{
    const std::array<Index, 2> faces{layout_.face(2 * edge), layout_.face(2 * edge + 1)};
    const std::array<Index, 2> places{side_place(layout_, 2 * edge),
                                      side_place(layout_, 2 * edge + 1)};
    const std::vector<Index> sides = union_sides(layout_, edge);
    std::array<Patch, 2> unions;
    std::vector<double> lengths(sides.size(), 0);
    for (std::size_t side = 0; side < 2; ++side) {
        const PlacedTarget& target = *targets_[side];
        unions[side] = united(target.patches()[faces[0]].patch, places[0],
                              target.patches()[faces[1]].patch, places[1]);
        const std::vector<double> own = side_lengths(unions[side], target.refined().positions);
        for (std::size_t s = 0; s < sides.size(); ++s) {
            lengths[s] += (side == 0 ? 1 : std::sqrt(scale_)) * own[s];
        }
    }
    const auto domain = snapped(inscribed_polygon(lengths));
    if (!domain) {
        return false;
    }
    union_domain_ = *domain;
    union_steps_ = 0;
    trace_.emplace();
    trace_->edge = edge;
    for (std::size_t side = 0; side < 2; ++side) {
        const PlacedTarget& target = *targets_[side];
        const auto boundary = boundary_points(sides, unions[side], *domain, target.shares());
        auto placed =
            place_patch(std::move(unions[side]), target.refined().positions, *domain, boundary);
        if (!placed) {
            return false;
        }
        trace_->unions[side] = std::move(*placed);
        union_positions_[side] = positions_in(target, trace_->unions[side]);
    }
    return true;
}

void SeamOptimisation::improve_union(std::size_t side)
{
    PlacedPatch& own = trace_->unions[side];
    MovingPatch moving(own, union_positions_[side], trace_->unions[1 - side],
                       union_positions_[1 - side], side == 0 ? scale_ : 1 / scale_, side == 0,
                       judged_by_);
    moving.improve_all();
    own.map.points = moving.points();
}

/// Traces the paths in the unions; false if one has no straight line.
bool SeamOptimisation::end_trace()
{
    Trace& result = *trace_;
    const Index edge = result.edge;
    const std::array<Index, 2> faces{layout_.face(2 * edge), layout_.face(2 * edge + 1)};
    const std::array<Index, 2> places{side_place(layout_, 2 * edge),
                                      side_place(layout_, 2 * edge + 1)};
    // The union begins where the path ends.
    const auto left_count = static_cast<Index>(layout_.face_halfedges(faces[0]).size());
    const auto right_count = static_cast<Index>(layout_.face_halfedges(faces[1]).size());
    for (std::size_t side = 0; side < 2; ++side) {
        auto path = traced_path(side, result.unions[side], left_count - 1, union_domain_);
        if (!path) {
            return false;
        }
        result.paths[side] = std::move(*path);
    }
    result.halves[0].resize(left_count);
    for (Index k = 0; k < left_count; ++k) {
        result.halves[0][(places[0] + 1 + k) % left_count] = union_domain_[k];
    }
    result.halves[1].resize(right_count);
    for (Index k = 0; k < right_count; ++k) {
        result.halves[1][(places[1] + 1 + k) % right_count] =
            union_domain_[(left_count - 1 + k) % union_domain_.size()];
    }
    return true;
}

std::optional<SeamOptimisation::Path> SeamOptimisation::traced_path(std::size_t side,
                                                                    const PlacedPatch& united,
                                                                    Index start,
                                                                    const Domain& domain) const
{
    const TriangleMesh& target = targets_[side]->target();
    const RefinedMesh& refined = targets_[side]->refined();
    const Patch& disk = united.patch;
    const auto line = straight_line(disk, united.map, disk.sides[start], 0);
    if (!line) {
        return std::nullopt;
    }
    const TargetPlaces places(target, refined, disk, united.map);
    const PlanePoint from = domain[start];
    const PlanePoint along = domain[0] - from;
    Path path;
    path.push_back({disk.vertices[disk.sides[start]], kNone, 0, 0});
    for (const LineCrossing& crossing : *line) {
        const Index crossed = places.common_edge(crossing.right, crossing.left);
        if (crossed == kNone) {
            continue;  // inside of a face of the target
        }
        const Index face =
            refined.triangle_faces[disk.triangles[united.map.parents[crossing.triangle]]];
        Index h = 3 * face;
        while (target.edge(h) != crossed) {
            ++h;
        }
        const double right = places.parameter_on(crossed, crossing.right);
        const double left = places.parameter_on(crossed, crossing.left);
        const PlanePoint point = (1 - crossing.share) * united.map.points[crossing.right] +
                                 crossing.share * united.map.points[crossing.left];
        const double share = (point - from).dot(along) / along.squaredNorm();
        path.push_back(
            {kNone, h, (1 - crossing.share) * right + crossing.share * left,
             static_cast<std::int64_t>(std::round(share * static_cast<double>(kWholeShare)))});
    }
    path.push_back({disk.vertices[0], kNone, 0, kWholeShare});
    return path;
}

std::optional<PlacedTarget> SeamOptimisation::retraced(std::size_t side,
                                                       const std::vector<Path>& paths,
                                                       const std::vector<Trace>& traces) const
{
    const PlacedTarget& old = *targets_[side];
    const TriangleMesh& mesh = old.target();
    std::vector<bool> is_new(layout_.edge_count(), false);
    for (const Trace& trace : traces) {
        is_new[trace.edge] = true;
    }
    NormalForm form(mesh, layout_.edge_count());
    struct Crossing {
        Index edge;
        double parameter;
        Index id;
        bool is_new;
    };
    std::vector<Crossing> crossings;
    std::vector<std::int64_t> share_of;  // per element
    for (Index e = 0; e < paths.size(); ++e) {
        for (const Place& place : paths[e]) {
            const bool crosses = place.halfedge != kNone;
            const Index id =
                crosses ? form.add_crossing(place.halfedge) : form.add_vertex(place.vertex);
            form.append_to_strand(e, id);
            share_of.resize(std::max<std::size_t>(share_of.size(), id + 1));
            share_of[id] = place.share;
            if (crosses) {
                crossings.push_back({mesh.edge(place.halfedge), place.parameter, id, is_new[e]});
            }
        }
    }
    std::stable_sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.parameter < b.parameter;
    });
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        Crossing& crossing = crossings[i];
        const bool has_lower = i > 0 && crossings[i - 1].edge == crossing.edge;
        const bool has_upper = i + 1 < crossings.size() && crossings[i + 1].edge == crossing.edge;
        const double low = has_lower ? crossings[i - 1].parameter : 0;
        const double high = has_upper ? crossings[i + 1].parameter : 1;
        if (crossing.is_new) {
            const double gap = kSeamGap * (high - low);
            crossing.parameter = std::clamp(crossing.parameter, low + gap, high - gap);
        }
        if (!(crossing.parameter > low && crossing.parameter < 1)) {
            return std::nullopt;
        }
        form.set_parameter(crossing.id, crossing.parameter);
        form.append_to_edge(crossing.id);
    }
    form.remove_bigons();
    std::vector<ChainShares> shares(layout_.edge_count());
    for (Index e = 0; e < layout_.edge_count(); ++e) {
        for (Index id = form.first(e); id != kNone; id = form.element(id).next) {
            shares[e].push_back(share_of[id]);
        }
        ChainShares& list = shares[e];
        // Rounding may have put neighbours at the same place.
        for (std::size_t i = 1; i + 1 < list.size(); ++i) {
            list[i] = std::max(list[i], list[i - 1] + kLeastShareStep);
        }
        for (std::size_t i = list.size() - 1; i-- > 1;) {
            list[i] = std::min(list[i], list[i + 1] - kLeastShareStep);
        }
    }
    auto refined = cut_along(layout_, form);
    if (!refined) {
        return std::nullopt;
    }
    auto patches = patches_of(layout_, *refined);
    if (!patches) {
        return std::nullopt;
    }
    for (Index e = 0; e < layout_.edge_count(); ++e) {
        if (refined->chains[e].size() != shares[e].size()) {
            return std::nullopt;
        }
    }
    std::vector<Domain> domains = old.domains();
    std::vector<const PlacedPatch*> sources(layout_.face_count(), nullptr);
    for (const Trace& trace : traces) {
        for (std::size_t k = 0; k < 2; ++k) {
            const Index face = layout_.face(2 * trace.edge + static_cast<Index>(k));
            domains[face] = trace.halves[k];
            sources[face] = &trace.unions[side];
        }
    }
    std::vector<PlacedPatch> placed;
    for (Patch& patch : *patches) {
        const Index face = patch.face;
        if (sources[face] == nullptr) {
            auto same = transferred(old.patches()[face], patch);
            if (!same) {
                return std::nullopt;
            }
            placed.push_back(std::move(*same));
            continue;
        }
        const auto boundary =
            boundary_points(layout_.face_halfedges(face), patch, domains[face], shares);
        auto made = place_patch(std::move(patch), refined->positions, domains[face], boundary);
        if (!made) {
            return std::nullopt;
        }
        // Where the union had them, if that does.
        std::map<Index, PlanePoint> points;
        const PlacedPatch& source = *sources[face];
        for (Index v = source.patch.boundary_size(); v < source.patch.vertices.size(); ++v) {
            points[source.patch.vertices[v]] = source.map.points[v];
        }
        Parametrisation map = made->map;
        for (Index v = made->patch.boundary_size(); v < made->patch.vertices.size(); ++v) {
            const auto found = points.find(made->patch.vertices[v]);
            if (found != points.end() && found->first < mesh.vertex_count()) {
                map.points[v] = found->second;
            }
        }
        if (is_positive(map)) {
            made->map = std::move(map);
        }
        placed.push_back(std::move(*made));
    }
    return PlacedTarget(
        {old.embedded().target, std::make_shared<const RefinedMesh>(std::move(*refined))},
        std::move(domains), std::move(placed), std::move(shares));
}

std::optional<PlacedTarget> SeamOptimisation::attempt(std::size_t side,
                                                      const std::vector<Trace>& traces) const
{
    std::vector<Path> paths = paths_of(side);
    for (const Trace& trace : traces) {
        paths[trace.edge] = trace.paths[side];
    }
    return retraced(side, paths, traces);
}

/// Traces of the next attempt on one target.
void SeamOptimisation::place()
{
    if (attempts_.empty()) {
        stage_ = Stage::choose;
        return;
    }
    auto made = attempt(moved_.size(), attempts_.back());
    if (!made) {
        // One of them does not fit; the others may.
        moved_.clear();
        const std::vector<Trace> traces = std::move(attempts_.back());
        attempts_.pop_back();
        if (traces.size() > 1) {
            const auto middle = traces.begin() + static_cast<std::ptrdiff_t>(traces.size() / 2);
            attempts_.emplace_back(middle, traces.end());
            attempts_.emplace_back(traces.begin(), middle);
        }
        return;
    }
    moved_.push_back(std::move(*made));
    if (moved_.size() == 2) {
        optimisation_ =
            std::make_unique<MapOptimisation>(layout_, moved_[0], moved_[1], judged_by_);
        patch_rounds_ = 0;
        stage_ = Stage::improve;
    }
}

/// A step of the rounds in the patches beside new paths.
void SeamOptimisation::improve()
{
    if (optimisation_->step()) {
        return;
    }
    if (patch_rounds_++ == kPatchRounds) {
        optimisation_.reset();
        stage_ = Stage::judge;
        return;
    }
    // Other chains stay, as what is beside them may not be kept.
    std::vector<bool> faces(layout_.face_count(), false);
    std::vector<bool> edges(layout_.edge_count(), false);
    for (const Trace& trace : attempts_.back()) {
        edges[trace.edge] = true;
        faces[layout_.face(2 * trace.edge)] = faces[layout_.face(2 * trace.edge + 1)] = true;
    }
    optimisation_->begin_round(std::move(faces), std::move(edges));
}

/// Keeps those traces of an attempt that lower the energy of their patches.
void SeamOptimisation::judge()
{
    const std::vector<Trace> traces = std::move(attempts_.back());
    attempts_.pop_back();
    std::vector<Trace> better;
    std::vector<double> energies = energies_;
    for (const Trace& trace : traces) {
        double area = 0;
        for (const Index h : {2 * trace.edge, 2 * trace.edge + 1}) {
            const Index face = layout_.face(h);
            const std::vector<Vec3> x = moved_[0].positions(face);
            energies[face] = patch_energy(moved_[0].patches()[face], x, moved_[1].patches()[face],
                                          moved_[1].positions(face), scale_);
            for (const auto& c : moved_[0].patches()[face].map.corners) {
                area += (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm() / 2;
            }
        }
        const double before = energy_beside(trace.edge);
        const double after =
            energies[layout_.face(2 * trace.edge)] + energies[layout_.face(2 * trace.edge + 1)];
        if (after < before - kSeamGain * (before - 4 * area)) {
            better.push_back(trace);
        }
    }
    if (better.size() == traces.size() || (!better.empty() && narrow_to(better))) {
        for (const Trace& trace : better) {
            for (const Index h : {2 * trace.edge, 2 * trace.edge + 1}) {
                energies_[layout_.face(h)] = energies[layout_.face(h)];
            }
        }
        for (std::size_t side = 0; side < 2; ++side) {
            *targets_[side] = std::move(moved_[side]);
        }
        kept_ += static_cast<Index>(better.size());
    }
    moved_.clear();
    stage_ = Stage::place;
}

/// Makes what has been moved anew with some of its new paths alone; their maps are those that were
/// found. False if they do not fit.
bool SeamOptimisation::narrow_to(const std::vector<Trace>& traces)
{
    std::vector<PlacedTarget> chosen;
    for (std::size_t side = 0; side < 2; ++side) {
        auto made = attempt(side, traces);
        if (!made) {
            return false;
        }
        chosen.push_back(std::move(*made));
    }
    for (std::size_t side = 0; side < 2; ++side) {
        for (const Trace& trace : traces) {
            chosen[side].set_shares(trace.edge, moved_[side].shares()[trace.edge]);
            for (const Index h : {2 * trace.edge, 2 * trace.edge + 1}) {
                const Index face = layout_.face(h);
                const auto same =
                    transferred(moved_[side].patches()[face], chosen[side].patches()[face].patch);
                if (!same || same->map.corners != chosen[side].patches()[face].map.corners) {
                    return false;
                }
                chosen[side].set_points(face, same->map.points);
            }
        }
    }
    moved_ = std::move(chosen);
    return true;
}

}  // namespace layout_embedding
