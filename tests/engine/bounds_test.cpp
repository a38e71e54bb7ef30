// Limits: conditions of subscriptions in total, live commands, and the results of ended commands.
#include "engine/commands/command.hpp"
#include "engine/conditions/like_pattern.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

Condition named_one_of(std::size_t count, std::string const& padding = {}) {
    std::vector<Condition> operands{equal("component_ref", "detection")};
    for (std::size_t i = 1; i < count; ++i) operands.push_back(equal("component_ref", std::to_string(i) + padding));
    return either(std::move(operands));
}

}  // namespace

TEST(ConditionsTogether, OfASessionHaveAMebibyteOfTextAtMost) {
    World world{detection};
    auto desk = world.connect(), other = world.connect();
    std::string const long_text(600'000, 'x');
    auto const first = desk.subscribe("person_detected", named_one_of(2, long_text));
    EXPECT_EQ(first.return_code, ReturnCode::ok);
    EXPECT_EQ(desk.subscribe("person_detected", named_one_of(2, long_text)).subscribe_id, first.subscribe_id);
    auto const refused = desk.subscribe("person_detected", named_one_of(2, long_text + "y"));
    EXPECT_EQ(refused.return_code, ReturnCode::out_of_resources);
    EXPECT_THAT(refused.reason, HasSubstr("a session's subscriptions may have at most 1048576 bytes of text in total"));
    world.advance(std::chrono::milliseconds{100});  // a journal stores only so much at once
    EXPECT_EQ(other.subscribe("person_detected", named_one_of(2, long_text + "y")).return_code, ReturnCode::ok);
    desk.unsubscribe(first.subscribe_id);
    world.advance(std::chrono::milliseconds{100});
    EXPECT_EQ(desk.subscribe("person_detected", named_one_of(2, long_text + "y")).return_code, ReturnCode::ok);
}

TEST(ConditionsTogether, OfAllHaveSoManyPredicates) {
    EngineSettings settings;
    settings.max_predicates = 10;
    World world{{detection}, settings};
    auto desk = world.connect(), other = world.connect();
    auto const first = desk.subscribe("person_detected", named_one_of(7));
    EXPECT_EQ(first.return_code, ReturnCode::ok);
    EXPECT_EQ(other.subscribe("person_detected", named_one_of(7)).return_code, ReturnCode::ok)
        << "the same condition is kept once";
    auto const refused = other.subscribe("person_detected", named_one_of(3));
    EXPECT_EQ(refused.return_code, ReturnCode::out_of_resources);
    EXPECT_THAT(refused.reason, HasSubstr("the conditions of all subscriptions may have at most 10 predicates in total"));
    desk.unsubscribe(first.subscribe_id);
    EXPECT_EQ(other.subscribe("person_detected", named_one_of(3)).return_code, ReturnCode::out_of_resources) << "`other` has it";
    other.unsubscribe(first.subscribe_id);
    EXPECT_EQ(other.subscribe("person_detected", named_one_of(3)).return_code, ReturnCode::ok);
}

// A pattern of the maximum length, with all characters different.
TEST(LikePatterns, WithAThousandCharactersMatchCorrectly) {
    PropertyIsLike const characters{{}, {}, "*", "?", "!", true};
    auto const at = [](int i) {
        return std::string{static_cast<char>(0xE4), static_cast<char>(0x80 + i / 64 % 64), static_cast<char>(0x80 + i % 64)};
    };
    std::string pattern, text;
    for (int i = 0; i < 1'000; ++i) {
        bool const any = i % 7 == 3, wild = i % 11 == 5;
        pattern += (wild ? "*" : "") + (any ? std::string{"?"} : at(i % 600));
        text += (wild ? at(i) + at(i + 1) : "") + (any ? std::string{"z"} : at(i % 600));
        if (wild && i % 2 == 0) ++i;
    }
    auto const compiled = std::get<LikePattern>(LikePattern::compile(pattern, characters));
    EXPECT_TRUE(compiled.matches(text));
    EXPECT_FALSE(compiled.matches(text + "z"));
    EXPECT_FALSE(compiled.matches(text.substr(3)));
}

TEST(EndedCommands, KeepNoArguments) {
    struct LastEnded : Trace {
        Command const* command = nullptr;
        std::size_t arguments = 0;
        void command_ended(Command const& ended) override {
            command = &ended;
            arguments = ended.arguments.size();
        }
    } ended;
    World world{navigation};
    world.engine->report_to(ended);
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("a"));
    world["navigation"].finishes();
    ASSERT_NE(ended.command, nullptr);
    EXPECT_EQ(ended.arguments, 1U) << "the log may show them";
    EXPECT_EQ(desk.result_of("a"), "OK") << "it is kept";
    EXPECT_TRUE(ended.command->arguments.empty());
}

}  // namespace rois
