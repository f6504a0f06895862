#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace layout_embedding {

/// The value of type T whose bytes stand at the start of `bytes`, at least sizeof(T) of them.
/// Both kinds of machines this runs on are little-endian.
template <typename T>
T value_of_bytes(std::string_view bytes, bool big_endian = false)
{
    static_assert(std::is_arithmetic_v<T>);
    std::array<char, sizeof(T)> buffer;
    std::memcpy(buffer.data(), bytes.data(), sizeof(T));
    if (big_endian) {
        std::reverse(buffer.begin(), buffer.end());
    }
    T value;
    std::memcpy(&value, buffer.data(), sizeof(T));
    return value;
}

/// Appends the bytes of `value`, little-endian.
template <typename T>
void append_bytes(std::string& bytes, T value)
{
    static_assert(std::is_arithmetic_v<T>);
    std::array<char, sizeof(T)> buffer;
    std::memcpy(buffer.data(), &value, sizeof(T));
    bytes.append(buffer.data(), buffer.size());
}

}  // namespace layout_embedding
