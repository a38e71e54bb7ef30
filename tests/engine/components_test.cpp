// Components that are added and removed while sessions are open, and user-defined components.

#include <stdexcept>

#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

// A blinking lamp: a user-defined component with messages of its own.
Part blinking_lamp() {
    auto const parameter = [](std::string name, std::string type, std::optional<std::string> default_value) {
        return ParameterProfile{.name = std::move(name),
                                .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = {}, .version = {}},
                                .default_value = std::move(default_value),
                                .description = {}};
    };
    Part lamp = named("blinker", desk_lamp);
    lamp.profile.object.identifier = "urn:x-rois:def:component:test::Blinker";
    lamp.profile.parameters = {parameter("colours", "String[]", "red green")};
    lamp.profile.messages = {{.kind = MessageKind::command,
                              .name = "blink",
                              .results = {parameter("times", "int", {})},
                              .arguments = {parameter("pattern", "int[]", {}), parameter("brightness", "double", "0.5")},
                              .timeout = {}},
                             {.kind = MessageKind::event,
                              .name = "blinked",
                              .results = {parameter("times", "Integer", {})},
                              .arguments = {},
                              .timeout = {}}};
    return lamp;
}

Parameter pattern(std::string numbers) { return value("pattern", "INT[]", {std::move(numbers)}); }

}  // namespace

TEST(Component, RefMustNotBeginOrEndWithWhiteSpace) {
    EXPECT_THROW(World({named(" lamp", desk_lamp)}), std::runtime_error);
    EXPECT_THROW(World({named("lamp\n", desk_lamp)}), std::runtime_error);
    EXPECT_NO_THROW(World({named("desk lamp", desk_lamp)}));
}

TEST(UserDefined, CommandsAreCheckedAgainstTheirProfile) {
    World world{blinking_lamp()};
    auto desk = world.connect();
    desk.bind("blinker");
    auto const reason = [&](ParameterList const& arguments) {
        return desk.execute(command("blink", "blinker", arguments)).reason;
    };
    EXPECT_THAT(reason({}), HasSubstr("the argument 'pattern' is missing"));
    EXPECT_THAT(reason({value("pattern", "string", {"1"})}), HasSubstr("'pattern' is declared as 'string', its type is int[]"));
    EXPECT_THAT(reason({pattern("1 x")}), HasSubstr("'x' is not of the type int"));
    EXPECT_THAT(reason({pattern("1"), pattern("2")}), HasSubstr("'pattern' is given twice"));
    EXPECT_THAT(reason({pattern("1"), integer("speed", 3)}),
                HasSubstr("unknown parameter 'speed'; expected one of pattern, brightness"));
    EXPECT_THAT(desk.execute(command("burn", "blinker")).reason, HasSubstr("it has blink, start, stop"));
    EXPECT_THAT(desk.received(), IsEmpty());
}

TEST(UserDefined, CommandsGetTheDefaultsOfTheirProfile) {
    World world{blinking_lamp()};
    auto desk = world.connect();
    desk.bind("blinker");
    desk.execute(named("b", command("blink", "blinker", {value("PATTERN", "INT[]", {"1 2"})})));
    EXPECT_EQ(in_words(world["blinker"].started_with), "pattern=1 2 brightness=0.5");
    world["blinker"].finishes(CompletedStatus::ok, {{integer("times", 2)}, {}});
    EXPECT_EQ(desk.result_of("b"), "OK times=2");
    EXPECT_EQ(in_words(desk.get_parameter("blinker").parameters), "colours=red|green");
}

