// Whatever bytes come in, the readers of the reference implementation's files end with a value or
// an error, and a value survives writing and reading.
#include <string_view>

#include "formats/reference_files.hh"
#include "fuzz.hh"

using namespace layout_embedding;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (const auto input = read_reference_input(bytes, "the file"); input.ok()) {
        const auto again = read_reference_input(write_reference_input(*input), "the copy");
        FUZZ_CHECK(again.ok() && again->matches == input->matches);
    } else {
        FUZZ_CHECK(!input.error().message.empty());
    }
    if (const auto embedding = read_reference_embedding(bytes, "the file"); embedding.ok()) {
        const auto again =
            read_reference_embedding(write_reference_embedding(*embedding), "the copy");
        FUZZ_CHECK(again.ok() && again->edges.size() == 2 * embedding->edges.size());
    } else {
        FUZZ_CHECK(!embedding.error().message.empty());
    }
    return 0;
}
