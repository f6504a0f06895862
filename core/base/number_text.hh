#pragma once

#include <string>
#include <string_view>

namespace layout_embedding {

/// Reads the decimal number at the start of `text` and takes its characters off `text`.
/// Accepts what C's strtod accepts in decimal, and "nan", "inf" and "infinity" in any case; too
/// large numbers become infinite. Correctly rounded (to nearest, ties to even), independent of
/// locale and platform. False, with `text` and `value` untouched, if no number stands there.
/// Hardly more than a multiplication for up to 19 digits and moderate exponents, O(digits^2)
/// otherwise.
bool parse_number(std::string_view& text, double& value);

/// Appends the shortest of the 15-, 16- and 17-digit decimal forms of `value` (the one closest to
/// it of that many digits) that parse_number() reads back as exactly `value`. The same on every
/// platform. Not-a-number becomes "nan", infinities "inf" and "-inf".
void append_number(std::string& text, double value);

}  // namespace layout_embedding
