#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

namespace layout_embedding {

/// A JSON object in the making.
class JsonObject {
public:
    JsonObject& put(const char* name, const std::string& json)
    {
        text_ += text_.empty() ? "\"" : ",\"";
        text_ += name;
        text_ += "\":";
        text_ += json;
        return *this;
    }
    /// null for infinity.
    JsonObject& put(const char* name, double number)
    {
        char digits[40];
        std::snprintf(digits, sizeof digits, "%.17g", number);
        return put(name, std::isfinite(number) ? std::string(digits) : "null");
    }
    JsonObject& put(const char* name, std::uint64_t number)
    {
        return put(name, std::to_string(number));
    }
    JsonObject& put_text(const char* name, const std::string& text)
    {
        std::string quoted = "\"";
        quoted += text;
        quoted += '"';
        return put(name, quoted);
    }
    std::string json() const { return "{" + text_ + "}"; }

private:
    std::string text_;
};

}  // namespace layout_embedding
