#include "base/number_text.hh"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

#include "base/random.hh"

namespace layout_embedding {
namespace {

double parsed(const std::string& text)
{
    std::string_view rest = text;
    double value = 0;
    EXPECT_TRUE(parse_number(rest, value)) << text;
    EXPECT_TRUE(rest.empty()) << text;
    return value;
}

std::string written(double value)
{
    std::string text;
    append_number(text, value);
    return text;
}

bool same_bits(double a, double b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

double from_bits(std::uint64_t bits)
{
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

TEST(ParseNumber, rounds_correctly_like_strtod)
{
    Random random(1);
    for (int i = 0; i < 100'000; ++i) {
        // Digits with a point somewhere and, half the time, an exponent of any size.
        std::string text = random.below(2) == 0 ? "-" : "";
        const std::uint64_t digits = 1 + random.below(i % 100 == 0 ? 900 : 40);
        const std::uint64_t point = random.below(digits + 1);
        for (std::uint64_t k = 0; k < digits; ++k) {
            text += k == point ? "." : "";
            text += static_cast<char>('0' + random.below(10));
        }
        if (random.below(2) == 0) {
            text += 'e';
            text += std::to_string(static_cast<int>(random.below(700)) - 350);
        }
        ASSERT_TRUE(same_bits(parsed(text), std::strtod(text.c_str(), nullptr))) << text;
    }
}

TEST(ParseNumber, rounds_correctly_halfway_between_doubles)
{
    // Exact decimals of midpoints, and their neighbours in the last of 800 digits.
    Random random(2);
    for (int i = 0; i < 2'000; ++i) {
        const double value = from_bits(random.below(0x7ff0000000000000ULL - 1));
        const double next = std::nextafter(value, std::numeric_limits<double>::infinity());
        char buffer[1200];
        // In long double the midpoint is exact where its exponent range allows.
        const long double middle = (static_cast<long double>(value) + next) / 2;
        std::snprintf(buffer, sizeof buffer, "%.800Le", middle);
        ASSERT_TRUE(same_bits(parsed(buffer), std::strtod(buffer, nullptr))) << buffer;
        std::string above = buffer;
        above[above.find('e') - 1] = '1';
        ASSERT_TRUE(same_bits(parsed(above), std::strtod(above.c_str(), nullptr))) << above;
    }
}

TEST(ParseNumber, knows_the_edges_of_the_range)
{
    EXPECT_EQ(parsed("4.9406564584124654e-324"), std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(parsed("2.4703282292062327e-324"), 0.0);
    EXPECT_EQ(parsed("2.4703282292062328e-324"), std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(parsed("1.7976931348623157e308"), std::numeric_limits<double>::max());
    EXPECT_EQ(parsed("1.7976931348623159e308"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(parsed("1e99999999999999999999"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(parsed("1e-99999999999999999999"), 0.0);
    EXPECT_EQ(parsed("0e99999999999999999999"), 0.0);
    EXPECT_TRUE(same_bits(parsed("-0"), -0.0));
    EXPECT_EQ(parsed("-Infinity"), -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(parsed("NaN")));
    EXPECT_EQ(parsed("+.5"), 0.5);
    EXPECT_EQ(parsed("5."), 5.0);
}

TEST(ParseNumber, leaves_alone_what_is_no_number)
{
    for (const std::string text : {"", "-", ".", "e5", "-.e1", "x1", "--1", "+-1", " 1"}) {
        std::string_view rest = text;
        double value = 42;
        EXPECT_FALSE(parse_number(rest, value)) << text;
        EXPECT_EQ(rest, text);
        EXPECT_EQ(value, 42);
    }
    std::string_view rest = "1.5e+x";
    double value = 0;
    EXPECT_TRUE(parse_number(rest, value));
    EXPECT_EQ(value, 1.5);
    EXPECT_EQ(rest, "e+x");
}

TEST(AppendNumber, reads_back_as_the_same_double)
{
    Random random(3);
    for (int i = 0; i < 50'000; ++i) {
        double value = from_bits(random.bits());
        if (i % 2 == 0) {
            value = (2 * random.unit() - 1) * static_cast<double>(1 + random.below(1000));
        }
        if (!std::isnan(value)) {
            const std::string text = written(value);
            ASSERT_TRUE(same_bits(parsed(text), value)) << text;
        }
    }
}

TEST(AppendNumber, is_as_short_as_the_shortest_of_15_to_17_digits)
{
    Random random(4);
    for (int i = 0; i < 100'000; ++i) {
        const double value =
            i % 3 == 0 ? static_cast<double>(random.below(100'000)) / 1000 : 2 * random.unit() - 1;
        char shortest[40];
        for (int digits = 15; digits <= 17; ++digits) {
            std::snprintf(shortest, sizeof shortest, "%.*g", digits, value);
            if (std::strtod(shortest, nullptr) == value) {
                break;
            }
        }
        // The C library turns to exponents below 1e-4 rather than 1e-5.
        if (std::abs(value) >= 1e-4) {
            ASSERT_EQ(written(value), shortest);
        }
    }
    EXPECT_EQ(written(0.1), "0.1");
    EXPECT_EQ(written(-2.5), "-2.5");
    EXPECT_EQ(written(0), "0");
    EXPECT_EQ(written(100), "100");
    EXPECT_EQ(written(1e300), "1e300");
    EXPECT_EQ(written(1.25e-7), "1.25e-7");
    EXPECT_EQ(written(1.0 / 3), "0.3333333333333333");
}

}  // namespace
}  // namespace layout_embedding