TEST(UserDefined, StartTakesTheArgumentsOfItsProfile) {
    auto lamp = blinking_lamp();
    ParameterProfile const times{.name = "times",
                                 .data_type_ref = {.code = "int", .authority = {}, .codebook_ref = {}, .version = {}},
                                 .default_value = {},
                                 .description = {}};
    auto slowly = times;
    slowly.name = "slowly";
    slowly.default_value = "1";
    lamp.profile.messages.push_back(
        {.kind = MessageKind::command, .name = "start", .results = {}, .arguments = {times, slowly}, .timeout = {}});
    World world{lamp};
    auto desk = world.connect();
    desk.bind("blinker");
    EXPECT_THAT(desk.execute(start("blinker")).reason, HasSubstr("the argument 'times' is missing"));
    EXPECT_THAT(desk.execute(start("blinker", {text("times", "often")})).reason, HasSubstr("its type is int"));
    EXPECT_THAT(desk.execute(start("blinker", {integer("speed", 3)})).reason,
                HasSubstr("unknown parameter 'speed'; expected one of times, slowly, colours"));
    EXPECT_EQ(desk.execute(start("blinker", {integer("times", 3), value("colours", "string[]", {"blue"})})).return_code,
              ReturnCode::ok);
    EXPECT_EQ(in_words(world["blinker"].started_with), "times=3 slowly=1 colours=blue");
    EXPECT_EQ(in_words(desk.get_parameter("blinker").parameters), "colours=blue") << "arguments are not stored";
    EXPECT_EQ(desk.set_parameter("blinker", {integer("times", 3)}).return_code, ReturnCode::bad_parameter);
}

TEST(UserDefined, ReturnsReadableParametersAsItsProfileDeclaresThem) {
    auto const with = [](std::string name, std::string type, std::optional<std::string> default_value) {
        auto part = named("speech", speech);
        part.profile.messages = {
            {.kind = MessageKind::query,
             .name = "get_parameter",
             .results = {{.name = "mood",
                          .data_type_ref = {.code = "string[]", .authority = {}, .codebook_ref = {}, .version = {}},
                          .default_value = {},
                          .description = {}}},
             .arguments = {},
             .timeout = {}}};
        part.profile.parameters = {
            {.name = std::move(name),
             .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = {}, .version = {}},
             .default_value = std::move(default_value),
             .description = {}}};
        return part;
    };
    {
        World world{with("Synthesizable_Languages", "string[]", {})};
        auto desk = world.connect();
        desk.bind("speech");
        EXPECT_EQ(in_words(desk.get_parameter("speech").parameters), "Synthesizable_Languages=en|ja");
        desk.set_parameter("speech", {value("synthesizable_languages", "string[]", {"de"})});
        EXPECT_EQ(in_words(desk.get_parameter("speech").parameters), "Synthesizable_Languages=de") << "the stored value, once";
    }
    World world{with("synthesizable_languages", "int", {})};
    auto desk = world.connect();
    desk.bind("speech");
    EXPECT_EQ(desk.get_parameter("speech").return_code, ReturnCode::error);
    EXPECT_EQ(desk.status_of("speech"), "ERROR");
    EXPECT_EQ(world.engine->statistics().errors, 1U) << "reported when its parameters arrived";
}

TEST(UserDefined, EventsAndResultsAreCheckedAgainstTheirProfile) {
    World world{blinking_lamp()};
    auto desk = world.connect();
    desk.bind("blinker");
    desk.subscribe("blinked");
    world["blinker"].fires("blinked", {integer("times", 3)});
    world["blinker"].fires("blinked", {text("times", "often")});
    desk.execute(named("b", command("blink", "blinker", {pattern("1")})));
    world["blinker"].finishes(CompletedStatus::ok, {{text("times", "often")}, {}});
    EXPECT_THAT(desk.received(), ElementsAre("1 blinked blinker", "2 COMPONENT_INTERNAL_ERROR blinker", "3 completed b ERROR",
                                             "4 COMPONENT_INTERNAL_ERROR blinker"));
}

TEST(UserDefined, ProfilesAreServedWithTheMessagesThatTheyInclude) {
    World world{blinking_lamp()};
    auto desk = world.connect();
    auto const profile = desk.ask(GetProfile{}).components.at(0).profile;
    EXPECT_THAT(profile->sub_components, ElementsAre("urn:x-rois:def:component:OMG::RoISCommon"));
    for (auto const* name : {"blink", "start", "stop", "suspend", "resume", "set_parameter"})
        EXPECT_NE(find_message(*profile, MessageKind::command, name), nullptr) << name;
    EXPECT_NE(find_message(*profile, MessageKind::query, "component_status"), nullptr);
    EXPECT_NE(find_message(*profile, MessageKind::query, "get_parameter"), nullptr);
}

class ComingAndGoing : public testing::Test {
protected:
    World world{navigation, speech};
    Application desk = world.connect();
};

