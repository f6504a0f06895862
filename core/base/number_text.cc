#include "base/number_text.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

// Both directions do exact integer arithmetic: in 128 bits where the power of ten is at most 27
// (5^27 fits 63 bits), which covers nearly every coordinate; beyond, reading uses big integers and
// writing the C library, which is exact for a given number of digits everywhere we run.

namespace layout_embedding {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr int kMaxFive = 27;
constexpr int kMantissaBits = 53;

constexpr auto kFives = [] {
    std::array<std::uint64_t, kMaxFive + 1> fives{};
    fives[0] = 1;
    for (std::size_t i = 1; i < fives.size(); ++i) {
        fives[i] = fives[i - 1] * 5;
    }
    return fives;
}();

constexpr std::array<double, 23> kTens = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

int bit_width(std::uint64_t x)
{
    return x == 0 ? 0 : 64 - __builtin_clzll(x);
}

int bit_width(Wide x)
{
    const auto high = static_cast<std::uint64_t>(x >> 64);
    return high != 0 ? 64 + bit_width(high) : bit_width(static_cast<std::uint64_t>(x));
}

/// The double nearest to (bits + fraction) * 2^exponent, where bits has its top bit set and the
/// fraction in [0, 1) is zero iff not `sticky`.
double round_to_double(std::uint64_t bits, int exponent, bool sticky)
{
    // Bits to drop: 11, more below the smallest normal number 2^-1022.
    int drop = 64 - kMantissaBits;
    drop = std::max(drop, -1074 - exponent);
    if (drop > 64) {
        return 0;
    }
    std::uint64_t mantissa = drop == 64 ? 0 : bits >> drop;
    const std::uint64_t half = std::uint64_t{1} << (drop - 1);
    const std::uint64_t rest = drop == 64 ? bits : bits & ((half << 1) - 1);
    if (rest > half || (rest == half && (sticky || (mantissa & 1) != 0))) {
        ++mantissa;
    }
    return std::ldexp(static_cast<double>(mantissa), exponent + drop);
}

/// value * 2^exponent for a value of up to 128 bits, plus something smaller than the last bit
/// if `sticky`.
double round_wide(Wide value, int exponent, bool sticky)
{
    const int excess = bit_width(value) - 64;
    if (excess <= 0) {
        return round_to_double(static_cast<std::uint64_t>(value) << -excess, exponent + excess,
                               sticky);
    }
    const Wide rest = value & ((Wide{1} << excess) - 1);
    return round_to_double(static_cast<std::uint64_t>(value >> excess), exponent + excess,
                           sticky || rest != 0);
}

/// digits * 10^power, digits > 0, |power| <= 27.
double scale_short(std::uint64_t digits, int power)
{
    if (digits <= (std::uint64_t{1} << kMantissaBits) && power >= -22 && power <= 22) {
        const auto exact = static_cast<double>(digits);
        return power < 0 ? exact / kTens[static_cast<std::size_t>(-power)]
                         : exact * kTens[static_cast<std::size_t>(power)];
    }
    if (power >= 0) {
        return round_wide(Wide{digits} * kFives[static_cast<std::size_t>(power)], power, false);
    }
    // Shifted so far that the quotient has at least 64 bits.
    const std::uint64_t five = kFives[static_cast<std::size_t>(-power)];
    const int shift = 128 - bit_width(digits);
    const Wide numerator = Wide{digits} << shift;
    return round_wide(numerator / five, power - shift, numerator % five != 0);
}

/// A non-negative integer of any size.
class BigInteger {
public:
    void multiply_add(std::uint32_t factor, std::uint32_t summand)
    {
        std::uint64_t carry = summand;
        for (std::uint32_t& word : words_) {
            carry += std::uint64_t{word} * factor;
            word = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        if (carry != 0) {
            words_.push_back(static_cast<std::uint32_t>(carry));
        }
    }

    void shift_left(int bits)
    {
        words_.insert(words_.begin(), static_cast<std::size_t>(bits / 32), 0);
        if (bits % 32 != 0) {
            multiply_add(std::uint32_t{1} << (bits % 32), 0);
        }
    }

    int width() const
    {
        return words_.empty() ? 0
                              : static_cast<int>(words_.size() - 1) * 32 +
                                    bit_width(std::uint64_t{words_.back()});
    }
    bool is_zero() const { return words_.empty(); }

    bool operator<(const BigInteger& other) const
    {
        if (words_.size() != other.words_.size()) {
            return words_.size() < other.words_.size();
        }
        return std::lexicographical_compare(words_.rbegin(), words_.rend(), other.words_.rbegin(),
                                            other.words_.rend());
    }

    /// Only for other <= *this.
    void subtract(const BigInteger& other)
    {
        std::int64_t borrow = 0;
        for (std::size_t i = 0; i < words_.size(); ++i) {
            borrow += words_[i];
            borrow -= i < other.words_.size() ? other.words_[i] : 0;
            words_[i] = static_cast<std::uint32_t>(borrow);
            borrow >>= 32;
        }
        while (!words_.empty() && words_.back() == 0) {
            words_.pop_back();
        }
    }

private:
    std::vector<std::uint32_t> words_;  // least significant first, no leading zero
};

/// digits * 10^power for decimal digits without a leading zero.
double scale_long(std::string_view digits, int power)
{
    const int magnitude = static_cast<int>(digits.size()) + power;
    if (magnitude > 310) {
        return std::numeric_limits<double>::infinity();
    }
    if (magnitude < -330) {
        return 0;
    }
    BigInteger numerator;
    for (const char digit : digits) {
        numerator.multiply_add(10, static_cast<std::uint32_t>(digit - '0'));
    }
    BigInteger denominator;
    denominator.multiply_add(1, 1);
    BigInteger& scaled = power < 0 ? denominator : numerator;
    for (int i = 0; i < std::abs(power); ++i) {
        scaled.multiply_add(10, 0);
    }
    // Bring the quotient into [1, 2), then divide bit by bit.
    int exponent = numerator.width() - denominator.width();
    (exponent < 0 ? numerator : denominator).shift_left(std::abs(exponent));
    if (numerator < denominator) {
        numerator.shift_left(1);
        --exponent;
    }
    std::uint64_t bits = 0;
    for (int i = 0; i < 64; ++i) {
        bits <<= 1;
        if (!(numerator < denominator)) {
            numerator.subtract(denominator);
            bits |= 1;
        }
        numerator.shift_left(1);
    }
    return round_to_double(bits, exponent - 63, !numerator.is_zero());
}

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// Takes `word` (lower case) off the front of `text`, in any case.
bool take_word(std::string_view& text, std::string_view word)
{
    if (text.size() < word.size()) {
        return false;
    }
    for (std::size_t i = 0; i < word.size(); ++i) {
        const char c = text[i];
        if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != word[i]) {
            return false;
        }
    }
    text.remove_prefix(word.size());
    return true;
}

/// The decimal digits and the power of ten of a number without sign.
struct Decimal {
    std::uint64_t value = 0;      // of the first 19 significant digits
    int digit_count = 0;          // significant digits
    std::int64_t power = 0;       // of the last significant digit
    const char* first = nullptr;  // the first significant digit
    const char* last = nullptr;   // behind the last one
};

/// Takes a decimal number without sign off `text`; false if there is none.
bool scan_decimal(std::string_view& text, Decimal& decimal)
{
    const char* p = text.data();
    const char* const end = p + text.size();
    bool any = false;
    bool point = false;
    for (; p != end; ++p) {
        if (*p == '.' && !point) {
            point = true;
            continue;
        }
        if (!is_digit(*p)) {
            break;
        }
        any = true;
        decimal.power -= point ? 1 : 0;
        if (decimal.digit_count == 0) {
            if (*p == '0') {
                continue;
            }
            decimal.first = p;
        }
        if (decimal.digit_count < 19) {
            decimal.value = decimal.value * 10 + static_cast<std::uint64_t>(*p - '0');
        }
        ++decimal.digit_count;
        decimal.last = p + 1;
    }
    if (!any) {
        return false;
    }
    if (p != end && (*p == 'e' || *p == 'E')) {
        const char* q = p + 1;
        const bool negative = q != end && *q == '-';
        if (q != end && (*q == '-' || *q == '+')) {
            ++q;
        }
        if (q != end && is_digit(*q)) {
            std::int64_t exponent = 0;
            for (; q != end && is_digit(*q); ++q) {
                exponent = std::min<std::int64_t>(exponent * 10 + (*q - '0'), 1'000'000'000'000);
            }
            decimal.power += negative ? -exponent : exponent;
            p = q;
        }
    }
    text.remove_prefix(static_cast<std::size_t>(p - text.data()));
    return true;
}

double decimal_value(const Decimal& decimal)
{
    if (decimal.digit_count == 0) {
        return 0;
    }
    if (decimal.digit_count <= 19 && decimal.power >= -kMaxFive && decimal.power <= kMaxFive) {
        return scale_short(decimal.value, static_cast<int>(decimal.power));
    }
    // 767 digits decide every rounding; a further non-zero one stands for all that follow.
    constexpr int kMaxDigits = 800;
    std::string digits;
    std::int64_t power = decimal.power;
    bool more = false;
    for (const char* p = decimal.first; p != decimal.last; ++p) {
        if (*p == '.') {
            continue;
        }
        if (static_cast<int>(digits.size()) < kMaxDigits) {
            digits += *p;
        } else {
            ++power;
            more = more || *p != '0';
        }
    }
    if (more) {
        digits += '1';
        --power;
    }
    power = std::clamp<std::int64_t>(power, -10'000, 10'000);
    return scale_long(digits, static_cast<int>(power));
}

/// value as digits * 10^-places rounded to an integer (ties to even); false where 128 bits are too
/// few.
bool scaled_digits(double value, int places, std::uint64_t& digits)
{
    if (places < -kMaxFive || places > kMaxFive) {
        return false;
    }
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    const auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, kMantissaBits));
    exponent -= kMantissaBits;
    // mantissa * 2^exponent * 10^places = product / divisor * 2^shift
    Wide product = mantissa;
    Wide divisor = 1;
    (places < 0 ? divisor : product) *= kFives[static_cast<std::size_t>(std::abs(places))];
    const int shift = exponent + places;
    Wide& shifted = shift < 0 ? divisor : product;
    if (bit_width(shifted) + std::abs(shift) > 126) {
        return false;
    }
    shifted <<= std::abs(shift);
    Wide quotient = 0;
    Wide rest = 0;
    if (places >= 0 && shift < 0) {
        quotient = product >> -shift;
        rest = product & (divisor - 1);
    } else {
        quotient = product / divisor;
        rest = product % divisor;
    }
    if (2 * rest > divisor || (2 * rest == divisor && (quotient & 1) != 0)) {
        ++quotient;
    }
    digits = static_cast<std::uint64_t>(quotient);
    return true;
}

