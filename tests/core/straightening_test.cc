#include "embedding/straightening.hh"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "base/random.hh"
#include "embedded_forms.hh"
#include "embedding/crossing_room.hh"
#include "embedding/funnel.hh"
#include "embedding/isotonic.hh"
#include "embedding_checks.hh"
#include "geodesic_reference.hh"
#include "instances.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using Instance = test::EmbeddedInstance;
using test::all_embedded_instances;
using test::embedded;
using test::even_form;
using test::expect_valid;
using test::straight_form;

/// Neighbours on an edge, and crossings and its ends, are as far apart as they should be.
void expect_gaps(const NormalForm& form, double spacing)
{
    for (Index edge = 0; edge < form.mesh().edge_count(); ++edge) {
        const double least = gap_on_edge(form, edge, spacing) * (1 - 1e-9);
        double before = 0;
        Index count = 0;
        for (Index id = form.first_on_edge(edge); id != kNone; id = form.element(id).edge_next) {
            EXPECT_GE(form.element(id).parameter - before, least);
            before = form.element(id).parameter;
            ++count;
        }
        EXPECT_EQ(count, form.crossing_count(edge));
        if (count > 0) {
            EXPECT_GE(1 - before, least);
        }
    }
}

TEST(Isotonic, is_the_min_max_formula)
{
    Random random(1);
    IsotonicRegression regression;
    for (int round = 0; round < 200; ++round) {
        const std::size_t n = 1 + random.below(9);
        std::vector<double> values;
        std::vector<double> weights;
        for (std::size_t i = 0; i < n; ++i) {
            values.push_back(static_cast<double>(random.below(100)) / 100);
            weights.push_back(static_cast<double>(1 + random.below(9)));
        }
        std::vector<double> fitted = values;
        regression.fit(fitted, weights, 0.1, 0.8);
        for (std::size_t i = 0; i < n; ++i) {
            double highest = -1;
            for (std::size_t j = 0; j <= i; ++j) {
                double lowest = 2;
                double sum = 0;
                double weight = 0;
                for (std::size_t k = j; k < n; ++k) {
                    sum += weights[k] * values[k];
                    weight += weights[k];
                    if (k >= i) {
                        lowest = std::min(lowest, sum / weight);
                    }
                }
                highest = std::max(highest, lowest);
            }
            EXPECT_NEAR(fitted[i], std::clamp(highest, 0.1, 0.8), 1e-12);
        }
    }
}

TEST(Funnel, finds_the_shortest_way_among_all_chains_of_portal_ends)
{
    Random random(2);
    const auto uniform = [&] { return static_cast<double>(random.below(1'000'000)) / 1e6; };
    Funnel funnel;
    int bends = 0;
    for (int round = 0; round < 300; ++round) {
        const Index n = 1 + static_cast<Index>(random.below(10));
        std::vector<Portal> portals;
        double middle = 0;
        for (Index i = 0; i < n; ++i) {
            middle += 2 * uniform() - 1;
            const double x = i + 1 + 0.3 * uniform();
            portals.push_back({{x, middle + uniform()}, {x, middle - uniform()}});
        }
        const Vec2 start{0, 0};
        const Vec2 end{n + 2.0, 2 * uniform() - 1};
        // Points in the order of portals; a straight step is possible if it passes those between.
        std::vector<Bend> points{{kNone, start}};
        for (Index i = 0; i < n; ++i) {
            points.push_back({i, portals[i].left});
            points.push_back({i, portals[i].right});
        }
        points.push_back({n, end});
        std::vector<double> shortest(points.size(), std::numeric_limits<double>::infinity());
        shortest[0] = 0;
        for (std::size_t b = 1; b < points.size(); ++b) {
            for (std::size_t a = 0; a < b; ++a) {
                const Vec2 step = points[b].point - points[a].point;
                bool passes = a == 0 || points[a].portal < points[b].portal;
                for (Index i = points[a].portal + 1; i < points[b].portal; ++i) {
                    passes = passes && cross(step, portals[i].left - points[a].point) >= 0 &&
                             cross(step, portals[i].right - points[a].point) <= 0;
                }
                if (passes) {
                    shortest[b] = std::min(shortest[b], shortest[a] + std::sqrt(dot(step, step)));
                }
            }
        }
        double length = 0;
        Vec2 here = start;
        for (const Bend& bend : funnel.shortest_path(start, portals, end)) {
            length += std::sqrt(dot(bend.point - here, bend.point - here));
            here = bend.point;
            ++bends;
        }
        length += std::sqrt(dot(end - here, end - here));
        EXPECT_NEAR(length, shortest.back(), 1e-9 * shortest.back());
    }
    EXPECT_GT(bends, 300);
}

TEST(Straightening, keeps_every_embedding_valid_and_makes_none_longer)
{
    double shares = 0;
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const double before = even_form(instance).total_length();
        const NormalForm form = straight_form(instance);
        EXPECT_LE(form.total_length(), before);
        expect_gaps(form, StraighteningOptions{}.spacing);
        expect_valid(instance, form);
        shares += form.total_length() / before;
    }
    EXPECT_LT(shares / static_cast<double>(all_embedded_instances().size()), 0.9);
}

