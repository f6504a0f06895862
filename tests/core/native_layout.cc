// One template layout, natively, for comparison with the package (tests/node/native.test.ts):
//
//   native_layout TARGET LANDMARKS triangles|quads
//
// Prints the layout as OBJ, byte for byte what the package has to make of the same input.

#include <cstdio>
#include <string>

#include "apps/template_layout.hh"
#include "layout/landmark_reader.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/mesh_writer.hh"
#include "mesh/validation.hh"
#include "native_tool.hh"

namespace layout_embedding {
namespace {

int run(char** arguments)
{
    const auto mesh = read_mesh(bytes_of(arguments[1]), MeshFormat::detect, "the target");
    if (!mesh) {
        return fail(mesh.error());
    }
    if (const Status valid = check_surface(*mesh, SurfaceKind::target, "the target"); !valid) {
        return fail(valid.error());
    }
    const auto landmarks = read_landmarks(bytes_of(arguments[2]), "the landmark file");
    if (!landmarks) {
        return fail(landmarks.error());
    }
    const auto layout = template_layout(TriangleMesh(*mesh), landmarks->vertices,
                                        {.quads = std::string(arguments[3]) == "quads"});
    if (!layout) {
        return fail(layout.error());
    }
    std::fputs(write_obj(layout->mesh).c_str(), stdout);
    return 0;
}

}  // namespace
}  // namespace layout_embedding

int main(int count, char** arguments)
{
    if (count != 4) {
        std::fprintf(stderr, "usage: native_layout TARGET LANDMARKS triangles|quads\n");
        return 2;
    }
    return layout_embedding::run(arguments);
}
