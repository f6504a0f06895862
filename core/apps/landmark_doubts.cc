#include "apps/landmark_doubts.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <queue>
#include <span>

#include "embedding/check_input.hh"

namespace layout_embedding {

namespace {

// Exchanges that are tried out.
constexpr std::size_t kMaxExchanges = 3;
// Vertices of the target that the search for exchanges may settle; a second or so.
constexpr std::uint64_t kMaxSettled = 4'000'000;
// An exchange has to shorten the sum of unconstrained paths to this share.
constexpr double kWorthwhile = 0.95;
constexpr std::uint64_t kLeastWork = 100'000;

Length share(Length length, double factor)
{
    return static_cast<Length>(static_cast<double>(length) * factor);
}

/// The layout with all faces the other way round.
std::shared_ptr<const Layout> mirror_image(const Layout& layout)
{
    const PolygonMesh mesh = to_polygons(layout);
    PolygonMesh mirrored;
    mirrored.positions = mesh.positions;
    for (Index f = 0; f < layout.face_count(); ++f) {
        std::vector<Index> corners(mesh.corners.begin() + mesh.face_offsets[f],
                                   mesh.corners.begin() + mesh.face_offsets[f + 1]);
        std::reverse(corners.begin(), corners.end());
        mirrored.add_face(corners);
    }
    auto result = Layout::from_polygons(mirrored, "the layout's mirror image");
    return result ? std::make_shared<const Layout>(std::move(*result)) : nullptr;
}

/// Distances along the edges of the target from one vertex to some others.
class EdgeDistances {
public:
    explicit EdgeDistances(const TriangleMesh& target)
        : target_(target),
          is_goal_(target.vertex_count(), false),
          distances_(target.vertex_count(), std::numeric_limits<double>::infinity())
    {}

    /// Per goal, all different, in their order; does not look farther than the last of them.
    std::vector<double> from(Index start, std::span<const Index> goals)
    {
        for (const Index goal : goals) {
            is_goal_[goal] = true;
        }
        std::vector<Index> reached;
        using Entry = std::pair<double, Index>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        const auto offer = [&](Index vertex, double distance) {
            if (distance < distances_[vertex]) {
                reached.push_back(vertex);
                distances_[vertex] = distance;
                queue.emplace(distance, vertex);
            }
        };
        offer(start, 0);
        std::size_t missing = goals.size();
        while (!queue.empty() && missing > 0) {
            const auto [distance, vertex] = queue.top();
            queue.pop();
            if (distance > distances_[vertex]) {
                continue;
            }
            missing -= is_goal_[vertex] ? 1 : 0;
            for (Index h = target_.outgoing(vertex); h != kNone;) {
                // Both edges of this face at the vertex: at a boundary there is no other face.
                offer(target_.head(h), distance + length(vertex, target_.head(h)));
                const Index last = TriangleMesh::previous(h);
                offer(target_.tail(last), distance + length(vertex, target_.tail(last)));
                h = target_.rotated_ccw(h);
                if (h == target_.outgoing(vertex)) {
                    break;
                }
            }
        }
        std::vector<double> result;
        for (const Index goal : goals) {
            result.push_back(distances_[goal]);
            is_goal_[goal] = false;
        }
        for (const Index vertex : reached) {
            distances_[vertex] = std::numeric_limits<double>::infinity();
        }
        return result;
    }

private:
    double length(Index a, Index b) const
    {
        return (target_.position(a) - target_.position(b)).norm();
    }

