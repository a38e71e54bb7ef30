// Identifiers have at most 256 characters, everywhere in a request.
#include "engine/world.hpp"
#include "types/identifier_length.hpp"

namespace rois {

namespace {

std::string const longest(256, 'x');
std::string const too_long(257, 'x');

struct Identifiers : testing::Test {
    World world{navigation, speech, desk_lamp};
    Application desk{world.connect()};

    // Returns the code and reason of the answer.
    Outcome outcome_of(Operation const& operation) {
        auto const reply = std::get<Reply>(world.say(desk.session, operation));
        return std::visit([](Outcome const& outcome) { return outcome; }, reply);
    }
};

testing::Matcher<Outcome const&> is_too_long(std::string const& what) {
    return testing::AllOf(
        testing::Field(&Outcome::return_code, ReturnCode::bad_parameter),
        testing::Field(&Outcome::reason, testing::AllOf(HasSubstr(what), HasSubstr("has 257 characters: expected 256 at most"))));
}

}  // namespace

TEST_F(Identifiers, OfMoreThan256CharactersAreBadParameters) {
    desk.bind("lamp");
    auto const identifier = Application::identifier;
    EXPECT_THAT(outcome_of(Bind{identifier(too_long)}), is_too_long("component_ref"));
    EXPECT_THAT(outcome_of(Bind{{"lamp", {}, too_long, {}}}), is_too_long("codebook_ref"));
    EXPECT_THAT(outcome_of(Bind{{"lamp", too_long, {}, {}}}), is_too_long("authority"));
    EXPECT_THAT(outcome_of(Bind{{"lamp", {}, {}, too_long}}), is_too_long("version"));
    EXPECT_THAT(outcome_of(Release{identifier(too_long)}), is_too_long("component_ref"));
    EXPECT_THAT(outcome_of(GetParameter{identifier(too_long)}), is_too_long("component_ref"));
    EXPECT_THAT(outcome_of(SetParameter{identifier(too_long), {}}), is_too_long("component_ref"));
    EXPECT_THAT(outcome_of(SetParameter{identifier("lamp"), {value(too_long, "string", {"x"})}}), is_too_long("name"));
    EXPECT_THAT(outcome_of(SetParameter{identifier("lamp"), {value("label", too_long, {"x"})}}), is_too_long("data_type_ref"));
    EXPECT_THAT(outcome_of(SetParameter{identifier("lamp"), {value("owner", "RoISIdentifier", {too_long})}}),
                is_too_long("parameter 'owner'"));
    EXPECT_THAT(outcome_of(GetCommandResult{{too_long}, {}}), is_too_long("command_id"));
    EXPECT_THAT(outcome_of(Query{too_long, {}}), is_too_long("query_type"));
    EXPECT_THAT(outcome_of(Subscribe{too_long, {}, false}), is_too_long("event_type"));
    EXPECT_THAT(outcome_of(Unsubscribe{{too_long}}), is_too_long("subscribe_id"));
    EXPECT_THAT(outcome_of(GetEventDetail{{too_long}, {}}), is_too_long("event_id"));
    EXPECT_THAT(outcome_of(GetErrorDetail{{too_long}, {}}), is_too_long("error_id"));
}

TEST_F(Identifiers, OfMoreThan256CharactersAreRefusedInEveryUnitOfASequence) {
    desk.bind("navigation");
    auto const bad = named(too_long, stop("navigation"));
    for (auto const& unit : {bad, in_sequence({stop("navigation"), bad}), in_parallel({stop("navigation"), bad}),
                             branches({{stop("navigation")}, {bad}})})
        EXPECT_THAT(outcome_of(Execute{{{unit}}}), is_too_long("command_id"));
    EXPECT_THAT(outcome_of(Execute{{{command(too_long, "navigation")}}}), is_too_long("command_type"));
    EXPECT_THAT(outcome_of(Execute{{{command("stop", too_long)}}}), is_too_long("component_ref"));
    EXPECT_TRUE(desk.received().empty()) << "nothing ran";
}

TEST_F(Identifiers, OfMoreThan256CharactersAreRefusedInConditions) {
    EXPECT_THAT(outcome_of(Search{Condition{ResourceId{too_long}}}), is_too_long("the rid of a ResourceId"));
    ComponentGroup group;
    group.types = {too_long};
    EXPECT_THAT(outcome_of(Search{Condition{group}}), is_too_long("the type of a component"));
    group = {.types = {"a"}, .aliases = {too_long}, .filter = {}, .members = {}};
    EXPECT_THAT(outcome_of(Search{Condition{group}}), is_too_long("an alias"));
}

TEST_F(Identifiers, Of256CharactersAreLookedUp) {
    desk.bind("navigation");
    auto const id = named(longest, stop("navigation"));
    EXPECT_EQ(desk.execute(id).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.result_of(longest), "OK");
    EXPECT_THAT(outcome_of(Bind{Application::identifier(longest)}).reason, testing::Not(HasSubstr("characters")));
    EXPECT_EQ(desk.search(Condition{ResourceId{longest}}), std::vector<std::string>{});
}

TEST_F(Identifiers, AreCountedInCharactersNotInBytes) {
    std::string euros;
    for (int i = 0; i < 256; ++i) euros += "\xE2\x82\xAC";
    EXPECT_EQ(why_too_long("it", euros), std::nullopt);
    EXPECT_THAT(why_too_long("it", euros + "x").value_or(""), HasSubstr("it '\xE2\x82\xAC"));
}

TEST_F(Identifiers, OfASessionThatAreTooLongAreUnknown) {
    EXPECT_EQ(std::get<Refusal>(world.say({too_long}, Search{})), Refusal::no_session);
    EXPECT_EQ(std::get<Refusal>(world.say({}, Resume{{too_long}, 0})), Refusal::no_session);
}

}  // namespace rois
