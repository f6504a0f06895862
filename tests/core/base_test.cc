#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <set>
#include <vector>

#include "base/error.hh"
#include "base/index_set.hh"
#include "base/quad_heap.hh"
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

TEST(QuadHeap, gives_back_the_least_whatever_came_and_went_before)
{
    Random random(2);
    QuadHeap<std::uint64_t> heap;
    std::multiset<std::uint64_t> expected;
    for (int i = 0; i < 20'000; ++i) {
        if (expected.empty() || random.below(i < 10'000 ? 3 : 2) != 0) {
            const std::uint64_t item = random.below(500);
            heap.push(item);
            expected.insert(item);
        } else {
            ASSERT_EQ(heap.top(), *expected.begin());
            heap.pop();
            expected.erase(expected.begin());
        }
        ASSERT_EQ(heap.empty(), expected.empty());
    }
    heap.push(7);
    heap.clear();
    EXPECT_TRUE(heap.empty());
}

TEST(IndexSet, holds_what_a_plain_set_holds)
{
    Random random(3);
    for (int round = 0; round < 50; ++round) {
        IndexSet set;
        IndexSet other;
        std::set<Index> plain_set;
        std::set<Index> plain_other;
        for (int i = 0; i < 200; ++i) {
            const auto index = static_cast<Index>(random.below(1 + 20 * round));
            switch (random.below(3)) {
                case 0:
                    set.insert(index);
                    plain_set.insert(index);
                    break;
                case 1:
                    set.erase(index);
                    plain_set.erase(index);
                    break;
                default:
                    other.insert(index);
                    plain_other.insert(index);
            }
            ASSERT_EQ(set.contains(index), plain_set.count(index) == 1);
        }
        std::vector<Index> all;
        EXPECT_TRUE(set.all_of([&](Index i) {
            all.push_back(i);
            return true;
        }));
        EXPECT_EQ(all, std::vector<Index>(plain_set.begin(), plain_set.end()));
        std::vector<Index> left;
        EXPECT_TRUE(set.all_of_but(other, [&](Index i) {
            left.push_back(i);
            return true;
        }));
        std::vector<Index> expected;
        std::set_difference(plain_set.begin(), plain_set.end(), plain_other.begin(),
                            plain_other.end(), std::back_inserter(expected));
        EXPECT_EQ(left, expected);
        EXPECT_EQ(set.all_of_but(other, [](Index) { return false; }), expected.empty());
    }
}

}  // namespace
}  // namespace layout_embedding
