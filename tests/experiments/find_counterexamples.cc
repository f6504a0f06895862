// Searches for instances whose best embedding no insertion sequence reaches (paper, Sec. 6), and
// makes them smaller as long as they are such instances:
//
//   find_counterexamples draw FIRST_SEED COUNT [FOLDER]
//   find_counterexamples shrink LAYOUT TARGET LANDMARKS [FOLDER]
//
// Draws COUNT instances, one per seed: small layouts on spheres with random landmarks. Or starts
// from one that is known. Prints a line of JSON per counterexample, with its size before and after,
// and what the best insertion sequence costs more than the optimum; after drawing one with the
// number of instances that were decided. With FOLDER, writes layout, target and landmarks there.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/random.hh"
#include "embedding/check_input.hh"
#include "json_object.hh"
#include "mesh/editable_mesh.hh"
#include "mesh/mesh_writer.hh"
#include "problem_files.hh"
#include "search/exact_solver.hh"
#include "search/sequence_solver.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

constexpr std::uint64_t kFieldBytes = std::uint64_t{1} << 30U;
/// Units of work that either method may take for an instance.
constexpr std::uint64_t kMaxWork = 3'000'000;
/// What the sequence has to cost more: less could be the perturbation's doing.
constexpr double kLeastExcess = 1e-4;

struct Candidate {
    PolygonMesh layout;
    PolygonMesh target;
    std::vector<Index> landmarks;
};

/// The optimum, nothing where it is not reached or not proved.
std::optional<Length> optimum(Solver& solver)
{
    WorkBudget budget(kMaxWork);
    for (;;) {
        switch (solver.run(budget)) {
            case Solver::Outcome::running:
            case Solver::Outcome::tied:
                return std::nullopt;
            case Solver::Outcome::finished:
                if (solver.incumbent_cost() == kInfiniteLength ||
                    solver.lower_bound() != solver.incumbent_cost()) {
                    return std::nullopt;
                }
                return solver.incumbent_cost();
            default:
                break;
        }
    }
}

/// Layouts with few edges on a round or crumpled sphere, landmarks anywhere: conflicts that go all
/// the way round come where paths are long compared to the target's edges.
Candidate drawn(std::uint64_t seed)
{
    Random random(seed);
    const PolygonMesh layouts[] = {
        zoo::prism(3), zoo::cube(), zoo::octahedron(),
        zoo::random_triangulation(5 + static_cast<int>(random.below(4)), random.bits())};
    Candidate candidate;
    candidate.layout = layouts[random.below(4)];
    candidate.target =
        random.below(2) == 0 ? zoo::icosphere(2) : zoo::crumpled_sphere(2, random.bits());
    candidate.landmarks = zoo::random_landmarks(
        candidate.target, static_cast<Index>(candidate.layout.positions.size()), random.bits());
    return candidate;
}

/// By how much the best insertion sequence costs more than the best embedding, as a share; nothing
/// where one of the two is not known, or the parts do not make a problem.
std::optional<double> excess(const Candidate& candidate)
{
    auto layout = Layout::from_polygons(candidate.layout, "the layout");
    if (!layout) {
        return std::nullopt;
    }
    const auto problem =
        make_problem(std::make_shared<const Layout>(std::move(*layout)),
                     std::make_shared<const TriangleMesh>(candidate.target), candidate.landmarks);
    if (!problem) {
        return std::nullopt;
    }
    const PathGraph graph = PathGraph::barycentric(*problem->target);
    ExactSolver exact(*problem, graph, kFieldBytes, {});
    const auto best = optimum(exact);
    if (!best) {
        return std::nullopt;
    }
    SequenceSolverOptions options;
    options.branch_and_bound.gap = 0;
    SequenceSolver sequences(*problem, graph, kFieldBytes, options);
    const auto sequence = optimum(sequences);
    if (!sequence) {
        return std::nullopt;
    }
    return static_cast<double>(*sequence - *best) / static_cast<double>(*best);
}

bool is_counterexample(const Candidate& candidate)
{
    const auto share = excess(candidate);
    return share && *share > kLeastExcess;
}

std::vector<std::vector<Index>> faces_of(const PolygonMesh& mesh)
{
    std::vector<std::vector<Index>> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        faces.emplace_back(mesh.corners.begin() + mesh.face_offsets[f],
                           mesh.corners.begin() + mesh.face_offsets[f + 1]);
    }
    return faces;
}

