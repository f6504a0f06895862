#include "base/json.hh"

#include <algorithm>
#include <cmath>

#include "base/number_text.hh"

namespace layout_embedding {
namespace {

constexpr int kMaxDepth = 64;

void append_utf8(std::string& text, unsigned code)
{
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0U | (code >> 6U));
        text += static_cast<char>(0x80U | (code & 0x3FU));
    } else if (code < 0x10000) {
        text += static_cast<char>(0xE0U | (code >> 12U));
        text += static_cast<char>(0x80U | ((code >> 6U) & 0x3FU));
        text += static_cast<char>(0x80U | (code & 0x3FU));
    } else {
        text += static_cast<char>(0xF0U | (code >> 18U));
        text += static_cast<char>(0x80U | ((code >> 12U) & 0x3FU));
        text += static_cast<char>(0x80U | ((code >> 6U) & 0x3FU));
        text += static_cast<char>(0x80U | (code & 0x3FU));
    }
}

class JsonParser {
public:
    JsonParser(std::string_view text, std::string_view subject)
        : text_(text), rest_(text), subject_(subject)
    {}

    Result<JsonValue> parse()
    {
        JsonValue value;
        if (!parse_value(value, 0) || !at_end()) {
            const std::string_view read = text_.substr(0, text_.size() - rest_.size());
            const auto line = 1 + std::count(read.begin(), read.end(), '\n');
            return make_error(
                ErrorCode::syntaxError,
                subject_ + " has something that is no JSON in line " + std::to_string(line),
                {{"line", line}});
        }
        return value;
    }

private:
    void skip_blanks()
    {
        const std::size_t blanks = rest_.find_first_not_of(" \t\r\n");
        rest_.remove_prefix(std::min(blanks, rest_.size()));
    }

    bool at_end()
    {
        skip_blanks();
        return rest_.empty();
    }

    bool take(std::string_view word)
    {
        if (rest_.substr(0, word.size()) != word) {
            return false;
        }
        rest_.remove_prefix(word.size());
        return true;
    }

    bool parse_value(JsonValue& value, int depth)
    {
        skip_blanks();
        if (depth > kMaxDepth || rest_.empty()) {
            return false;
        }
        switch (rest_.front()) {
            case '{':
                return parse_object(value, depth);
            case '[':
                return parse_array(value, depth);
            case '"':
                value.kind = JsonValue::Kind::string;
                return parse_string(value.string);
            case 't':
                value.kind = JsonValue::Kind::boolean;
                value.boolean = true;
                return take("true");
            case 'f':
                value.kind = JsonValue::Kind::boolean;
                return take("false");
            case 'n':
                return take("null");
            default:
                value.kind = JsonValue::Kind::number;
                return starts_number() && parse_number(rest_, value.number);
        }
    }

    /// Not-a-number and infinities are no JSON.
    bool starts_number() const
    {
        const std::size_t sign = rest_.front() == '-' ? 1 : 0;
        return sign < rest_.size() && rest_[sign] >= '0' && rest_[sign] <= '9';
    }

    bool parse_object(JsonValue& value, int depth)
    {
        value.kind = JsonValue::Kind::object;
        take("{");
        skip_blanks();
        if (take("}")) {
            return true;
        }
        do {
            skip_blanks();
            if (rest_.empty() || rest_.front() != '"' ||
                !parse_string(value.names.emplace_back())) {
                return false;
            }
            skip_blanks();
            if (!take(":") || !parse_value(value.members.emplace_back(), depth + 1)) {
                return false;
            }
            skip_blanks();
        } while (take(","));
        return take("}");
    }

    bool parse_array(JsonValue& value, int depth)
    {
        value.kind = JsonValue::Kind::array;
        take("[");
        skip_blanks();
        if (take("]")) {
            return true;
        }
        do {
            if (!parse_value(value.items.emplace_back(), depth + 1)) {
                return false;
            }
            skip_blanks();
        } while (take(","));
        return take("]");
    }

    bool parse_string(std::string& text)
    {
        take("\"");
        while (!rest_.empty()) {
            const char c = rest_.front();
            rest_.remove_prefix(1);
            if (c == '"') {
                return true;
            }
            if (static_cast<unsigned char>(c) < 0x20) {
                return false;
            }
            if (c != '\\') {
                text += c;
            } else if (!parse_escape(text)) {
                return false;
            }
        }
        return false;
    }

    bool parse_escape(std::string& text)
    {
        if (rest_.empty()) {
            return false;
        }
        const char c = rest_.front();
        rest_.remove_prefix(1);
        constexpr std::string_view kNames = "\"\\/bfnrt";
        constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
        if (const std::size_t place = kNames.find(c); place != std::string_view::npos) {
            text += kMeanings[place];
            return true;
        }
        unsigned code = 0;
        if (c != 'u' || !parse_hex(code)) {
            return false;
        }
        unsigned low = 0;
        if (code >= 0xD800 && code < 0xDC00 && take("\\u")) {
            if (!parse_hex(low) || low < 0xDC00 || low >= 0xE000) {
                return false;
            }
            code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
        }
        append_utf8(text, code);
        return true;
    }

    bool parse_hex(unsigned& code)
    {
        for (int i = 0; i < 4; ++i) {
            const char c = rest_.empty() ? ' ' : rest_.front();
            constexpr std::string_view kDigits = "0123456789abcdef0123456789ABCDEF";
            const std::size_t place = kDigits.find(c);
            if (place == std::string_view::npos) {
                return false;
            }
            code = 16 * code + static_cast<unsigned>(place % 16);
            rest_.remove_prefix(1);
        }
        return true;
    }

    std::string_view text_;
    std::string_view rest_;
    std::string subject_;
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const
{
    const auto place = std::find(names.begin(), names.end(), name);
    return place == names.end() ? nullptr
                                : &members[static_cast<std::size_t>(place - names.begin())];
}

bool JsonValue::is_whole(double most) const
{
    return kind == Kind::number && number >= 0 && number <= most && number == std::floor(number);
}

Result<JsonValue> parse_json(std::string_view text, std::string_view subject)
{
    return JsonParser(text, subject).parse();
}

void append_json_string(std::string& json, std::string_view text)
{
    json += '"';
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            json += '\\';
            json += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            constexpr std::string_view kDigits = "0123456789abcdef";
            json += "\\u00";
            json += kDigits[static_cast<unsigned char>(c) / 16];
            json += kDigits[static_cast<unsigned char>(c) % 16];
        } else {
            json += c;
        }
    }
    json += '"';
}

}  // namespace layout_embedding
