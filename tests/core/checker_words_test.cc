#include "embedding/checker_words.hh"

#include <cstdlib>
#include <gtest/gtest.h>
#include <numeric>

#include "base/random.hh"

namespace layout_embedding::checker {
namespace {

Word power(const Word& word, int exponent)
{
    Word result;
    for (int i = 0; i < std::abs(exponent); ++i) {
        multiply(result, exponent > 0 ? word : inverse(word));
    }
    return result;
}

Word random_word(Random& random, std::size_t length, int rank)
{
    Word result;
    for (std::size_t i = 0; i < length; ++i) {
        const auto letter = static_cast<std::int32_t>(1 + random.below(rank));
        multiply(result, random.below(2) == 0 ? letter : -letter);
    }
    return result;
}

Word product(Word a, const Word& b)
{
    multiply(a, b);
    return a;
}

TEST(CheckerWords, a_word_times_its_inverse_is_empty)
{
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        const Word word = random_word(random, random.below(30), 3);
        EXPECT_TRUE(product(word, inverse(word)).empty());
        EXPECT_TRUE(product(inverse(word), word).empty());
    }
}

TEST(CheckerWords, products_of_powers_are_found_however_large_the_powers)
{
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const int rank = 1 + static_cast<int>(random.below(3));
        const Word x = random_word(random, random.below(8), rank);
        const Word y = random_word(random, random.below(8), rank);
        const int a = static_cast<int>(random.below(41)) - 20;
        const int b = static_cast<int>(random.below(41)) - 20;
        EXPECT_TRUE(is_product_of_powers(x, y, product(power(x, a), power(y, b))));
    }
}

TEST(CheckerWords, decision_agrees_with_trying_all_small_powers)
{
    // Short words: by the bound in checker_words.cc no power beyond these can matter.
    Random random(3);
    int yes = 0;
    int no = 0;
    for (int i = 0; i < 800; ++i) {
        const Word x = random_word(random, random.below(4), 2);
        const Word y = random_word(random, random.below(4), 2);
        const Word z = random_word(random, random.below(6), 2);
        const int bound = static_cast<int>(z.size() + 2 * (x.size() + y.size()));
        bool expected = false;
        for (int a = -bound; a <= bound && !expected; ++a) {
            for (int b = -bound; b <= bound && !expected; ++b) {
                expected = product(power(x, a), power(y, b)) == z;
            }
        }
        EXPECT_EQ(is_product_of_powers(x, y, z), expected);
        ++(expected ? yes : no);
    }
    EXPECT_GT(yes, 50);
    EXPECT_GT(no, 50);
}

TEST(CheckerWords, commuting_powers_follow_the_greatest_common_divisor)
{
    const Word root{1, 2};
    for (int i = 1; i < 6; ++i) {
        for (int j = 1; j < 6; ++j) {
            for (int k = -12; k <= 12; ++k) {
                EXPECT_EQ(is_product_of_powers(power(root, i), power(root, j), power(root, k)),
                          k % std::gcd(i, j) == 0);
            }
        }
    }
}

}  // namespace
}  // namespace layout_embedding::checker
