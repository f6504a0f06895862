#include "patches/fairing.hh"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "base/random.hh"
#include "embedded_forms.hh"
#include "embedding/check_input.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "patches/patch_shape.hh"
#include "patches/patch_union.hh"
#include "patches/quality_report.hh"
#include "patches/straight_line.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using test::cut;
using test::fair_form;

struct Straightened {
    const test::EmbeddedInstance& instance;
    NormalForm form;
};

/// A part of the embeddings there are, straightened.
const std::vector<Straightened>& straightened_instances()
{
    static const std::vector<Straightened> all = [] {
        std::vector<Straightened> list;
        const auto& instances = test::all_embedded_instances();
        for (std::size_t i = 0; i < instances.size(); i += 8) {
            list.push_back({instances[i], test::straight_form(instances[i])});
        }
        return list;
    }();
    return all;
}

double worst_quotient(const Layout& layout, const RefinedMesh& refined)
{
    double worst = 1;
    for (const PatchShape& shape : patch_shapes(layout, refined)) {
        worst = std::min(worst, shape.quotient());
    }
    return worst;
}

TEST(Fairing, keeps_every_embedding_valid_and_makes_thin_patches_rounder)
{
    int thin = 0;
    int rounder = 0;
    for (const Straightened& s : straightened_instances()) {
        SCOPED_TRACE(s.instance.name);
        const Layout& layout = *s.instance.problem.layout;
        const double before = worst_quotient(layout, cut(s.instance, s.form));
        const NormalForm form = fair_form(s.instance, s.form);
        const RefinedMesh refined = cut(s.instance, form);
        test::expect_valid(s.instance.problem, s.instance.graph, s.instance.weak, refined);
        const double after = worst_quotient(layout, refined);
        EXPECT_GE(after, before * (1 - 1e-9));
        if (before < 0.05) {
            ++thin;
            rounder += after > 1.01 * before ? 1 : 0;
        }
    }
    EXPECT_GT(thin, 10);
    EXPECT_EQ(rounder, thin);
}

TEST(Fairing, leaves_paths_between_round_patches_as_they_are)
{
    const PolygonMesh target = zoo::icosphere(3);
    for (const PolygonMesh& layout : {zoo::cube(), zoo::octahedron(), zoo::icosahedron()}) {
        const test::EmbeddedInstance instance = test::embedded(
            "sphere", layout, target, zoo::displaced_landmarks(layout, target, 0, 1), 1);
        const NormalForm form = test::straight_form(instance);
        ASSERT_GE(worst_quotient(*instance.problem.layout, cut(instance, form)), 0.3);
        const NormalForm fair = fair_form(instance, form);
        ASSERT_EQ(fair.element_count(), form.element_count());
        for (Index id = 0; id < form.element_count(); ++id) {
            EXPECT_EQ(fair.element(id).parameter, form.element(id).parameter);
        }
    }
}

TEST(Fairing, can_be_ended_after_any_step)
{
    Random random(4);
    for (std::size_t i = 0; i < straightened_instances().size(); i += 4) {
        const Straightened& s = straightened_instances()[i];
        SCOPED_TRACE(s.instance.name);
        Fairing fairing(*s.instance.problem.layout, s.form);
        double progress = 0;
        for (std::uint64_t steps = random.below(40); steps > 0 && fairing.step(); --steps) {
            EXPECT_GE(fairing.progress(), progress);
            progress = fairing.progress();
        }
        fairing.finish();
        EXPECT_EQ(fairing.progress(), 1);
        EXPECT_FALSE(fairing.step());
        test::expect_valid(s.instance.problem, s.instance.graph, s.instance.weak,
                           cut(s.instance, fairing.take()));
    }
}

