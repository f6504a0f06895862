// Whatever bytes come in, the PLY reader ends with a mesh or an error, and a mesh can be looked at.
#include <string_view>

#include "fuzz.hh"
#include "mesh/ply_reader.hh"
#include "mesh_properties.hh"

using namespace layout_embedding;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    MeshAttributes attributes;
    const Result<PolygonMesh> mesh = read_ply(bytes, "the file", &attributes);
    if (!mesh.ok()) {
        FUZZ_CHECK(!mesh.error().message.empty());
        return 0;
    }
    check_mesh_properties(*mesh);
    check_attribute_properties(*mesh, attributes, read_ply(bytes, "the file"));
    return 0;
}
