// Decisions 8 and 26: parameters are stored, by name and type.
#include <gmock/gmock.h>

#include "world.hpp"

namespace rois {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

// An application that has the lamp bound, and nothing else on its mind.
struct Lamp : testing::Test {
    World world{desk_lamp};
    Application desk = world.connect();

    Lamp() { desk.bind("lamp"); }

    // What is answered to a parameter: "OK", or why not.
    std::string set(Parameter parameter) {
        auto const reply = desk.set_parameter("lamp", {std::move(parameter)});
        return reply.return_code == ReturnCode::ok ? "OK" : reply.reason;
    }
    std::string stored() { return in_words(desk.get_parameter("lamp").parameters); }
};

}  // namespace

TEST_F(Lamp, HasItsDefaultsFirst) { EXPECT_EQ(stored(), "counts=1 2 labels=red|green"); }

TEST_F(Lamp, KeepsWhatIsSetInTheOrderOfItsProfile) {
    auto const reply = desk.set_parameter("lamp", {text("label", "night"), integer("count", 7)});
    EXPECT_EQ(reply.return_code, ReturnCode::ok);
    EXPECT_EQ(stored(), "count=7 label=night counts=1 2 labels=red|green");
    EXPECT_THAT(desk.heard(), ElementsAre("1 completed " + reply.command_id.text + " OK"));
    EXPECT_EQ(desk.result_of(reply.command_id.text), "OK");
    EXPECT_THAT(world["lamp"].told, ElementsAre("parameters_changed"));
}

TEST_F(Lamp, TakesNamesAndTypesInAnyCase) {
    EXPECT_EQ(set(value("COUNT", "INT", {"7"})), "OK");
    EXPECT_EQ(set(value("Label", "String", {"x"})), "OK");
    auto const parameters = desk.get_parameter("lamp").parameters;
    EXPECT_EQ(parameters.front().name, "count");
    EXPECT_EQ(parameters.front().data_type_ref.code, "int");
}

TEST_F(Lamp, TakesTheUrnFormsOfTypes) {
    EXPECT_EQ(set(value("count", "urn:x-rois:def:DataType:ATR::Integer", {"7"})), "OK");
    EXPECT_EQ(set(value("ratio", "double", {"0.5"})), "OK") << "the profile has the URN form here";
    EXPECT_EQ(set(value("counts", "urn:x-rois:def:DataType:ATR::Integer[]", {"7 8"})), "OK");
}

TEST_F(Lamp, TakesOtherSpellings) {
    EXPECT_EQ(set(value("grammer", "string", {"abc"})), "OK");
    EXPECT_EQ(stored(), "counts=1 2 labels=red|green grammar=abc");
}

TEST_F(Lamp, TakesEveryType) {
    EXPECT_EQ(set(value("ratio", "double", {"-1.5e3"})), "OK");
    EXPECT_EQ(set(value("lit", "bool", {"true"})), "OK");
    EXPECT_EQ(set(value("since", "DateTime", {"2026-11-20T12:00:00.123Z"})), "OK");
    EXPECT_EQ(set(value("owner", "RoISIdentifier", {"visitor_1"})), "OK");
    EXPECT_EQ(set(value("counts", "int[]", {"1 2 3"})), "OK");
    EXPECT_EQ(set(value("labels", "string[]", {"one two", ""})), "OK");
    EXPECT_EQ(set(value("owners", "RoISIdentifier[]", {})), "OK");
    EXPECT_EQ(set(value("shade", "shade", {"anything"})), "OK");
}

TEST_F(Lamp, TellsTimesInUtc) {
    EXPECT_EQ(set(value("since", "DateTime", {" 2026-11-20T12:00:00.5+01:00"})), "OK");
    EXPECT_EQ(stored(), "since=2026-11-20T11:00:00.5Z counts=1 2 labels=red|green");
}

TEST_F(Lamp, RefusesTextsThatAreNotOfTheType) {
    EXPECT_EQ(set(value("count", "int", {"many"})), "parameter 'count': 'many' is not of the type int");
    EXPECT_EQ(set(value("count", "int", {"2147483648"})), "parameter 'count': '2147483648' is not of the type int");
    EXPECT_THAT(set(value("ratio", "double", {"half"})), HasSubstr("'half' is not of the type double"));
    EXPECT_THAT(set(value("lit", "bool", {"yes"})), HasSubstr("'yes' is not of the type bool"));
    EXPECT_THAT(set(value("since", "DateTime", {"yesterday"})), HasSubstr("'yesterday' is not of the type DateTime"));
    EXPECT_THAT(set(value("counts", "int[]", {"1 two"})), HasSubstr("'two' is not of the type int"));
    EXPECT_EQ(stored(), "counts=1 2 labels=red|green");
    EXPECT_TRUE(world["lamp"].told.empty());
    EXPECT_TRUE(desk.heard().empty());
}