TEST(Straightening, strands_pass_free_vertices_one_at_a_time)
{
    int passed = 0;
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const NormalForm form = straight_form(instance);
        std::vector<int> passes(form.mesh().vertex_count(), 0);
        for (const Index landmark : instance.problem.landmarks) {
            passes[landmark] = 1;
        }
        for (Index id = 0; id < form.element_count(); ++id) {
            const NormalForm::Element& e = form.element(id);
            if (!e.is_crossing() && e.previous != kNone && e.next != kNone) {
                EXPECT_FALSE(form.mesh().is_boundary_vertex(e.vertex));
                EXPECT_EQ(passes[e.vertex]++, 0);
                ++passed;
            }
        }
    }
    EXPECT_GT(passed, 500);
}

TEST(Straightening, reaches_the_locally_shortest_length_of_each_class)
{
    // On a surface with cones a class can have several locally shortest paths, hence the wider
    // limit for single instances.
    double sum = 0;
    int compared = 0;
    for (std::size_t i = 0; i < all_embedded_instances().size(); i += 3) {
        const Instance& instance = all_embedded_instances()[i];
        SCOPED_TRACE(instance.name);
        const NormalForm form = straight_form(instance, {.spacing = 1e-3, .open_angles = false});
        double shortest = 0;
        bool known = true;
        for (Index e = 0; known && e < form.strand_count(); ++e) {
            const auto length = test::geodesic_length(instance.problem, instance.graph,
                                                      instance.weak.paths[e].darts);
            known = length.has_value();
            shortest += length.value_or(0);
        }
        if (known) {
            ++compared;
            EXPECT_NEAR(form.total_length() / shortest, 1, 0.03);
            sum += form.total_length() / shortest;
        }
    }
    EXPECT_GT(compared, 60);
    EXPECT_NEAR(sum / compared, 1, 0.005);
}

TEST(Straightening, makes_straight_lines_in_the_plane)
{
    // Four points around a fifth. The shortest of some insertions has no edge in another one's way.
    const Index n = 12;
    const auto vertex = [&](Index x, Index y) { return x * (n + 1) + y; };
    std::vector<Instance> tries;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        tries.push_back(embedded(
            "wheel", zoo::wheel(4), zoo::grid_disk(n, n),
            {vertex(6, 6), vertex(2, 3), vertex(9, 2), vertex(10, 9), vertex(3, 11)}, seed));
    }
    const Instance& instance =
        *std::min_element(tries.begin(), tries.end(), [](const Instance& a, const Instance& b) {
            return test::total_length(a.graph, a.weak) * a.graph.unit() <
                   test::total_length(b.graph, b.weak) * b.graph.unit();
        });
    const NormalForm form = straight_form(instance, {.spacing = 1e-3, .open_angles = false});
    expect_valid(instance, form);
    const Layout& layout = *instance.problem.layout;
    for (Index e = 0; e < layout.edge_count(); ++e) {
        const Vec3 a = form.mesh().position(instance.problem.landmarks[layout.tail(2 * e)]);
        const Vec3 b = form.mesh().position(instance.problem.landmarks[layout.head(2 * e)]);
        EXPECT_NEAR(form.length(e) / (a - b).norm(), 1, 1e-4);
    }
}

TEST(Straightening, can_be_ended_after_any_step)
{
    Random random(4);
    for (std::size_t i = 0; i < all_embedded_instances().size(); i += 4) {
        const Instance& instance = all_embedded_instances()[i];
        SCOPED_TRACE(instance.name);
        Straightening straightening(even_form(instance), instance.problem.landmarks);
        double progress = 0;
        for (std::uint64_t steps = random.below(100); steps > 0 && straightening.step(); --steps) {
            EXPECT_GE(straightening.progress(), progress);
            progress = straightening.progress();
        }
        straightening.finish();
        EXPECT_EQ(straightening.progress(), 1);
        EXPECT_FALSE(straightening.step());
        const NormalForm form = straightening.take();
        EXPECT_LE(form.total_length(), even_form(instance).total_length());
        expect_gaps(form, StraighteningOptions{}.spacing);
        expect_valid(instance, form);
    }
}

TEST(Straightening, the_size_of_the_target_does_not_matter)
{
    for (std::size_t i = 0; i < all_embedded_instances().size(); i += 8) {
        const Instance& instance = all_embedded_instances()[i];
        SCOPED_TRACE(instance.name);
        const NormalForm form = straight_form(instance);
        for (const double scale : {0x1p-30, 0x1p40}) {
            const NormalForm other = straight_form(test::scaled(instance, scale));
            ASSERT_EQ(other.element_count(), form.element_count());
            for (Index id = 0; id < form.element_count(); ++id) {
                EXPECT_EQ(other.element(id).parameter, form.element(id).parameter);
                EXPECT_EQ(other.element(id).vertex, form.element(id).vertex);
                EXPECT_EQ(other.element(id).halfedge, form.element(id).halfedge);
            }
        }
    }
}

TEST(Straightening, forty_strands_through_a_neck_of_three_vertices)
{
    for (const bool upside_down : {false, true}) {
        const Instance instance = test::forty_strands_around_a_neck(1, upside_down);
        for (const double spacing : {1e-3, 0.25, 0.5}) {
            const NormalForm form = straight_form(instance, {.spacing = spacing});
            EXPECT_LE(form.total_length(), even_form(instance).total_length());
            expect_gaps(form, spacing);
            expect_valid(instance, form);
        }
    }
}

}  // namespace
}  // namespace layout_embedding