TEST_F(ComingAndGoing, NotifiesAllSessionsOnce) {
    auto hall = world.connect();
    world.change({"speech"}, {detection, named("lamp2", desk_lamp)});
    EXPECT_THAT(desk.received(), ElementsAre("1 profile_changed"));
    EXPECT_THAT(hall.received(), ElementsAre("1 profile_changed"));
    EXPECT_THAT(desk.search(), ElementsAre("detection", "lamp2", "navigation"));
    auto const profile = desk.ask(GetProfile{}).profile;
    EXPECT_THAT(profile->components, ElementsAre("navigation", "detection", "lamp2"));
    world.change({}, {});
    EXPECT_THAT(desk.received(), IsEmpty()) << "nothing changed";
}

TEST_F(ComingAndGoing, LeavesAProfileThatIsBeingReadUnchanged) {
    auto const before = world.engine->profile();
    world.change({"speech"}, {});
    EXPECT_THAT(before->components, ElementsAre("navigation", "speech"));
    EXPECT_THAT(world.engine->profile()->components, ElementsAre("navigation"));
}

TEST_F(ComingAndGoing, OfTheLastComponentOfASubEngineEndsIt) {
    world.change({}, {in_engine("sub1", detection)});
    ASSERT_EQ(world.engine->profile()->sub_profiles.size(), 1U);
    EXPECT_EQ(world.engine->profile()->sub_profiles.front().object.name, "sub1");
    world.change({"sub1.detection"}, {});
    EXPECT_THAT(world.engine->profile()->sub_profiles, IsEmpty());
}

TEST_F(ComingAndGoing, AbortsRunningAndWaitingCommands) {
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(in_parallel({in_sequence({go("go"), say("greet")}), in_sequence({say("wait"), go("back")})}));
    EXPECT_THAT(desk.received(), IsEmpty());
    world.change({"navigation"}, {});
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed greet ABORT", "3 profile_changed"));
    world["speech"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("4 completed wait OK", "5 completed back ABORT"));
    EXPECT_EQ(desk.result_of("go"), "ABORT") << "its result is still known";
}

TEST_F(ComingAndGoing, EndsCommandsOfTheComponentsOwnProfileToo) {
    desk.bind("navigation");
    desk.execute(named("dock", command("dock", "navigation")));
    world.change({"navigation"}, {});
    EXPECT_THAT(desk.received(), ElementsAre("1 completed dock ABORT", "2 profile_changed"));
    world.advance(std::chrono::seconds{2});
    EXPECT_THAT(desk.received(), IsEmpty()) << "the command has ended";
}

TEST_F(ComingAndGoing, EndsCommandsWithoutASession) {
    EngineSettings settings;
    settings.on_session_end = OnSessionEnd::continue_;
    World lasting{{navigation}, settings};
    auto visitor = lasting.connect();
    visitor.bind("navigation");
    visitor.execute(go("go"));
    visitor.leave();
    auto stays = lasting.connect();
    lasting.change({"navigation"}, {});
    EXPECT_EQ(lasting.engine->statistics().commands_completed[static_cast<std::size_t>(CompletedStatus::abort)], 1U);
    EXPECT_THAT(stays.received(), ElementsAre("1 profile_changed"));
}

TEST_F(ComingAndGoing, LosesBindingsAndKeepsSubscriptions) {
    world.change({}, {detection});
    desk.bind("detection");
    auto const subscription = desk.subscribe("person_detected");
    ParameterList const one{date_time("timestamp", world.now.utc), integer("number", 1)};
    world["detection"].fires("person_detected", one);
    world.change({"detection"}, {});
    EXPECT_EQ(desk.bind("detection"), ReturnCode::bad_parameter);
    EXPECT_EQ(desk.subscribe("person_detected").return_code, ReturnCode::unsupported);
    world.change({}, {detection});
    auto hall = world.connect();
    EXPECT_EQ(hall.bind("detection"), ReturnCode::ok) << "it is not bound any more";
    world["detection"].fires("person_detected", one);
    EXPECT_THAT(desk.received(), ElementsAre("1 profile_changed", "2 person_detected detection", "3 person_detected detection"));
    EXPECT_EQ(desk.last_received<ReceiveEvent>().subscribe_id, subscription.subscribe_id);
}