/// Writes digits * 10^power, digits > 0: plainly where that is short, else with an exponent.
void append_digits(std::string& text, std::uint64_t digits, int power)
{
    while (digits % 10 == 0) {
        digits /= 10;
        ++power;
    }
    std::array<char, 20> buffer;
    char* first = buffer.data() + buffer.size();
    char* const last = first;
    for (; digits != 0; digits /= 10) {
        *--first = static_cast<char>('0' + digits % 10);
    }
    const int count = static_cast<int>(last - first);
    const int leading = count + power - 1;  // power of the first digit
    if (leading < -5 || leading > 16) {
        text += *first;
        if (count > 1) {
            text += '.';
            text.append(first + 1, last);
        }
        text += 'e';
        text += std::to_string(leading);
    } else if (power >= 0) {
        text.append(first, last);
        text.append(static_cast<std::size_t>(power), '0');
    } else if (leading >= 0) {
        text.append(first, first + leading + 1);
        text += '.';
        text.append(first + leading + 1, last);
    } else {
        text += "0.";
        text.append(static_cast<std::size_t>(-leading - 1), '0');
        text.append(first, last);
    }
}

}  // namespace

bool parse_number(std::string_view& text, double& value)
{
    std::string_view rest = text;
    const bool negative = !rest.empty() && rest.front() == '-';
    if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) {
        rest.remove_prefix(1);
    }
    double magnitude = 0;
    Decimal decimal;
    if (scan_decimal(rest, decimal)) {
        magnitude = decimal_value(decimal);
    } else if (take_word(rest, "infinity") || take_word(rest, "inf")) {
        magnitude = std::numeric_limits<double>::infinity();
    } else if (take_word(rest, "nan")) {
        magnitude = std::numeric_limits<double>::quiet_NaN();
    } else {
        return false;
    }
    text = rest;
    value = negative ? -magnitude : magnitude;
    return true;
}

