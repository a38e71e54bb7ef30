// Decisions 8 and 26: parameters are stored, by name and type.
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

// An application that has bound the lamp.
struct Lamp : testing::Test {
    World world{desk_lamp};
    Application desk = world.connect();

    Lamp() { desk.bind("lamp"); }

    // "OK", or the reason why the parameter is refused.
    std::string set(Parameter parameter) {
        auto const reply = desk.set_parameter("lamp", {std::move(parameter)});
        return reply.return_code == ReturnCode::ok ? "OK" : reply.reason;
    }
    std::string stored() { return in_words(desk.get_parameter("lamp").parameters); }
};

Part detection_with_threshold() {
    auto part = detection;
    part.profile.parameters.push_back(
        {.name = "threshold", .data_type_ref = {"int", {}, {}, {}}, .default_value = "50", .description = {}});
    return part;
}

}  // namespace

TEST_F(Lamp, StoresParametersInTheOrderOfItsProfile) {
    auto const reply = desk.set_parameter("lamp", {text("label", "night"), integer("count", 7)});
    EXPECT_EQ(reply.return_code, ReturnCode::ok);
    EXPECT_EQ(stored(), "count=7 label=night counts=1 2 labels=red|green");
    EXPECT_THAT(desk.received(), ElementsAre("1 completed " + reply.command_id.text + " OK"));
    EXPECT_EQ(desk.result_of(reply.command_id.text), "OK");
    EXPECT_THAT(world["lamp"].calls, ElementsAre("parameters_changed"));
}

TEST_F(Lamp, TakesNamesAndTypesInAnyCase) {
    EXPECT_EQ(set(value("COUNT", "INT", {"7"})), "OK");
    EXPECT_EQ(set(value("Label", "String", {"x"})), "OK");
    auto const parameters = desk.get_parameter("lamp").parameters;
    EXPECT_EQ(parameters.front().name, "count");
    EXPECT_EQ(parameters.front().data_type_ref.code, "int");
}

TEST_F(Lamp, ReturnsTimesInUtc) {
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
    EXPECT_TRUE(world["lamp"].calls.empty());
    EXPECT_TRUE(desk.received().empty());
}

TEST_F(Lamp, RefusesTheWrongDeclaredType) {
    EXPECT_EQ(set(value("count", "string", {"7"})), "parameter 'count' is declared as 'string', its type is int");
    EXPECT_EQ(set(value("count", "int[]", {"7"})), "parameter 'count' is declared as 'int[]', its type is int");
    EXPECT_THAT(set(value("shade", "Colour", {"x"})), HasSubstr("its type is Shade"));
}

TEST_F(Lamp, RefusesTheWrongCount) {
    EXPECT_THAT(set(value("count", "int", {"1", "2"})), HasSubstr("needs exactly one value, got 2"));
    EXPECT_THAT(set(value("count", "int", {})), HasSubstr("needs exactly one value, got 0"));
    EXPECT_THAT(set(value("counts", "int[]", {"1", "2"})),
                HasSubstr("is one value with items separated by spaces, got 2 values"));
}

