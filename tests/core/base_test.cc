#include <gtest/gtest.h>
#include <set>

#include "base/error.hh"
#include "base/random.hh"

namespace layout_embedding {
namespace {

TEST(Error, every_code_stands_at_its_own_row_with_its_own_name)
{
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < all_error_infos().size(); ++i) {
        const ErrorInfo& info = all_error_infos()[i];
        EXPECT_EQ(static_cast<std::size_t>(info.code), i) << info.name;
        EXPECT_TRUE(names.insert(info.name).second) << info.name;
        EXPECT_FALSE(info.meaning.empty());
        EXPECT_FALSE(info.advice.empty());
    }
    // A code that there is not is an internal error.
    const auto beyond = static_cast<ErrorCode>(all_error_infos().size());
    EXPECT_EQ(error_info(beyond).code, ErrorCode::internal);
}

TEST(Error, message_says_what_where_and_what_to_do)
{
    const Error error = make_error(ErrorCode::duplicateLandmark, "landmarks 1 and 4 are both 7");
    EXPECT_EQ(error.message, "landmarks 1 and 4 are both 7; move one of them to another vertex.");
}

TEST(Random, numbers_are_those_of_splitmix64)
{
    // First outputs for seed 1234567 as published with the generator.
    Random random(1234567);
    EXPECT_EQ(random.bits(), 6457827717110365317ULL);
    EXPECT_EQ(random.bits(), 3203168211198807973ULL);
    EXPECT_EQ(random.bits(), 9817491932198370423ULL);
}

TEST(Random, below_stays_below_and_reaches_everything)
{
    Random random(1);
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 1000; ++i) {
        seen.insert(random.below(7));
    }
    EXPECT_EQ(seen.size(), 7U);
    EXPECT_EQ(*seen.rbegin(), 6U);
}

}  // namespace
}  // namespace layout_embedding