TEST_F(ComingAndGoing, IsReportedOnceASecond) {
    for (int i = 0; i < 10; ++i) {
        world.change({}, {detection});
        world.change({"detection"}, {});
    }
    EXPECT_THAT(desk.received(), ElementsAre("1 profile_changed"));
    world.advance(950ms);
    EXPECT_THAT(desk.received(), IsEmpty());
    world.advance(50ms);
    EXPECT_THAT(desk.received(), ElementsAre("2 profile_changed")) << "the later changes";
    world.advance(5s);
    EXPECT_THAT(desk.received(), IsEmpty());
}

TEST_F(ComingAndGoing, OfASubEngineGivesItFrameAndInstance) {
    world.change({}, {in_engine("hall.robot1", navigation)});
    auto const values_of = [](EngineProfile const& engine) {
        std::vector<std::string> values;
        for (auto const& parameter : engine.parameters)
            values.push_back(parameter.name + "=" + parameter.default_value.value_or(""));
        return values;
    };
    auto const& hall = world.engine->profile()->sub_profiles.back();
    EXPECT_THAT(values_of(hall), ElementsAre("crs=crs1", "instance=instance1.hall"));
    EXPECT_THAT(values_of(hall.sub_profiles.front()), ElementsAre("crs=crs1", "instance=instance1.hall.robot1"));
}

TEST_F(ComingAndGoing, HasTheEnginesFrameInTheProfileOfItsPositions) {
    world.engine->describe({.frames = {"hall"}, .all = {}});
    auto located = navigation;
    located.positions = {"target_position"};
    world.change({"navigation"}, {located});
    auto const frame_of = [&](std::string_view name) {
        for (auto const& entry : world.engine->components())
            for (auto const& parameter : entry.profile->parameters)
                if (entry.ref == "navigation" && parameter.name == name) return parameter.data_type_ref.codebook_ref;
        return std::string{"there is none"};
    };
    EXPECT_EQ(frame_of("target_position"), "hall");
    EXPECT_EQ(frame_of("time_limit"), "");
}

TEST_F(ComingAndGoing, OfANestedSubEngineIsInItsSubProfile) {
    auto const named_engines = [&] {
        std::vector<std::string> names;
        std::function<void(EngineProfile const&)> const collect = [&](EngineProfile const& engine) {
            names.push_back(engine.object.name);
            for (auto const& sub : engine.sub_profiles) collect(sub);
        };
        collect(*world.engine->profile());
        return names;
    };
    auto const before = named_engines();
    world.change({}, {in_engine("hall.robot1", navigation), in_engine("hall.robot2", navigation), in_engine("hall", speech)});
    auto const* hall = &world.engine->profile()->sub_profiles.back();
    EXPECT_EQ(hall->object.name, "hall");
    EXPECT_THAT(hall->components, ElementsAre("hall.speech"));
    ASSERT_EQ(hall->sub_profiles.size(), 2U);
    EXPECT_EQ(hall->sub_profiles.front().object.name, "hall.robot1");
    EXPECT_THAT(hall->sub_profiles.front().components, ElementsAre("hall.robot1.navigation"));
    world.change({"hall.robot2.navigation", "hall.speech"}, {});
    hall = &world.engine->profile()->sub_profiles.back();
    EXPECT_THAT(hall->components, IsEmpty()) << "it stays, because a sub engine of it does";
    EXPECT_EQ(hall->sub_profiles.size(), 1U);
    world.change({"hall.robot1.navigation"}, {});
    EXPECT_EQ(named_engines(), before);
}

