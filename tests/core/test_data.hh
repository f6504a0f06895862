#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

/// Test data that is not part of the repository: the folder named by the environment variable
/// LAYOUT_EMBEDDING_DATA, by default the one beside the project (set by CMake). It has the folders
/// `data` (real meshes) and `instances` (synthetic ones).
namespace layout_embedding {

inline std::filesystem::path test_data_folder()
{
    const char* folder = std::getenv("LAYOUT_EMBEDDING_DATA");
    return folder != nullptr ? folder : LAYOUT_EMBEDDING_DEFAULT_DATA;
}

/// The path of, for example, "data/spot.obj".
inline std::filesystem::path test_data_path(const std::string& file)
{
    return test_data_folder() / file;
}

/// The bytes of a file.
inline std::string read_bytes(const std::filesystem::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace layout_embedding

/// Skips the test, with a message, where the file or folder is missing.
#define LAYOUT_EMBEDDING_NEED_DATA(file)                                                        \
    if (!std::filesystem::exists(layout_embedding::test_data_path(file))) {                     \
        GTEST_SKIP() << "missing test data " << layout_embedding::test_data_path(file).string() \
                     << "; set LAYOUT_EMBEDDING_DATA to the folder that has it";                \
    }                                                                                           \
    static_assert(true)