TEST(Fairing, the_size_of_the_target_does_not_matter)
{
    for (std::size_t i = 0; i < straightened_instances().size(); i += 10) {
        const Straightened& s = straightened_instances()[i];
        SCOPED_TRACE(s.instance.name);
        PolygonMesh polygons = to_polygons(*s.instance.problem.target);
        for (Vec3& p : polygons.positions) {
            p = 0x1p20 * p;
        }
        const TriangleMesh large(polygons);
        // The same strands on the larger target.
        NormalForm copy(large, s.form.strand_count());
        std::map<Index, Index> ids;
        for (Index strand = 0; strand < s.form.strand_count(); ++strand) {
            for (Index id = s.form.first(strand); id != kNone; id = s.form.element(id).next) {
                const NormalForm::Element& e = s.form.element(id);
                ids[id] =
                    e.is_crossing() ? copy.add_crossing(e.halfedge) : copy.add_vertex(e.vertex);
                copy.append_to_strand(strand, ids[id]);
            }
        }
        for (Index edge = 0; edge < large.edge_count(); ++edge) {
            for (Index id = s.form.first_on_edge(edge); id != kNone;
                 id = s.form.element(id).edge_next) {
                copy.append_to_edge(ids[id]);
                copy.set_parameter(ids[id], s.form.element(id).parameter);
            }
        }
        const NormalForm form = fair_form(s.instance, s.form);
        const NormalForm other = fair_form(s.instance, copy);
        ASSERT_EQ(other.element_count(), form.element_count());
        for (Index id = 0; id < form.element_count(); ++id) {
            EXPECT_EQ(other.element(id).parameter, form.element(id).parameter);
            EXPECT_EQ(other.element(id).halfedge, form.element(id).halfedge);
        }
    }
}

TEST(PatchUnion, is_a_disk_through_which_the_line_runs_straight)
{
    std::size_t lines = 0;
    for (std::size_t i = 0; i < straightened_instances().size(); i += 2) {
        const Straightened& s = straightened_instances()[i];
        SCOPED_TRACE(s.instance.name);
        const Layout& layout = *s.instance.problem.layout;
        const RefinedMesh refined = cut(s.instance, s.form);
        const auto patches = patches_of(layout, refined);
        ASSERT_TRUE(patches.ok());
        for (Index edge = 0; edge < layout.edge_count(); edge += 3) {
            const Index left = layout.face(2 * edge);
            const Index right = layout.face(2 * edge + 1);
            if (left == kNone || right == kNone || left == right) {
                continue;
            }
            const auto side = [&](Index face, Index halfedge) {
                const auto halfedges = layout.face_halfedges(face);
                return static_cast<Index>(std::find(halfedges.begin(), halfedges.end(), halfedge) -
                                          halfedges.begin());
            };
            const Patch disk = united((*patches)[left], side(left, 2 * edge), (*patches)[right],
                                      side(right, 2 * edge + 1));
            // Every inner edge has two triangles, every boundary edge one: Euler's count of a disk.
            std::map<std::pair<Index, Index>, int> edges;
            for (const auto& c : disk.corners) {
                for (std::size_t k = 0; k < 3; ++k) {
                    ++edges[std::minmax(c[k], c[(k + 1) % 3])];
                }
            }
            EXPECT_EQ(disk.vertices.size() + disk.corners.size(), edges.size() + 1);
            EXPECT_EQ(std::count_if(edges.begin(), edges.end(),
                                    [](const auto& e) { return e.second == 1; }),
                      disk.boundary_size());
            const std::vector<Index>& chain = refined.chains[edge];
            const Index start = disk.sides[(*patches)[left].side_count() - 1];
            EXPECT_EQ(disk.vertices[start], chain.front());
            EXPECT_EQ(disk.vertices[0], chain.back());

            const auto map =
                parametrise(disk, refined.positions,
                            inscribed_polygon(side_lengths(disk, refined.positions)), {0});
            ASSERT_TRUE(map.ok()) << map.error().message;
            const auto line = straight_line(disk, *map, start, 0);
            ASSERT_TRUE(line.has_value());
            const PlanePoint along = map->points[0] - map->points[start];
            double reached = 0;
            for (const LineCrossing& crossing : *line) {
                const PlanePoint point = (1 - crossing.share) * map->points[crossing.right] +
                                         crossing.share * map->points[crossing.left];
                const PlanePoint offset = point - map->points[start];
                EXPECT_NEAR((along.x() * offset.y() - along.y() * offset.x()) / along.norm(), 0,
                            2e-6);
                EXPECT_GE(offset.dot(along) / along.squaredNorm(), reached - 2e-6);
                reached = offset.dot(along) / along.squaredNorm();
            }
            EXPECT_LE(reached, 1 + 1e-6);
            ++lines;
        }
    }
    EXPECT_GT(lines, 50U);
}

TEST(Domain, inscribed_polygons_share_the_circle_by_length)
{
    const Domain polygon = inscribed_polygon(std::vector<double>{3, 1, 2, 0});
    ASSERT_EQ(polygon.size(), 4U);
    double total = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(polygon[i].norm(), 1, 1e-14);
        const PlanePoint& a = polygon[i];
        const PlanePoint& b = polygon[(i + 1) % 4];
        const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
        // No side has less than a tenth of the mean, here 0.15.
        const std::vector<double> lengths{3, 1, 2, 0.15};
        EXPECT_NEAR(angle, 2 * std::acos(-1.0) * lengths[i] / 6.15, 1e-13);
        total += angle;
    }
    EXPECT_NEAR(total, 2 * std::acos(-1.0), 1e-12);
}

