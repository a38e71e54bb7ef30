// The table of tokens, with a clock of its own.
#include <gtest/gtest.h>

#include "gateway/access/tokens.hpp"

namespace rois::test {

namespace {

using namespace std::chrono_literals;

struct TokensOverTime : testing::Test {
    rois::Tokens tokens{3};
    Instant now{Steady{} + 1h, Utc{} + 50 * 365 * 24h};
    Address const here = read_address("192.0.2.1").value(), there = read_address("192.0.2.2").value();

    static std::shared_ptr<Principal> holder(std::string const& token, std::optional<Utc> expires = {},
                                             Role role = Role::operator_) {
        std::vector<std::string> const all{"*"};
        auto made = std::make_shared<Principal>();
        made->role = role;
        made->rights = std::make_shared<Rights const>(token, all, all);
        made->expires = expires;
        made->hash = sha256(token);
        return made;
    }
    rois::Tokens::Holder find(std::string const& token) {
        auto found = tokens.holder(token, here, now);
        auto* const holder = std::get_if<rois::Tokens::Holder>(&found);
        return holder != nullptr ? *holder : nullptr;
    }
    auto refusal(Address const& from) { return std::get<rois::Tokens::Refused>(tokens.holder("wrong", from, now)); }
};

}  // namespace

TEST_F(TokensOverTime, ExpireAtTheirTime) {
    tokens.set({holder("short", now.utc + 1s), holder("long", now.utc + 2s), holder("for ever")});
    auto const found = find("short");
    EXPECT_FALSE(tokens.end_expired(now.utc + 999ms));
    EXPECT_FALSE(found->is_over());
    now.utc += 1s;
    EXPECT_EQ(find("short"), nullptr) << "also before the next tick";
    EXPECT_TRUE(tokens.end_expired(now.utc));
    EXPECT_TRUE(found->is_over());
    EXPECT_FALSE(tokens.end_expired(now.utc)) << "reported once";
    EXPECT_NE(find("long"), nullptr);
    EXPECT_NE(find("for ever"), nullptr);
}

TEST_F(TokensOverTime, StayTheSameIfTheirEntriesDo) {
    tokens.set({holder("stays"), holder("changes"), holder("goes")});
    auto const stays = find("stays"), changes = find("changes"), goes = find("goes");
    tokens.set({holder("stays"), holder("changes", {}, Role::observer)});
    EXPECT_EQ(find("stays"), stays);
    EXPECT_FALSE(stays->is_over());
    EXPECT_TRUE(changes->is_over());
    EXPECT_EQ(find("changes")->role, Role::observer);
    EXPECT_TRUE(goes->is_over());
    EXPECT_EQ(find("goes"), nullptr);
    EXPECT_TRUE(tokens.end_expired(now.utc));
}

TEST_F(TokensOverTime, AreAddedUntilTheirRightsAreWithdrawn) {
    auto const program = holder("program");
    tokens.add(program);
    tokens.add(holder("another"));
    EXPECT_EQ(find("program"), program);
    program->rights->withdraw();
    EXPECT_EQ(find("program"), nullptr);
    EXPECT_NE(find("another"), nullptr);
}

TEST_F(TokensOverTime, AreGuessedTooOftenForAMinute) {
    using enum rois::Tokens::Refused;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(refusal(here), wrong);
    EXPECT_EQ(refusal(here), too_many);
    EXPECT_EQ(refusal(there), wrong) << "each address has its own count";
    now = now + 59s;
    EXPECT_EQ(refusal(here), too_many);
    now = now + 1s;
    EXPECT_EQ(refusal(here), wrong);
}

TEST_F(TokensOverTime, AreCountedForAFewThousandAddressesOnly) {
    using enum rois::Tokens::Refused;
    auto address = here;
    for (unsigned i = 0; i < 10'000; ++i) {
        address[12] = static_cast<unsigned char>(i >> 8);
        address[13] = static_cast<unsigned char>(i);
        EXPECT_EQ(refusal(address), wrong);
    }
    EXPECT_EQ(refusal(there), too_many) << "a flood of addresses takes no more memory";
    now = now + 1min;
    EXPECT_EQ(refusal(there), wrong);
}

}  // namespace rois::test