void append_number(std::string& text, double value)
{
    if (std::isnan(value)) {
        text += "nan";
        return;
    }
    if (std::signbit(value)) {
        text += '-';
        value = -value;
    }
    if (std::isinf(value)) {
        text += "inf";
        return;
    }
    if (value == 0) {
        text += '0';
        return;
    }
    // The power of the leading digit, at most one too large.
    int exponent = 0;
    std::frexp(value, &exponent);
    const int leading = static_cast<int>(std::floor(exponent * 0.30102999566398120));  // log10(2)
    for (int count = 15; count <= 17; ++count) {
        std::uint64_t digits = 0;
        int places = count - 1 - leading;
        bool exact = scaled_digits(value, places, digits);
        constexpr std::array<std::uint64_t, 3> kSmallest = {
            100'000'000'000'000ULL, 1'000'000'000'000'000ULL, 10'000'000'000'000'000ULL};
        if (exact && digits < kSmallest[static_cast<std::size_t>(count - 15)]) {
            ++places;
            exact = scaled_digits(value, places, digits);
        }
        if (exact && places >= -kMaxFive && places <= kMaxFive) {
            if (count == 17 || scale_short(digits, -places) == value) {
                append_digits(text, digits, -places);
                return;
            }
            continue;
        }
        std::array<char, 40> buffer;
        std::snprintf(buffer.data(), buffer.size(), "%.*e", count - 1, value);
        buffer[1] = '.';  // a locale may have put a comma there
        std::string_view rest = buffer.data();
        Decimal decimal;
        scan_decimal(rest, decimal);
        if (count == 17 || decimal_value(decimal) == value) {
            append_digits(text, decimal.value, static_cast<int>(decimal.power));
            return;
        }
    }
}

}  // namespace layout_embedding
