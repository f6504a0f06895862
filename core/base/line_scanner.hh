#pragma once

#include <cstdint>
#include <string_view>

#include "base/number_text.hh"

namespace layout_embedding {

/// Goes through a text line by line; lines end with LF, CRLF or CR.
class LineScanner {
public:
    explicit LineScanner(std::string_view text) : rest_(text) {}

    /// Moves to the next line; false at the end of the text.
    bool next()
    {
        if (rest_.empty()) {
            return false;
        }
        ++number_;
        std::size_t length = 0;
        while (length < rest_.size() && rest_[length] != '\n' && rest_[length] != '\r') {
            ++length;
        }
        line_ = rest_.substr(0, length);
        rest_.remove_prefix(length);
        if (rest_.size() >= 2 && rest_[0] == '\r' && rest_[1] == '\n') {
            rest_.remove_prefix(2);
        } else if (!rest_.empty()) {
            rest_.remove_prefix(1);
        }
        return true;
    }

    /// The line without its end.
    std::string_view line() const { return line_; }
    /// Its number, counting from 1.
    std::int64_t number() const { return number_; }

private:
    std::string_view rest_;
    std::string_view line_;
    std::int64_t number_ = 0;
};

inline bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

/// `line` without blanks at its start.
inline std::string_view without_leading_blanks(std::string_view line)
{
    std::size_t blanks = 0;
    while (blanks < line.size() && is_blank(line[blanks])) {
        ++blanks;
    }
    return line.substr(blanks);
}

/// `line` up to a word that starts with `#`, without blanks at its start and end. A `#` inside a
/// word starts no comment: "1.#INF" must not be read as 1.
inline std::string_view without_comment(std::string_view line)
{
    line = without_leading_blanks(line);
    std::size_t hash = line.find('#');
    while (hash != std::string_view::npos && hash > 0 && !is_blank(line[hash - 1])) {
        hash = line.find('#', hash + 1);
    }
    line = line.substr(0, hash);
    while (!line.empty() && is_blank(line.back())) {
        line.remove_suffix(1);
    }
    return line;
}

/// Takes the next word, up to a blank, off `line`; empty at the end of the line.
inline std::string_view take_token(std::string_view& line)
{
    line = without_leading_blanks(line);
    std::size_t length = 0;
    while (length < line.size() && !is_blank(line[length])) {
        ++length;
    }
    const std::string_view token = line.substr(0, length);
    line.remove_prefix(length);
    return token;
}

/// Takes the next word off `line` if all of it is a number.
inline bool take_number(std::string_view& line, double& value)
{
    std::string_view rest = without_leading_blanks(line);
    if (!parse_number(rest, value) || (!rest.empty() && !is_blank(rest.front()))) {
        return false;
    }
    line = rest;
    return true;
}

/// Takes the next word off `line` if all of it is an integer of at most 18 digits.
inline bool take_integer(std::string_view& line, std::int64_t& value)
{
    std::string_view rest = line;
    std::string_view token = take_token(rest);
    const bool negative = !token.empty() && token.front() == '-';
    if (!token.empty() && (token.front() == '-' || token.front() == '+')) {
        token.remove_prefix(1);
    }
    if (token.empty() || token.size() > 18) {
        return false;
    }
    std::int64_t magnitude = 0;
    for (const char c : token) {
        if (c < '0' || c > '9') {
            return false;
        }
        magnitude = magnitude * 10 + (c - '0');
    }
    value = negative ? -magnitude : magnitude;
    line = rest;
    return true;
}

}  // namespace layout_embedding
