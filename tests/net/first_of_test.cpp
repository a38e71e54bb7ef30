#include "gateway/access/first_of.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace rois {
namespace {

struct Guest {
    std::int64_t rank;
};

struct TheFirstOf : testing::Test {
    std::vector<Guest> guests;
    int asked = 0;
    FirstOf<Guest> first;

    Guest* find() {
        std::vector<Guest*> all;
        for (auto& guest : guests) all.push_back(&guest);
        return first(all, [this](Guest const& guest) {
            ++asked;
            return guest.rank;
        });
    }
};

TEST_F(TheFirstOf, IsTheOneWithTheLeastRankAlsoAfterRanksHaveChanged) {
    std::mt19937 random{1};
    std::int64_t now = 0;
    for (int i = 0; i < 500; ++i) guests.push_back({now += static_cast<int>(random() % 3)});
    for (int turn = 0; turn < 2'000; ++turn) {
        auto* const found = find();
        ASSERT_NE(found, nullptr);
        for (auto const& guest : guests) ASSERT_LE(found->rank, guest.rank) << turn;
        found->rank = ++now;
        auto& other = guests[random() % guests.size()];
        other.rank = random() % 4 == 0 ? FirstOf<Guest>::none : ++now;
    }
}

TEST_F(TheFirstOf, LooksAtAllOnlyOnceForManySearches) {
    for (int i = 0; i < 10'000; ++i) guests.push_back({i});
    for (int turn = 0; turn < 640; ++turn) find()->rank = 10'000 + turn;
    EXPECT_LT(asked, 11 * 10'000);
}

TEST_F(TheFirstOf, IsNothingIfNoneCanBeChosen) {
    EXPECT_EQ(find(), nullptr);
    guests.assign(3, {FirstOf<Guest>::none});
    EXPECT_EQ(find(), nullptr);
}

TEST_F(TheFirstOf, IsNotOneThatWasForgotten) {
    for (int i = 0; i < 3; ++i) guests.push_back({i});
    EXPECT_EQ(find(), &guests[0]);
    first.forget(guests[0]);
    guests[0].rank = FirstOf<Guest>::none;
    EXPECT_EQ(find(), &guests[1]);
}

}  // namespace
}  // namespace rois