TEST_F(Lamp, RefusesTheWrongDeclaredType) {
    EXPECT_EQ(set(value("count", "string", {"7"})), "parameter 'count' is declared as 'string', its type is int");
    EXPECT_EQ(set(value("count", "int[]", {"7"})), "parameter 'count' is declared as 'int[]', its type is int");
    EXPECT_THAT(set(value("shade", "Colour", {"x"})), HasSubstr("its type is Shade"));
}

TEST_F(Lamp, RefusesTheWrongCount) {
    EXPECT_THAT(set(value("count", "int", {"1", "2"})), HasSubstr("needs exactly one value, here are 2"));
    EXPECT_THAT(set(value("count", "int", {})), HasSubstr("needs exactly one value, here are 0"));
    EXPECT_THAT(set(value("counts", "int[]", {"1", "2"})), HasSubstr("has one value, its items separated by spaces"));
}

TEST_F(Lamp, RefusesWhatItDoesNotKnowAndWhatIsThereTwice) {
    EXPECT_THAT(set(value("colour", "string", {"red"})), HasSubstr("unknown parameter 'colour'; known are count, ratio, lit"));
    auto const twice = desk.set_parameter("lamp", {integer("count", 1), integer("Count", 2)});
    EXPECT_EQ(twice.return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(twice.reason, "parameter 'Count' is there twice");
    auto const spelt_twice = desk.set_parameter("lamp", {text("grammar", "a"), text("grammer", "b")});
    EXPECT_EQ(spelt_twice.return_code, ReturnCode::bad_parameter);
}

TEST_F(Lamp, StoresAllOrNothing) {
    EXPECT_EQ(desk.set_parameter("lamp", {integer("count", 1), text("label", "x"), value("lit", "bool", {"maybe"})}).return_code,
              ReturnCode::bad_parameter);
    EXPECT_EQ(stored(), "counts=1 2 labels=red|green");
}

TEST_F(Lamp, KeepsTheCodebookOfAType) {
    auto owner = reference("owner", "visitor_1", "urn:x-test:codebook");
    EXPECT_EQ(set(owner), "OK");
    EXPECT_EQ(desk.get_parameter("lamp").parameters.front().data_type_ref.codebook_ref, "urn:x-test:codebook");
}

TEST(Parameters, OfAStartAreStoredFirst) {
    World world{speech};
    auto desk = world.connect();
    desk.bind("speech");
    desk.execute(named("say", start("speech", {text("speech_text", "hello"), integer("volume", 70)})));
    EXPECT_EQ(in_words(world["speech"].started_with), "speech_text=hello volume=70 language=en");
    EXPECT_THAT(world["speech"].told, ElementsAre("start"));
    world["speech"].finishes();
    desk.execute(named("again", start("speech")));
    EXPECT_EQ(in_words(world["speech"].started_with), "speech_text=hello volume=70 language=en");
}

TEST(Parameters, ThatAreMandatoryMustBeThereByTheStart) {
    World world{navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    auto const refused = desk.execute(start("navigation"));
    EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(refused.reason, "command_unit_list[1]: the parameter target_position is mandatory");
    auto const places = texts("target_positions", {"0, 0, 0"});
    EXPECT_EQ(desk.execute(set("navigation", {places}), start("navigation")).return_code, ReturnCode::ok)
        << "what an earlier unit of the document stores counts";
    EXPECT_EQ(world["navigation"].told, (std::vector<std::string>{"parameters_changed", "start"}));
}

TEST(Parameters, ThatReplaceOneAnotherDoSo) {
    World world{speech};
    auto desk = world.connect();
    desk.bind("speech");
    desk.set_parameter("speech", {text("speech_text", "hello")});
    desk.set_parameter("speech", {text("ssml_text", "<speak/>")});
    EXPECT_EQ(in_words(desk.get_parameter("speech").parameters),
              "synthesizable_languages=en|ja SSML_text=<speak/> volume=50 language=en");
}

TEST(Parameters, StayWhenTheComponentIsReleased) {
    World world{navigation};
    auto desk = world.connect(), hall = world.connect();
    desk.bind("navigation");
    desk.set_parameter("navigation", {integer("time_limit", 9)});
    desk.leave();
    hall.bind("navigation");
    EXPECT_EQ(in_words(hall.get_parameter("navigation").parameters), "time_limit=9 routing_policy=time");
}

TEST(Parameters, OfAComponentThatHasNoneAreNone) {
    World world{detection};
    auto desk = world.connect();
    desk.bind("detection");
    EXPECT_EQ(desk.get_parameter("detection").return_code, ReturnCode::ok);
    EXPECT_TRUE(desk.get_parameter("detection").parameters.empty());
    EXPECT_EQ(desk.set_parameter("detection", {}).return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(desk.query("get_parameter").return_code, ReturnCode::unsupported);
}

TEST(Parameters, MayBeSetWhileTheActionRuns) {
    World world{speech};
    auto desk = world.connect();
    desk.bind("speech");
    desk.execute(say("say"));
    desk.set_parameter("speech", {integer("volume", 10)});
    EXPECT_THAT(world["speech"].told, ElementsAre("start", "parameters_changed"));
    EXPECT_EQ(desk.result_of("say"), "RUNNING");
}

}  // namespace rois