/// The corners from the one after `start` on, all of them.
std::vector<Index> turned(std::vector<Index> face, Index start)
{
    std::rotate(face.begin(), std::find(face.begin(), face.end(), start), face.end());
    return face;
}

/// The layout without the edge between corner k of face f and the next one, two faces made one;
/// nothing where a vertex would come twice around the new face.
std::optional<PolygonMesh> without_edge(const PolygonMesh& layout, Index f, std::size_t k)
{
    auto faces = faces_of(layout);
    const Index u = faces[f][k];
    const Index v = faces[f][(k + 1) % faces[f].size()];
    for (Index g = 0; g < faces.size(); ++g) {
        const auto face = turned(faces[g], v);
        if (g == f || face[0] != v || face[1 % face.size()] != u) {
            continue;
        }
        std::vector<Index> joined = turned(faces[f], v);  // v ... u
        const auto other = turned(faces[g], u);           // u ... v
        joined.insert(joined.end(), other.begin() + 1, other.end() - 1);
        auto sorted = joined;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
            return std::nullopt;
        }
        PolygonMesh result;
        result.positions = layout.positions;
        for (Index i = 0; i < faces.size(); ++i) {
            if (i != g) {
                result.add_face(i == f ? joined : faces[i]);
            }
        }
        return result;
    }
    return std::nullopt;
}

/// Without a layout vertex of two edges, which become one.
std::optional<Candidate> without_vertex(const Candidate& candidate, Index v)
{
    auto faces = faces_of(candidate.layout);
    if (std::count(candidate.layout.corners.begin(), candidate.layout.corners.end(), v) != 2) {
        return std::nullopt;
    }
    Candidate result = candidate;
    result.layout = {};
    result.layout.positions = candidate.layout.positions;
    result.layout.positions.erase(result.layout.positions.begin() + v);
    result.landmarks.erase(result.landmarks.begin() + v);
    for (auto& face : faces) {
        face.erase(std::remove(face.begin(), face.end(), v), face.end());
        if (face.size() < 3) {
            return std::nullopt;
        }
        for (Index& corner : face) {
            corner -= corner > v ? 1 : 0;
        }
        result.layout.add_face(face);
    }
    return result;
}

/// With target vertex v, which is no landmark, moved into its neighbour w.
std::optional<Candidate> collapsed(const Candidate& candidate, Index v, Index w)
{
    EditableMesh mesh{TriangleMesh(candidate.target)};
    if (!mesh.can_collapse(v, w)) {
        return std::nullopt;
    }
    mesh.collapse(v, w);
    Candidate result = candidate;
    result.target = {};
    result.target.positions = candidate.target.positions;
    result.target.positions.erase(result.target.positions.begin() + v);
    for (Index f = 0; f < mesh.face_capacity(); ++f) {
        if (mesh.has_face(f)) {
            std::vector<Index> face;
            for (const Index h : {3 * f, 3 * f + 1, 3 * f + 2}) {
                face.push_back(mesh.tail(h) - (mesh.tail(h) > v ? 1 : 0));
            }
            result.target.add_face(face);
        }
    }
    for (Index& landmark : result.landmarks) {
        landmark -= landmark > v ? 1 : 0;
    }
    return result;
}

/// One element less, still a counterexample; false if there is none.
bool shrink_layout(Candidate& candidate)
{
    for (Index v = 0; v < candidate.layout.positions.size(); ++v) {
        const auto smaller = without_vertex(candidate, v);
        if (smaller && is_counterexample(*smaller)) {
            candidate = *smaller;
            return true;
        }
    }
    const auto faces = faces_of(candidate.layout);
    for (Index f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < faces[f].size(); ++k) {
            auto layout = without_edge(candidate.layout, f, k);
            if (!layout) {
                continue;
            }
            Candidate smaller = candidate;
            smaller.layout = std::move(*layout);
            if (is_counterexample(smaller)) {
                candidate = std::move(smaller);
                return true;
            }
        }
    }
    return false;
}

