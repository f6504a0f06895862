#include "search/face_loops.hh"

#include <gtest/gtest.h>

#include "instances.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using test::Instance;
using test::SearchGround;

struct Counts {
    int embeddings = 0;
    int loops = 0;
    int exchanged = 0;
};

/// Makes embeddings of an instance by random orders of insertion. Every face has to close, and each
/// of its walks has to be the one that completes the others. Where one walk is exchanged for that
/// of another embedding, in another class, the loop must not close, and the others' completion
/// stays.
void expect_loops_of_embeddings_to_close(const Instance& instance, Random& random, Counts& counts)
{
    SCOPED_TRACE(instance.name);
    const EmbeddingProblem& problem = instance.problem;
    const Layout& layout = *problem.layout;
    SearchGround ground(problem, 1);
    WalkPool pool(ground.strands);
    CutSystems cuts(ground.strands);
    FaceLoops loops(layout, ground.graph, pool, cuts);
    std::vector<std::vector<Index>> embeddings;
    for (int i = 0; i < 4; ++i) {
        const auto weak = test::insert_in_random_order(problem, ground.graph, random);
        if (!weak) {
            continue;
        }
        std::vector<Index> walks;
        for (Index e = 0; e < layout.edge_count(); ++e) {
            walks.push_back(pool.add(e, weak->paths[e].darts));
            loops.add(walks.back());
        }
        embeddings.push_back(walks);
        ++counts.embeddings;
    }
    for (const auto& embedding : embeddings) {
        for (Index f = 0; f < layout.face_count(); ++f) {
            if (!loops.demands(f)) {
                continue;
            }
            const auto halfedges = layout.face_halfedges(f);
            std::vector<Index> walks;
            for (const Index h : halfedges) {
                walks.push_back(embedding[Layout::edge(h)]);
            }
            EXPECT_TRUE(loops.closes(f, walks)) << "face " << f;
            ++counts.loops;
            for (std::size_t place = 0; place < walks.size(); ++place) {
                const Index own = walks[place];
                EXPECT_EQ(loops.completion(f, walks, place), loops.side(halfedges[place], own));
                EXPECT_EQ(loops.walk(loops.completion(f, walks, place)), own);
                for (const auto& other : embeddings) {
                    const Index walk = other[Layout::edge(halfedges[place])];
                    if (loops.side(halfedges[place], walk) != loops.side(halfedges[place], own)) {
                        walks[place] = walk;
                        EXPECT_FALSE(loops.closes(f, walks)) << "face " << f;
                        EXPECT_EQ(loops.walk(loops.completion(f, walks, place)), own);
                        walks[place] = own;
                        ++counts.exchanged;
                    }
                }
            }
        }
    }
}

TEST(FaceLoops, close_in_every_embedding_and_not_with_another_class)
{
    Random random(31);
    Counts counts;
    for (const Instance& instance : test::random_instances(230, 60)) {
        expect_loops_of_embeddings_to_close(instance, random, counts);
    }
    EXPECT_GT(counts.embeddings, 150);
    EXPECT_GT(counts.loops, 600);
    EXPECT_GT(counts.exchanged, 300);
}

TEST(FaceLoops, close_on_surfaces_of_higher_genus_and_with_holes)
{
    Random random(32);
    Counts handles;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const auto draw = [&](const std::string& name, const PolygonMesh& layout,
                              const PolygonMesh& target) {
            return Instance{name,
                            test::problem_of(layout, target,
                                             zoo::displaced_landmarks(layout, target, 0.2, seed))};
        };
        for (const Instance& instance :
             {draw("torus", zoo::quad_torus(3, 3), zoo::torus(9, 7)),
              draw("torus of triangles", zoo::torus(3, 3), zoo::torus(8, 8)),
              draw("two handles", zoo::slab(2, 0), zoo::slab(2, 1))}) {
            expect_loops_of_embeddings_to_close(instance, random, handles);
        }
    }
    EXPECT_GT(handles.loops, 100);
    EXPECT_GT(handles.exchanged, 50);
    Counts holes;
    for (const std::uint64_t seed : {3U, 4U, 5U, 6U, 7U, 8U}) {
        const PolygonMesh layout = zoo::quad_grid(2, 2);
        const PolygonMesh target = zoo::grid_disk(7, 6);
        expect_loops_of_embeddings_to_close(
            {"disk",
             test::problem_of(layout, target, zoo::displaced_landmarks(layout, target, 0.3, seed))},
            random, holes);
    }
    EXPECT_GT(holes.loops, 20);
}

}  // namespace
}  // namespace layout_embedding