    const TriangleMesh& target_;
    std::vector<bool> is_goal_;
    std::vector<double> distances_;
};

std::string rounded(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

}  // namespace

LandmarkDoubts::LandmarkDoubts(const EmbeddingProblem& problem, const PathGraph& graph,
                               std::uint64_t field_bytes, const Found& found)
    : problem_(problem),
      graph_(graph),
      field_bytes_(field_bytes),
      cost_(found.cost),
      // Where nothing was found, what is found instead has to fit well.
      threshold_(found.cost != kInfiniteLength ? share(found.cost, kFarShorter)
                                               : share(found.root_bound, 1 / kFarShorter)),
      work_limit_(2 * found.work + kLeastWork)
{
    if (found.root_bound == 0 || found.root_bound == kInfiniteLength) {
        return;
    }
    if (found.root_bound <= threshold_) {
        candidates_.push_back({LandmarkDoubt::Kind::mirrored, kNone, kNone});
    }
    propose_exchanges(found.root_bound);
}

void LandmarkDoubts::propose_exchanges(Length root_bound)
{
    const Layout& layout = *problem_.layout;
    const Index count = layout.vertex_count();
    if (std::uint64_t{count} * problem_.target->vertex_count() > kMaxSettled) {
        return;
    }
    EdgeDistances distances(*problem_.target);
    // The lengths of all edges, and of those at each vertex.
    std::vector<double> lengths(layout.edge_count());
    std::vector<double> around(count, 0);
    double sum = 0;
    for (Index v = 0; v < count; ++v) {
        std::vector<Index> ends;
        std::vector<Index> edges;
        for (const Index h : layout.outgoing(v)) {
            if (h % 2 == 0) {
                edges.push_back(Layout::edge(h));
                ends.push_back(problem_.landmarks[layout.head(h)]);
            }
        }
        const std::vector<double> from_here = distances.from(problem_.landmarks[v], ends);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            lengths[edges[i]] = from_here[i];
        }
    }
    for (Index e = 0; e < layout.edge_count(); ++e) {
        sum += lengths[e];
        around[layout.tail(2 * e)] += lengths[e];
        around[layout.head(2 * e)] += lengths[e];
    }
    const auto is_worthwhile = [&](double after) {
        return after < kWorthwhile * sum && share(root_bound, after / sum) < threshold_;
    };
    // From landmark to landmark, where it matters.
    std::vector<std::vector<double>> between(count);
    const auto between_from = [&](Index v) -> const std::vector<double>& {
        if (between[v].empty()) {
            between[v] = distances.from(problem_.landmarks[v], problem_.landmarks);
        }
        return between[v];
    };
    struct Exchange {
        double sum;
        Index a;
        Index b;
    };
    std::vector<Exchange> exchanges;
    for (Index a = 0; a < count; ++a) {
        for (Index b = a + 1; b < count; ++b) {
            const bool boundary = problem_.target->is_boundary_vertex(problem_.landmarks[a]);
            if (boundary != problem_.target->is_boundary_vertex(problem_.landmarks[b])) {
                continue;
            }
            // Only edges at the two can become shorter, and none of them below zero.
            if (!is_worthwhile(std::max(0.0, sum - around[a] - around[b]))) {
                continue;
            }
            double after = sum;
            for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
                for (const Index h : layout.outgoing(from)) {
                    const Index neighbour = layout.head(h);
                    if (neighbour != to) {
                        after += between_from(to)[neighbour] - between_from(from)[neighbour];
                    }
                }
            }
            if (is_worthwhile(after)) {
                exchanges.push_back({after, a, b});
            }
        }
    }
    std::stable_sort(exchanges.begin(), exchanges.end(),
                     [](const Exchange& x, const Exchange& y) { return x.sum < y.sum; });
    exchanges.resize(std::min(exchanges.size(), kMaxExchanges));
    for (const Exchange& exchange : exchanges) {
        candidates_.push_back({LandmarkDoubt::Kind::exchanged, exchange.a, exchange.b});
    }
}

void LandmarkDoubts::begin()
{
    const Candidate& candidate = candidates_[next_];
    changed_ = std::make_unique<EmbeddingProblem>(problem_);
    if (candidate.kind == LandmarkDoubt::Kind::mirrored) {
        changed_->layout = mirror_image(*problem_.layout);
    } else {
        std::swap(changed_->landmarks[candidate.a], changed_->landmarks[candidate.b]);
    }
    work_ = 0;
    if (changed_->layout) {
        solver_ = std::make_unique<SequenceSolver>(*changed_, graph_, field_bytes_,
                                                   SequenceSolverOptions{});
    } else {
        ++next_;
    }
}

bool LandmarkDoubts::run(WorkBudget& budget)
{
    while (next_ < candidates_.size()) {
        if (!solver_) {
            begin();
            continue;
        }
        if (budget.is_spent()) {
            return true;
        }
        WorkBudget part(std::min(budget.left(), work_limit_ - std::min(work_, work_limit_)));
        const auto outcome = solver_->run(part);
        work_ += part.spent();
        budget.charge(part.spent());
        const bool found =
            outcome == Solver::Outcome::improved && solver_->incumbent_cost() <= threshold_;
        // A tie would need other perturbations: not worth it for a doubt.
        const bool ended =
            outcome == Solver::Outcome::finished || outcome == Solver::Outcome::tied ||
            work_ >= work_limit_ ||
            (outcome != Solver::Outcome::running && solver_->lower_bound() > threshold_);
        if (found) {
            take_down(solver_->incumbent_cost());
        } else if (ended) {
            ++next_;
        }
        if (found || ended) {
            solver_.reset();
            changed_.reset();
        }
    }
    return false;
}

void LandmarkDoubts::take_down(Length cost)
{
    const Candidate& candidate = candidates_[next_];
    LandmarkDoubt doubt{candidate.kind, candidate.a, candidate.b, graph_.to_units(cost), {}};
    const std::string costs =
        cost_ == kInfiniteLength
            ? "has an embedding of cost " + rounded(doubt.cost) + " where the input has none"
            : "embeds with cost " + rounded(doubt.cost) + " instead of " +
                  rounded(graph_.to_units(cost_));
    if (candidate.kind == LandmarkDoubt::Kind::mirrored) {
        doubt.message = "the mirror image of the layout " + costs +
                        "; check whether the layout or the target is inside out.";
    } else {
        const auto place = [&](Index v) {
            return std::to_string(v) + " (target vertex " + std::to_string(problem_.landmarks[v]) +
                   ")";
        };
        doubt.message = "the layout with the landmarks " + place(candidate.a) + " and " +
                        place(candidate.b) + " exchanged " + costs +
                        "; check whether they were swapped.";
    }
    doubts_.push_back(std::move(doubt));
    next_ = candidates_.size();
}

}  // namespace layout_embedding