TEST_F(ComingAndGoing, BringsFramesAndPlacesThatLeaveAgain) {
    world.engine->describe({.frames = {"hall"}, .all = {}});
    auto const change_of = [](std::string provider, Belongings belongings) {
        belongings.profiles = {};
        return ComponentChange{{}, {}, std::move(belongings), std::move(provider)};
    };
    Belongings belongings{
        .profiles = {},
        .frames = {{.crs = "map", .base = "hall", .position = {1'000, 0, 0}, .orientation = {}, .covariance = {}}},
        .places = {{"lift", box(0, 0, 1'000, 1'000, "map")}}};
    world.engine->change(change_of("robot1", belongings), world.now);
    auto const at_the_lift = [&] { return desk.ask(Search{within("location", literal("lift"))}).return_code; };
    EXPECT_EQ(at_the_lift(), ReturnCode::ok);
    EXPECT_ANY_THROW(world.engine->change(change_of("robot2", belongings), world.now)) << "they are known already";
    world.engine->change(change_of("robot1", belongings), world.now);
    EXPECT_EQ(at_the_lift(), ReturnCode::ok) << "replaced";
    world.engine->change(change_of("robot1", {}), world.now);
    world.engine->change(change_of("robot2", belongings), world.now);
    EXPECT_EQ(at_the_lift(), ReturnCode::ok);
}

TEST_F(ComingAndGoing, LeavesOutFramesAndPlacesOfASubEngineThatAreKnown) {
    world.engine->describe({.frames = {"hall"}, .all = {{"desk", box(0, 0, 1, 1, "hall")}}});
    auto const frame = [](std::string crs, std::string base) {
        return Frame{
            .crs = std::move(crs), .base = std::move(base), .position = {1'000, 0, 0}, .orientation = {}, .covariance = {}};
    };
    auto const change = [&](std::string provider, Space space) {
        Belongings belongings;
        belongings.space = std::move(space);
        return world.engine->change({{}, {}, std::move(belongings), std::move(provider)}, world.now);
    };
    Space const space{{frame("map", "hall"), frame("cart", "map")}, {{"lift", box(0, 0, 1, 1, "cart")}}};
    auto const at_the_lift = [&] { return desk.ask(Search{within("location", literal("lift"))}).return_code; };
    EXPECT_THAT(change("robot1", space), IsEmpty());
    EXPECT_EQ(at_the_lift(), ReturnCode::ok);
    EXPECT_THAT(change("robot2", space),
                ElementsAre("the frame 'map' is given twice", "the frame 'cart' is in the frame 'map', which is left out",
                            "the place 'lift' is in the frame 'cart', which is left out"));
    EXPECT_THAT(change("robot3", {{}, {{"desk", box(0, 0, 1, 1, "hall")}}}),
                ElementsAre("there are two places with the name 'desk'"));
    EXPECT_THAT(change("robot1", {}), IsEmpty());
    EXPECT_EQ(at_the_lift(), ReturnCode::ok) << "that of robot2";
    change("robot2", {});
    EXPECT_EQ(at_the_lift(), ReturnCode::bad_parameter);
}

TEST_F(ComingAndGoing, KeepsTheDetailsOfEarlierEvents) {
    world.change({}, {detection});
    desk.subscribe("person_detected");
    world["detection"].fires("person_detected", {date_time("timestamp", world.now.utc), integer("number", 1)});
    desk.received();
    auto const event = desk.last_received<ReceiveEvent>().event_id;
    world.change({"detection"}, {});
    EXPECT_EQ(desk.detail_of(event, equal("number", "1")).results.parameters.size(), 2U);
    EXPECT_EQ(desk.detail_of(event, equal("colour", "red")).return_code, ReturnCode::bad_parameter);
}

TEST_F(ComingAndGoing, DoesNotGiveAnOldCommandTheNewComponent) {
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(in_sequence({say("greet"), go("go")}));
    world.change({"navigation"}, {navigation});
    desk.bind("navigation");
    world["speech"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("1 profile_changed", "2 completed greet OK", "3 completed go ABORT"));
    EXPECT_THAT(world["navigation"].calls, ElementsAre("halt"));
}

TEST_F(ComingAndGoing, HappensWholeOrNotAtAll) {
    auto const try_to = [&](std::vector<std::string> const& going, std::vector<Part> const& coming) {
        try {
            world.change(going, coming);
            return std::string{"it was done"};
        } catch (std::runtime_error const& error) {
            return std::string{error.what()};
        }
    };
    Part lost = detection;
    lost.profile.sub_components = {"urn:nowhere"};
    EXPECT_THAT(try_to({"speech"}, {lost}), HasSubstr("'urn:nowhere'"));
    EXPECT_THAT(try_to({"speech", "lamp"}, {}), HasSubstr("unknown component 'lamp'"));
    EXPECT_THAT(try_to({"speech"}, {navigation}), HasSubstr("two components with the ref 'navigation'"));
    EXPECT_THAT(try_to({}, {detection, detection}), HasSubstr("two components with the ref 'detection'"));
    EXPECT_THAT(desk.search(), ElementsAre("navigation", "speech"));
    EXPECT_THAT(desk.received(), IsEmpty());
    EXPECT_EQ(try_to({"speech"}, {speech}), "it was done");
}

}  // namespace rois
