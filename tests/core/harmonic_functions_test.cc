#include "surface/harmonic_functions.hh"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <map>

#include "base/random.hh"
#include "instances.hh"
#include "search/repulsive_guide.hh"

namespace layout_embedding {
namespace {

/// Closed surfaces of genus 0 and 1, and some with holes and landmarks on them.
std::vector<std::pair<std::string, EmbeddingProblem>> all_problems()
{
    std::vector<std::pair<std::string, EmbeddingProblem>> problems;
    for (auto& instance : test::random_instances(21, 12)) {
        problems.emplace_back(instance.name, instance.problem);
    }
    for (auto& instance : test::embedded_instances(21)) {
        problems.emplace_back(instance.name, instance.problem);
    }
    return problems;
}

double angle(const Vec3& u, const Vec3& v)
{
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

TEST(HarmonicFunctions, are_one_at_their_own_landmark_and_zero_at_all_others)
{
    for (const auto& [name, problem] : all_problems()) {
        const HarmonicFunctions functions(*problem.target, problem.landmarks);
        for (Index i = 0; i < problem.landmarks.size(); ++i) {
            const auto values = functions.solve(i);
            for (Index j = 0; j < problem.landmarks.size(); ++j) {
                EXPECT_EQ(values[problem.landmarks[j]], i == j ? 1 : 0) << name;
            }
        }
    }
}

TEST(HarmonicFunctions, keep_within_zero_and_one_and_sum_to_one)
{
    for (const auto& [name, problem] : all_problems()) {
        const HarmonicFunctions functions(*problem.target, problem.landmarks);
        std::vector<double> sums(problem.target->vertex_count(), 0);
        for (Index i = 0; i < problem.landmarks.size(); ++i) {
            const auto values = functions.solve(i);
            for (Index v = 0; v < values.size(); ++v) {
                EXPECT_GE(values[v], -1e-10) << name;
                EXPECT_LE(values[v], 1 + 1e-10) << name;
                sums[v] += values[v];
            }
        }
        for (const double sum : sums) {
            EXPECT_NEAR(sum, 1, 1e-9) << name;
        }
    }
}

TEST(HarmonicFunctions, are_the_mean_of_their_neighbours_in_mean_value_weights)
{
    for (const auto& [name, problem] : all_problems()) {
        const TriangleMesh& target = *problem.target;
        const HarmonicFunctions functions(target, problem.landmarks);
        // The weights once more, with angles.
        std::map<std::pair<Index, Index>, double> weights;
        for (Index f = 0; f < target.face_count(); ++f) {
            const auto corners = target.face(f);
            for (int c = 0; c < 3; ++c) {
                const Index i = corners[c];
                const Index j = corners[(c + 1) % 3];
                const Index k = corners[(c + 2) % 3];
                const Vec3 u = target.position(j) - target.position(i);
                const Vec3 v = target.position(k) - target.position(i);
                const double tangent = std::tan(angle(u, v) / 2);
                weights[{i, j}] += tangent / u.norm();
                weights[{i, k}] += tangent / v.norm();
            }
        }
        for (Index i = 0; i < problem.landmarks.size(); ++i) {
            const auto values = functions.solve(i);
            std::vector<double> sums(values.size(), 0);
            std::vector<double> totals(values.size(), 0);
            for (const auto& [pair, weight] : weights) {
                sums[pair.first] += weight * values[pair.second];
                totals[pair.first] += weight;
            }
            for (const Index landmark : problem.landmarks) {
                sums[landmark] = totals[landmark] * values[landmark];
            }
            for (Index v = 0; v < values.size(); ++v) {
                EXPECT_NEAR(sums[v] / totals[v], values[v], 1e-9) << name << ", vertex " << v;
            }
        }
    }
}

TEST(HarmonicFunctions, have_the_same_bits_in_every_build)
{
    // The number was found by GCC and Emscripten alike; it stands for all the others.
    std::uint64_t hash = 0;
    for (const auto& instance : test::random_instances(22, 6)) {
        const HarmonicFunctions functions(*instance.problem.target, instance.problem.landmarks);
        for (Index i = 0; i < instance.problem.landmarks.size(); ++i) {
            for (const double value : functions.solve(i)) {
                std::uint64_t bits;
                std::memcpy(&bits, &value, sizeof bits);
                hash = Random::mix(hash ^ bits) + 1;
            }
        }
    }
    EXPECT_EQ(hash, 8529418334080615510ULL);
}

TEST(SparseLu, solves_random_diagonally_dominant_systems)
{
    Random random(23);
    for (int round = 0; round < 20; ++round) {
        const auto n = static_cast<Index>(1 + random.below(60));
        std::vector<std::vector<double>> dense(n, std::vector<double>(n, 0));
        for (std::uint64_t k = random.below(3 * n); k > 0; --k) {
            const auto i = random.below(n);
            const auto j = random.below(n);
            if (i != j) {
                dense[i][j] = -random.unit();
                dense[j][i] = -random.unit();
            }
        }
        SparseRows matrix;
        for (Index i = 0; i < n; ++i) {
            dense[i][i] = 0.1;
            for (Index j = 0; j < n; ++j) {
                dense[i][i] += j != i ? -dense[i][j] : 0;
            }
            for (Index j = 0; j < n; ++j) {
                if (dense[i][j] != 0) {
                    matrix.columns.push_back(j);
                    matrix.values.push_back(dense[i][j]);
                }
            }
            matrix.offsets.push_back(static_cast<Index>(matrix.columns.size()));
        }
        const SparseLu factors(matrix);
        std::vector<double> solution(n);
        std::vector<double> right(n, 0);
        for (Index i = 0; i < n; ++i) {
            solution[i] = random.unit() - 0.5;
        }
        for (Index i = 0; i < n; ++i) {
            for (Index j = 0; j < n; ++j) {
                right[i] += dense[i][j] * solution[j];
            }
        }
        factors.solve(right);
        for (Index i = 0; i < n; ++i) {
            EXPECT_NEAR(right[i], solution[i], 1e-11);
        }
    }
}

TEST(RepulsiveGuide, weighs_nothing_at_its_own_landmarks_and_all_at_the_others)
{
    for (const auto& [name, problem] : all_problems()) {
        const PathGraph graph = PathGraph::barycentric(*problem.target);
        RepulsiveGuide guide(problem, graph);
        for (Index e = 0; e < problem.layout->edge_count(); ++e) {
            const Index i = problem.layout->tail(2 * e);
            const Index j = problem.layout->head(2 * e);
            const auto& weights = guide.node_weights(i, j);
            for (const NodeWeight weight : weights) {
                EXPECT_LE(weight, kFullWeight);
            }
            for (Index k = 0; k < problem.landmarks.size(); ++k) {
                const NodeWeight expected = k == i || k == j ? 0 : kFullWeight;
                EXPECT_EQ(weights[graph.node_of_vertex(problem.landmarks[k])], expected) << name;
            }
        }
    }
}

}  // namespace
}  // namespace layout_embedding