/// All vertices once that can go one after the other; false if none can.
bool shrink_target(Candidate& candidate)
{
    bool has_shrunk = false;
    for (Index v = 0; v < candidate.target.positions.size();) {
        std::vector<Index> neighbours;
        if (std::find(candidate.landmarks.begin(), candidate.landmarks.end(), v) ==
            candidate.landmarks.end()) {
            EditableMesh{TriangleMesh(candidate.target)}.for_each_neighbour(
                v, [&](Index w) { neighbours.push_back(w); });
        }
        const auto is_gone = std::any_of(neighbours.begin(), neighbours.end(), [&](Index w) {
            auto smaller = collapsed(candidate, v, w);
            if (!smaller || !is_counterexample(*smaller)) {
                return false;
            }
            candidate = std::move(*smaller);
            return true;
        });
        has_shrunk |= is_gone;
        v += is_gone ? 0 : 1;
    }
    return has_shrunk;
}

JsonObject size_of(const Candidate& candidate)
{
    const Layout layout = Layout::from_polygons(candidate.layout, "the layout").value();
    return JsonObject()
        .put("layoutVertices", std::uint64_t{layout.vertex_count()})
        .put("layoutEdges", std::uint64_t{layout.edge_count()})
        .put("targetVertices", std::uint64_t{candidate.target.positions.size()})
        .put("excess", *excess(candidate));
}

void write(const Candidate& candidate, const std::string& path)
{
    std::ofstream(path + "_layout.obj") << write_obj(candidate.layout);
    std::ofstream(path + "_target.obj") << write_obj(candidate.target);
    std::ofstream landmarks(path + "_landmarks.txt");
    for (const Index landmark : candidate.landmarks) {
        landmarks << landmark << '\n';
    }
}

/// Makes it as small as it gets, and says so.
void shrink(Candidate candidate, const std::string& name, const char* folder)
{
    const std::string before = size_of(candidate).json();
    bool more = true;
    while (more) {
        more = shrink_layout(candidate);
        more = shrink_target(candidate) || more;
    }
    std::printf("%s\n", JsonObject()
                            .put_text("name", name)
                            .put("before", before)
                            .put("after", size_of(candidate).json())
                            .json()
                            .c_str());
    std::fflush(stdout);
    if (folder != nullptr) {
        write(candidate, std::string(folder) + "/" + name);
    }
}

int draw(std::uint64_t first_seed, std::uint64_t count, const char* folder)
{
    std::uint64_t decided = 0;
    std::uint64_t found = 0;
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
        const Candidate candidate = drawn(seed);
        const auto share = excess(candidate);
        decided += share ? 1 : 0;
        if (share && *share > kLeastExcess) {
            ++found;
            shrink(candidate, "seed" + std::to_string(seed), folder);
        }
    }
    std::printf("%s\n", JsonObject()
                            .put("instances", count)
                            .put("decided", decided)
                            .put("counterexamples", found)
                            .put("cpu", cpu_seconds())
                            .json()
                            .c_str());
    return 0;
}

int shrink_files(char** files, const char* folder)
{
    const auto problem = load_problem(files[0], files[1], files[2]);
    if (!problem) {
        std::fprintf(stderr, "%s\n", problem.error().message.c_str());
        return 2;
    }
    const Candidate candidate{to_polygons(*problem->layout), to_polygons(*problem->target),
                              problem->landmarks};
    if (!is_counterexample(candidate)) {
        std::fprintf(stderr, "this is no counterexample, or not decided\n");
        return 1;
    }
    shrink(candidate, "smallest", folder);
    return 0;
}

}  // namespace
}  // namespace layout_embedding

int main(int count, char** words)
{
    const std::string mode = count > 1 ? words[1] : "";
    if (mode == "draw" && (count == 4 || count == 5)) {
        return layout_embedding::draw(std::strtoull(words[2], nullptr, 10),
                                      std::strtoull(words[3], nullptr, 10),
                                      count == 5 ? words[4] : nullptr);
    }
    if (mode == "shrink" && (count == 5 || count == 6)) {
        return layout_embedding::shrink_files(words + 2, count == 6 ? words[5] : nullptr);
    }
    std::fprintf(stderr,
                 "usage: find_counterexamples draw FIRST_SEED COUNT [FOLDER]\n"
                 "       find_counterexamples shrink LAYOUT TARGET LANDMARKS [FOLDER]\n");
    return 2;
}
