// Whatever bytes come in, the landmark reader ends with ids or an error, and ids survive writing
// and reading; read_mesh() tells formats apart without falling over.
#include <string_view>

#include "fuzz.hh"
#include "layout/landmark_reader.hh"
#include "mesh/mesh_reader.hh"

using namespace layout_embedding;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const Result<PolygonMesh> mesh = read_mesh(bytes, MeshFormat::detect, "the file");
    FUZZ_CHECK(mesh.ok() || !mesh.error().message.empty());
    const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const Result<Landmarks> landmarks = read_landmarks(bytes, "the file", positions);
    if (!landmarks.ok()) {
        FUZZ_CHECK(!landmarks.error().message.empty());
        return 0;
    }
    FUZZ_CHECK(!landmarks->vertices.empty());
    const Result<Landmarks> again =
        read_landmarks(write_landmarks(landmarks->vertices), "the copy", positions);
    FUZZ_CHECK(again.ok() && again->vertices == landmarks->vertices);
    return 0;
}
