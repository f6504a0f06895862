#include "shapes/collection_check.hh"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "apps/embed_job.hh"
#include "apps/template_layout.hh"
#include "base/random.hh"
#include "patches/patch_shape.hh"

namespace layout_embedding::shapes {

namespace {

// A heuristic ends clearly above the best embedding if it costs so many times as much.
constexpr double kClearlyAbove = 1.05;
constexpr double kFarAbove = 1.1;

/// A member with the layout made of it.
struct Member {
    std::shared_ptr<const TriangleMesh> mesh;
    std::vector<Index> landmarks;
    std::shared_ptr<const Layout> layout;
};

struct Totals {
    Index pairs = 0;
    Index embedded = 0;
    Index in_every_shape = 0;
    double smallest_angle = 60;  // in degrees
    Index hard = 0;
    Index very_hard = 0;
    Index proved = 0;
    std::vector<double> seconds;  // of CPU time
    Index mirrored = 0;
    Index mirrored_said = 0;
    Index exchanged = 0;
    Index exchanged_said = 0;
    Index wrong_pair_said = 0;
    Index false_alarms = 0;
};

// Enough for good embeddings of inputs that are wrong; proofs are not what is asked for there.
constexpr std::uint64_t kWork = 2'000'000;

EmbedJob solved(const EmbeddingProblem& problem, Algorithm algorithm)
{
    EmbedOptions options;
    if (algorithm == Algorithm::branch_and_bound) {
        options.work_limit = kWork;
    }
    options.algorithm = algorithm;
    options.gap = 0;
    EmbedJob job(problem, options);
    while (job.step()) {
    }
    return job;
}

EmbedResult solve(const EmbeddingProblem& problem, Algorithm algorithm)
{
    return solved(problem, algorithm).result();
}

/// Realises an embedding in all path shapes, each through the checker, and `short` not longer than
/// `even`; what goes wrong is printed.
bool realise_in_every_shape(EmbedJob& job, double& smallest_angle)
{
    bool all = true;
    for (const auto& [shape, name] :
         {std::pair{PathShape::even, "even"}, std::pair{PathShape::shortened, "short"},
          std::pair{PathShape::fair, "fair"}}) {
        job.reshape(shape);
        while (job.step()) {
        }
        const EmbedResult& result = job.result();
        if (!result.refined) {
            std::printf("    %s: %s\n", name, job.error().message.c_str());
            return false;
        }
        smallest_angle = std::min(smallest_angle, result.quality.smallest_angle);
        double length = 0;
        double even_length = 0;
        for (std::size_t e = 0; e < result.refined->chains.size(); ++e) {
            length += chain_length(*result.refined, result.refined->chains[e]);
            even_length += result.even_lengths[e];
        }
        if (shape == PathShape::shortened && length > even_length) {
            std::printf("    short: longer than even, %g of %g\n", length, even_length);
            all = false;
        }
    }
    return all;
}

bool says(const EmbedResult& result, LandmarkDoubt::Kind kind)
{
    return std::any_of(result.doubts.begin(), result.doubts.end(),
                       [&](const LandmarkDoubt& doubt) { return doubt.kind == kind; });
}

std::shared_ptr<const Layout> layout_of(const PolygonMesh& mesh, bool mirrored)
{
    PolygonMesh faces;
    faces.positions = mesh.positions;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> corners(mesh.corners.begin() + mesh.face_offsets[f],
                                   mesh.corners.begin() + mesh.face_offsets[f + 1]);
        if (mirrored) {
            std::reverse(corners.begin(), corners.end());
        }
        faces.add_face(corners);
    }
    auto layout = Layout::from_polygons(faces, "the template");
    return layout ? std::make_shared<const Layout>(std::move(*layout)) : nullptr;
}

/// The problem with its mirror image, and with two random landmarks exchanged.
void test_doubts(const EmbeddingProblem& problem, const PolygonMesh& layout_mesh, double right_cost,
                 Random& random, Totals& totals)
{
    EmbeddingProblem mirrored = problem;
    mirrored.layout = layout_of(layout_mesh, true);
    const EmbedResult inside_out = solve(mirrored, Algorithm::branch_and_bound);
    if (right_cost <= LandmarkDoubts::kFarShorter * inside_out.cost) {
        ++totals.mirrored;
        totals.mirrored_said += says(inside_out, LandmarkDoubt::Kind::mirrored) ? 1 : 0;
    }
    EmbeddingProblem exchanged = problem;
    const auto count = static_cast<Index>(problem.landmarks.size());
    const auto a = static_cast<Index>(random.below(count));
    const auto b = static_cast<Index>((a + 1 + random.below(count - 1)) % count);
    std::swap(exchanged.landmarks[a], exchanged.landmarks[b]);
    const EmbedResult swapped = solve(exchanged, Algorithm::branch_and_bound);
    if (right_cost <= LandmarkDoubts::kFarShorter * swapped.cost) {
        ++totals.exchanged;
        const bool said = says(swapped, LandmarkDoubt::Kind::exchanged);
        totals.exchanged_said += said ? 1 : 0;
        if (said) {
            const LandmarkDoubt& doubt = swapped.doubts.back();
            totals.wrong_pair_said +=
                doubt.a == std::min(a, b) && doubt.b == std::max(a, b) ? 0 : 1;
        }
    }
    std::printf("    mirrored %.3f%s, %u and %u exchanged %.3f%s\n", inside_out.cost / right_cost,
                says(inside_out, LandmarkDoubt::Kind::mirrored) ? " (said)" : "", a, b,
                swapped.cost / right_cost,
                says(swapped, LandmarkDoubt::Kind::exchanged) ? " (said)" : "");
}

void check_pair(const ShapeClass& shape_class, Index from, Index to,
                const std::vector<Member>& members, const std::vector<PolygonMesh>& templates,
                const CollectionCheckOptions& options, Totals& totals)
{
    const Member& source = members[from];
    const Member& target = members[to];
    std::printf("%-13s %-14s -> %-14s ", shape_class.name.c_str(),
                shape_class.members[from].c_str(), shape_class.members[to].c_str());
    ++totals.pairs;
    auto problem = make_problem(source.layout, target.mesh, target.landmarks);
    if (!problem) {
        std::printf("%s\n", problem.error().message.c_str());
        return;
    }
    EmbedJob job = solved(*problem, Algorithm::exact);
    const EmbedResult result = job.result();
    totals.seconds.push_back(result.cpu_seconds);
    double best = result.cost;
    std::vector<double> heuristics;
    for (const Algorithm algorithm :
         {Algorithm::greedy, Algorithm::praun, Algorithm::kraevoy, Algorithm::schreiner}) {
        heuristics.push_back(solve(*problem, algorithm).cost);
        best = std::min(best, heuristics.back());
    }
    if (!result.refined) {
        std::printf("no embedding\n");
        return;
    }
    ++totals.embedded;
    const double worst = *std::max_element(heuristics.begin(), heuristics.end());
    totals.hard += worst > kClearlyAbove * best ? 1 : 0;
    totals.very_hard += worst > kFarAbove * best ? 1 : 0;
    totals.proved += result.exact_cost == result.exact_lower_bound ? 1 : 0;
    totals.false_alarms += result.doubts.empty() ? 0 : 1;
    std::printf("%3u edges, gap %5.2f %%, %6.2f s, heuristics", problem->layout->edge_count(),
                100 * result.gap, result.cpu_seconds);
    for (const double cost : heuristics) {
        std::printf(" %6.3f", cost / best);
    }
    std::printf("%s\n", worst > kClearlyAbove * best ? "  hard" : "");
    for (const LandmarkDoubt& doubt : result.doubts) {
        std::printf("    false alarm: %s\n", doubt.message.c_str());
    }
    totals.in_every_shape += realise_in_every_shape(job, totals.smallest_angle) ? 1 : 0;
    if (options.doubts) {
        Random random(1000 * from + to);
        test_doubts(*problem, templates[from], result.cost, random, totals);
    }
    std::fflush(stdout);
}

}  // namespace

