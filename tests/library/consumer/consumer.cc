// Embeds a tetrahedron in itself: six straight edges of length 2 sqrt(2).
#include <cmath>
#include <cstdio>
#include <layout_embedding/apps/embed_job.hh>
#include <layout_embedding/mesh/mesh_reader.hh>
#include <memory>

using namespace layout_embedding;

int main()
{
    const auto mesh =
        read_mesh("v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
                  MeshFormat::obj, "the tetrahedron");
    const auto layout = Layout::from_polygons(*mesh, "the layout");
    const auto problem = make_problem(std::make_shared<Layout>(*layout),
                                      std::make_shared<TriangleMesh>(*mesh), {0, 1, 2, 3});
    EmbedJob job(*problem, {});
    while (job.step()) {
    }
    const EmbedResult& result = job.result();
    std::printf("status %u, cost %.9f\n", static_cast<unsigned>(result.status), result.cost);
    const bool right = result.status == EmbedStatus::optimal && result.refined &&
                       result.refined->chains.size() == 6 &&
                       std::abs(result.cost - 12 * std::sqrt(2.0)) < 1e-5;
    return right ? 0 : 1;
}
