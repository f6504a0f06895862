#pragma once

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hh"

/// What the native programs share that tests/node/native.test.ts compares the package with.
namespace layout_embedding {

inline std::string bytes_of(const char* path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Says what is wrong; the exit code.
inline int fail(const Error& error)
{
    std::fprintf(stderr, "%s\n", error.message.c_str());
    return 2;
}

}  // namespace layout_embedding