TEST_F(Lamp, RefusesUnknownAndDuplicateParameters) {
    EXPECT_THAT(set(value("colour", "string", {"red"})),
                HasSubstr("unknown parameter 'colour'; expected one of count, ratio, lit"));
    auto const twice = desk.set_parameter("lamp", {integer("count", 1), integer("Count", 2)});
    EXPECT_EQ(twice.return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(twice.reason, "parameter 'Count' is given twice");
    auto const spelt_twice = desk.set_parameter("lamp", {text("grammar", "a"), text("grammer", "b")});
    EXPECT_EQ(spelt_twice.return_code, ReturnCode::bad_parameter);
}

TEST_F(Lamp, StoresAllOrNothing) {
    EXPECT_EQ(desk.set_parameter("lamp", {integer("count", 1), text("label", "x"), value("lit", "bool", {"maybe"})}).return_code,
              ReturnCode::bad_parameter);
    EXPECT_EQ(stored(), "counts=1 2 labels=red|green");
}

TEST_F(Lamp, KeepsTheCodebookOfAnIdentifier) {
    EXPECT_EQ(set(reference("owner", "robot_1", "urn:x-test:Robots")), "OK") << "codebooks are not case-sensitive";
    EXPECT_EQ(desk.get_parameter("lamp").parameters.front().data_type_ref.codebook_ref, "urn:x-test:Robots");
}

TEST_F(Lamp, TakesAnIdentifierWithoutACodebookForOneOfTheDefault) {
    EXPECT_EQ(set(reference("owner", "visitor_1")), "OK");
    EXPECT_EQ(desk.get_parameter("lamp").parameters.front().data_type_ref.codebook_ref, "urn:x-test:visitors");
}

TEST_F(Lamp, RefusesAnIdentifierOfAForeignCodebook) {
    EXPECT_EQ(set(reference("Owner", "tanaka", "urn:x-test:staff")),
              "parameter 'owner': 'tanaka' is from the codebook 'urn:x-test:staff', which is unknown here; expected one of "
              "urn:x-test:visitors, urn:x-test:robots");
    EXPECT_EQ(set(references("owners", {"tanaka", "sato"}, "urn:x-test:staff")),
              "parameter 'owners': 'tanaka, sato' is from the codebook 'urn:x-test:staff', which is unknown here; the component "
              "has no codebook for it: leave codebook_ref out");
    EXPECT_EQ(set(references("owners", {"tanaka", "sato"})), "OK");
    auto label = text("label", "x");
    label.data_type_ref.codebook_ref = "urn:x-test:staff";
    EXPECT_EQ(set(label), "OK") << "only codebooks of identifiers are checked";
}

TEST_F(Lamp, DeclaresTheDefaultCodebookInItsProfile) {
    auto const reply = desk.ask(GetProfile{equal("component_ref", "lamp")});
    auto const& profile = *reply.components.front().profile;
    EXPECT_EQ(find_parameter(profile.parameters, "owner")->data_type_ref.codebook_ref, "urn:x-test:visitors");
    EXPECT_EQ(find_parameter(find_message(profile, MessageKind::command, "set_parameter")->arguments, "owner")
                  ->data_type_ref.codebook_ref,
              "urn:x-test:visitors");
    EXPECT_EQ(find_parameter(profile.parameters, "owners")->data_type_ref.codebook_ref, "");
}

TEST(Parameters, KnowTheCodebookThatTheProfileDeclares) {
    auto part = desk_lamp;
    for (auto& parameter : part.profile.parameters)
        if (parameter.name == "owner") parameter.data_type_ref.codebook_ref = "urn:x-test:staff";
    World world{part};
    auto desk = world.connect();
    desk.bind("lamp");
    EXPECT_EQ(desk.set_parameter("lamp", {reference("owner", "tanaka")}).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.get_parameter("lamp").parameters.front().data_type_ref.codebook_ref, "urn:x-test:staff");
    EXPECT_EQ(desk.set_parameter("lamp", {reference("owner", "r1", "urn:x-test:robots")}).return_code, ReturnCode::ok);
    EXPECT_THAT(desk.set_parameter("lamp", {reference("owner", "x", "urn:x-test:y")}).reason,
                HasSubstr("expected one of urn:x-test:staff, urn:x-test:visitors, urn:x-test:robots"));
}

// The rule applies to all commands with parameters: `start`, set_parameter and the component's own. No command of the sequence
// runs.
TEST(Parameters, OfAForeignCodebookEndASequenceBeforeItBegins) {
    auto part = desk_lamp;
    part.profile.messages.push_back({.kind = MessageKind::command,
                                     .name = "give",
                                     .results = {},
                                     .arguments = {{"owner", {"RoISIdentifier", {}, {}, {}}, {}, {}}},
                                     .timeout = {}});
    World world{part};
    auto desk = world.connect();
    desk.bind("lamp");
    auto const foreign = reference("owner", "tanaka", "urn:x-test:staff");
    for (auto const* type : {"start", "give", "set_parameter"}) {
        auto const reply = desk.execute(set("lamp", {text("label", "x")}), command(type, "lamp", {foreign}));
        EXPECT_EQ(reply.return_code, ReturnCode::bad_parameter) << type;
        EXPECT_THAT(reply.reason, testing::StartsWith("command_unit_list[2]: parameter 'owner': 'tanaka' is from the codebook"))
            << type;
    }
    EXPECT_THAT(desk.received(), testing::IsEmpty());
    EXPECT_EQ(desk.execute(command("give", "lamp", {reference("owner", "tanaka")})).return_code, ReturnCode::ok);
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
        << "values that an earlier unit stores count";
    EXPECT_EQ(world["navigation"].calls, (std::vector<std::string>{"parameters_changed", "start"}));
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

TEST(Parameters, AreTheDefaultsAgainAfterARelease) {
    World world{navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.set_parameter("navigation", {integer("time_limit", 9)});
    desk.release("navigation");
    EXPECT_THAT(world["navigation"].calls, ElementsAre("parameters_changed", "halt", "parameters_changed"))
        << "the component receives the defaults";
    EXPECT_EQ(in_words(world["navigation"].changed_to), "time_limit=0 routing_policy=time");
    desk.bind("navigation");
    EXPECT_EQ(in_words(desk.get_parameter("navigation").parameters), "time_limit=0 routing_policy=time");
    desk.release("navigation");
    EXPECT_EQ(world["navigation"].calls.back(), "halt") << "without a change there is no call";
}

TEST(Parameters, AreTheDefaultsAgainAfterASession) {
    for (auto const* end : {"disconnect", "link lost", "ended by the engine"}) {
        World world{navigation, speech};
        auto desk = std::string{end} == "link lost" ? world.connect_without_link() : world.connect();
        for (auto const* ref : {"navigation", "speech"}) desk.bind(ref);
        desk.execute(go("go"), say("say"));
        desk.set_parameter("speech", {integer("volume", 10)});
        if (std::string{end} == "disconnect") desk.leave();
        if (std::string{end} == "link lost") world.advance(10min);
        if (std::string{end} == "ended by the engine") world.engine->end(desk.session, world.now);
        EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt", "parameters_changed")) << end;
        auto hall = world.connect();
        for (auto const* ref : {"navigation", "speech"}) hall.bind(ref);
        EXPECT_EQ(in_words(hall.get_parameter("navigation").parameters), "time_limit=0 routing_policy=time") << end;
        EXPECT_EQ(in_words(hall.get_parameter("speech").parameters), "synthesizable_languages=en|ja volume=50 language=en")
            << end;
        for (auto const* ref : {"navigation", "speech"})
            EXPECT_EQ(hall.execute(start(ref)).return_code, ReturnCode::bad_parameter) << end << ": its mandatory value is unset";
    }
}

TEST(Parameters, OfCommandsThatRunOnStayUntilTheNextBinding) {
    EngineSettings settings;
    settings.on_session_end = OnSessionEnd::continue_;
    World world{{navigation, speech}, settings};
    auto desk = world.connect();
    for (auto const* ref : {"navigation", "speech"}) desk.bind(ref);
    desk.execute(set("speech", {text("speech_text", "I have arrived")}), go("go"), start("speech"));
    desk.leave();
    auto hall = world.connect();
    EXPECT_EQ(in_words(hall.query("get_parameter", equal("name", "speech")).results.parameters),
              "synthesizable_languages=en|ja volume=50 language=en");
    world["navigation"].finishes();
    EXPECT_EQ(in_words(world["speech"].started_with), "speech_text=I have arrived volume=50 language=en");
    hall.bind("speech");
    EXPECT_EQ(in_words(hall.get_parameter("speech").parameters), "synthesizable_languages=en|ja volume=50 language=en");
    EXPECT_EQ(hall.execute(start("speech")).return_code, ReturnCode::bad_parameter);
}

TEST(Parameters, OfAnApplicationAreReadByItAlone) {
    World world{speech, detection};
    auto desk = world.connect(), hall = world.connect();
    desk.bind("speech");
    desk.set_parameter("speech", {text("speech_text", "a secret"), integer("volume", 10)});
    auto const read = [](Application& who) {
        return in_words(who.query("get_parameter", equal("name", "speech")).results.parameters);
    };
    EXPECT_EQ(read(desk), "synthesizable_languages=en|ja speech_text=a secret volume=10 language=en");
    EXPECT_EQ(read(hall), "synthesizable_languages=en|ja volume=50 language=en") << "read-only parameters, and the defaults";
    for (auto const& condition :
         {equal("Property/volume", "10"), equal("Property/speech_text", "a secret"), like("Property/speech_text", "*")}) {
        EXPECT_THAT(desk.search(condition), ElementsAre("speech"));
        EXPECT_THAT(hall.search(condition), IsEmpty());
        EXPECT_EQ(hall.bind_any(condition), "OUT_OF_RESOURCES");
        EXPECT_EQ(hall.query("component_status", condition).return_code, ReturnCode::unsupported);
        EXPECT_THAT(hall.ask(GetProfile{condition}).components, IsEmpty());
    }
    EXPECT_THAT(hall.search(equal("Property/volume", "50")), ElementsAre("speech"));
}

TEST(Parameters, OfAnApplicationDecideOnlyWhichEventsItReceives) {
    World world{detection_with_threshold()};
    auto desk = world.connect(), hall = world.connect();
    desk.bind("detection");
    for (auto* application : {&desk, &hall}) application->subscribe("person_detected", equal("Property/threshold", "70"), true);
    desk.set_parameter("detection", {integer("threshold", 70)});
    desk.received();
    world["detection"].fires("person_detected", {integer("number", 1)});
    EXPECT_THAT(desk.received(), ElementsAre("2 person_detected detection number=1"));
    EXPECT_THAT(hall.received(), IsEmpty());
}

// A component may report a value that an application has set (its volume, say), as well as read-only ones.
TEST(Parameters, ThatCanBeSetAreNotReadFromTheComponentForOthers) {
    World world{speech};
    auto desk = world.connect(), hall = world.connect();
    world["speech"].reads = {text("speech_text", "still in memory"), texts("synthesizable_languages", {"en"})};
    desk.bind("speech");
    EXPECT_THAT(in_words(desk.get_parameter("speech").parameters), HasSubstr("still in memory"));
    EXPECT_EQ(in_words(hall.query("get_parameter").results.parameters), "synthesizable_languages=en volume=50 language=en");
}

TEST(Parameters, OfAComponentWithoutParametersAreEmpty) {
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
    EXPECT_THAT(world["speech"].calls, ElementsAre("start", "parameters_changed"));
    EXPECT_EQ(desk.result_of("say"), "RUNNING");
}

}  // namespace rois