TEST(QualityReport, knows_a_square_of_straight_paths)
{
    // A flat grid whose boundary is the layout, a square divided by its diagonal.
    const Index n = 6;
    const PolygonMesh grid = zoo::grid_disk(n, n);
    const auto vertex = [&](Index x, Index y) { return x * (n + 1) + y; };
    PolygonMesh layout;
    layout.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    layout.add_face(std::array<Index, 3>{0, 1, 2});
    layout.add_face(std::array<Index, 3>{0, 2, 3});
    const EmbeddingProblem problem = test::problem_of(
        layout, grid, {vertex(1, 1), vertex(n - 1, 1), vertex(n - 1, n - 1), vertex(1, n - 1)});
    const double size = static_cast<double>(n - 2) / n;
    RefinedMesh refined;
    refined.positions = grid.positions;
    refined.corners = grid.corners;
    const Layout& l = *problem.layout;
    for (Index e = 0; e < l.edge_count(); ++e) {
        const auto place = [&](Index v) {
            return std::pair<Index, Index>{problem.landmarks[v] / (n + 1),
                                           problem.landmarks[v] % (n + 1)};
        };
        auto [x, y] = place(l.tail(2 * e));
        const auto [to_x, to_y] = place(l.head(2 * e));
        std::vector<Index> chain{vertex(x, y)};
        while (x != to_x || y != to_y) {
            x += x < to_x ? 1 : x > to_x ? -1 : 0;
            y += y < to_y ? 1 : y > to_y ? -1 : 0;
            chain.push_back(vertex(x, y));
        }
        refined.chains.push_back(chain);
    }
    // Which face a triangle belongs to, by its centre.
    for (Index t = 0; t < grid.face_count(); ++t) {
        Vec3 centre(0, 0, 0);
        for (const Index v : grid.face(t)) {
            centre += grid.positions[v] / 3;
        }
        const double low = 1.0 / n;
        const bool inside =
            centre.x() > low && centre.x() < 1 - low && centre.y() > low && centre.y() < 1 - low;
        refined.triangle_faces.push_back(t);
        refined.triangle_patches.push_back(!inside ? kNone : centre.x() > centre.y() ? 0 : 1);
    }
    const auto report = quality_report(l, refined);
    ASSERT_TRUE(report.ok()) << report.error().message;
    for (Index e = 0; e < l.edge_count(); ++e) {
        const Vec3 along = grid.positions[problem.landmarks[l.head(2 * e)]] -
                           grid.positions[problem.landmarks[l.tail(2 * e)]];
        EXPECT_NEAR(report->edges[e].length, along.norm(), 1e-12);
        EXPECT_NEAR(report->edges[e].turning, 0, 1e-6);
    }
    const double perimeter = size * (2 + std::sqrt(2.0));
    for (const QualityReport::Patch& patch : report->patches) {
        EXPECT_NEAR(patch.area, size * size / 2, 1e-12);
        EXPECT_NEAR(patch.perimeter, perimeter, 1e-12);
        EXPECT_NEAR(patch.isoperimetric_quotient,
                    4 * std::acos(-1.0) * (size * size / 2) / (perimeter * perimeter), 1e-12);
        EXPECT_GT(patch.stretch, 1);
        EXPECT_LT(patch.stretch, 1.5);
    }
}

TEST(QualityReport,
     straight_paths_turn_less_than_half_as_much_as_jagged_ones_and_fair_ones_hardly_more)
{
    double even = 0;
    double straight = 0;
    double fair = 0;
    for (std::size_t i = 0; i < straightened_instances().size(); i += 6) {
        const auto& [instance, form] = straightened_instances()[i];
        SCOPED_TRACE(instance.name);
        const auto turning = [&instance = instance](const NormalForm& of) {
            const auto report = quality_report(*instance.problem.layout, cut(instance, of));
            EXPECT_TRUE(report.ok());
            double sum = 0;
            for (const QualityReport::Edge& edge : report->edges) {
                sum += edge.turning;
            }
            return sum;
        };
        even += turning(test::even_form(instance));
        straight += turning(form);
        fair += turning(fair_form(instance, form));
    }
    EXPECT_LT(straight, 0.5 * even);
    EXPECT_LT(fair, 1.2 * straight);
}

}  // namespace
}  // namespace layout_embedding
