#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hh"

namespace layout_embedding {

/// A JSON value (RFC 8259) as a tree.
class JsonValue {
public:
    enum class Kind { null, boolean, number, string, array, object };

    Kind kind = Kind::null;
    bool boolean = false;
    double number = 0;
    std::string string;
    /// Of an array.
    std::vector<JsonValue> items;
    /// Of an object, in the order of the text: names and values.
    std::vector<std::string> names;
    std::vector<JsonValue> members;

    bool is(Kind wanted) const { return kind == wanted; }
    /// The member of that name, the first of several; nullptr where there is none, or no object.
    const JsonValue* find(std::string_view name) const;
    /// Whether this is a whole number from 0 to `most`.
    bool is_whole(double most) const;
};

/// Reads a JSON text. `subject` begins the messages. Errors: syntaxError, with the line; values
/// nested more than 64 deep count as one. Linear in the bytes.
Result<JsonValue> parse_json(std::string_view text, std::string_view subject);

/// Appends `text` as a JSON string, in its quotation marks.
void append_json_string(std::string& json, std::string_view text);

}  // namespace layout_embedding
