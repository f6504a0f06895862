// Whatever bytes come in, the OFF reader ends with a mesh or an error, and a mesh survives writing
// and reading.
#include <string_view>

#include "fuzz.hh"
#include "mesh/mesh_writer.hh"
#include "mesh/off_reader.hh"
#include "mesh_properties.hh"

using namespace layout_embedding;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    MeshAttributes attributes;
    const Result<PolygonMesh> mesh = read_off(bytes, "the file", &attributes);
    if (!mesh.ok()) {
        FUZZ_CHECK(!mesh.error().message.empty());
        return 0;
    }
    const Result<PolygonMesh> again = read_off(write_off(*mesh), "the copy");
    FUZZ_CHECK(again.ok() && identical(*mesh, *again));
    check_mesh_properties(*mesh);
    check_attribute_properties(*mesh, attributes, read_off(bytes, "the file"));
    return 0;
}