bool check_collection(const std::vector<const ShapeClass*>& classes,
                      const CollectionCheckOptions& options)
{
    Totals totals;
    for (const ShapeClass* const shape_class : classes) {
        std::vector<Member> members;
        std::vector<PolygonMesh> templates;
        const Index count = shape_class->member_count();
        for (Index m = 0; m < count; ++m) {
            auto shape = make_shape(*shape_class, m, {options.vertices, options.seed});
            if (!shape) {
                std::printf("%s\n", shape.error().message.c_str());
                return false;
            }
            Member member{std::make_shared<const TriangleMesh>(shape->mesh), shape->landmarks, {}};
            auto layout = template_layout(*member.mesh, member.landmarks);
            if (!layout) {
                std::printf("%s: %s\n", shape_class->members[m].c_str(),
                            layout.error().message.c_str());
                return false;
            }
            member.layout = layout_of(layout->mesh, false);
            members.push_back(std::move(member));
            templates.push_back(std::move(layout->mesh));
        }
        for (Index from = 0; from < count; ++from) {
            for (Index step = 1; step <= std::min(options.others, count - 1); ++step) {
                check_pair(*shape_class, from, (from + step) % count, members, templates, options,
                           totals);
            }
        }
    }
    std::printf(
        "%u of %u templates embedded; on %u a heuristic ends more than %.0f %% above the best "
        "embedding, on %u more than %.0f %%; %u false alarms about landmarks\n",
        totals.embedded, totals.pairs, totals.hard, 100 * (kClearlyAbove - 1), totals.very_hard,
        100 * (kFarAbove - 1), totals.false_alarms);
    std::printf("%u valid in every path shape, with a smallest angle of %.2f degrees\n",
                totals.in_every_shape, totals.smallest_angle);
    if (!totals.seconds.empty()) {
        std::sort(totals.seconds.begin(), totals.seconds.end());
        const std::size_t count = totals.seconds.size();
        std::printf("%u proved to be optimal; CPU seconds: median %.2f, 95 %% within %.2f\n",
                    totals.proved, totals.seconds[count / 2], totals.seconds[count * 19 / 20]);
    }
    if (options.doubts) {
        std::printf(
            "far longer with the mirror image: %u, said of %u; with two landmarks "
            "exchanged: %u, said of %u, %u times naming another pair\n",
            totals.mirrored, totals.mirrored_said, totals.exchanged, totals.exchanged_said,
            totals.wrong_pair_said);
    }
    return totals.embedded == totals.pairs && totals.in_every_shape == totals.pairs;
}

}  // namespace layout_embedding::shapes
