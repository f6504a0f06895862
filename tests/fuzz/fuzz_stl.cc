// Whatever bytes come in, the STL reader ends with a mesh or an error, and a mesh can be looked at.
#include <string_view>

#include "fuzz.hh"
#include "mesh/stl_reader.hh"
#include "mesh_properties.hh"

using namespace layout_embedding;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const Result<PolygonMesh> mesh = read_stl(bytes, "the file");
    if (!mesh.ok()) {
        FUZZ_CHECK(!mesh.error().message.empty());
        return 0;
    }
    check_mesh_properties(*mesh);
    return 0;
}
