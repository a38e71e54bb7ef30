#include <cmath>
#include <numbers>

#include "choosing/team.hpp"

namespace rois::choosing::test {

namespace {

using testing::Contains;
using testing::Not;

// A person, as a unit reports them.
struct Seen {
    std::string name;
    int x = 0;
    int y = 0;
};

// A codebook of its own for each unit.
ParameterList list_of(std::string const& unit, std::vector<Seen> const& persons) {
    std::vector<std::string> names, points;
    for (auto const& [name, x, y] : persons) {
        names.push_back(name);
        points.push_back(std::to_string(x) + ", " + std::to_string(y));
    }
    return {date_time("timestamp", {}), references("person_ref", std::move(names), "urn:" + unit),
            positions("position_data", std::move(points), "")};
}

class TwoEyes : public testing::Test {
protected:
    TwoEyes() {
        team.world.change({}, {in_engine("robot1", localization), in_engine("robot2", localization),
                               in_engine("robot1", detection), in_engine("robot2", detection)});
        world.advance(100ms);
    }

    void watch() {
        ASSERT_EQ(desk.bind("localization"), ReturnCode::ok);
        desk.subscribe("person_localized", {}, true);
        desk.execute(named("watch", start("localization")));
        ASSERT_EQ(desk.result_of("watch"), "OK");
        desk.received();
    }
    ScriptedComponent& eye(std::string const& robot) { return world[robot + ".localization"]; }
    void sees(std::string const& robot, std::vector<Seen> const& persons) {
        eye(robot).fires("person_localized", list_of(robot, persons));
    }
    // Both units report four times a second.
    void see(std::vector<Seen> const& first, std::vector<Seen> const& second, std::chrono::milliseconds duration) {
        for (; duration.count() > 0; duration -= 250ms) {
            sees("robot1", first);
            sees("robot2", second);
            world.advance(250ms);
        }
    }
    // The persons of the last event.
    std::vector<std::string> names() {
        desk.received();
        auto const event = desk.last_received<ReceiveEvent>();
        return find(event.results->parameters, "person_ref")->values;
    }

    Team team{{"robot1", "robot2"}};
    World& world = team.world;
    Application desk = world.connect();
};

}  // namespace

TEST_F(TwoEyes, StartAllFreeMembers) {
    auto other = world.connect();
    other.bind("robot2.localization");
    world.advance(300ms);
    watch();
    EXPECT_THAT(eye("robot1").calls, Contains("start"));
    EXPECT_THAT(eye("robot2").calls, Not(Contains("start")));
    other.release("robot2.localization");
    world.advance(300ms);
    EXPECT_THAT(eye("robot2").calls, Contains("start")) << "it is free now";
}

TEST_F(TwoEyes, StartAMemberThatComesLater) {
    world.change({"robot2.localization"}, {});
    watch();
    world.change({}, {in_engine("robot2", localization)});
    world.advance(300ms);
    EXPECT_THAT(eye("robot2").calls, Contains("start"));
}

TEST_F(TwoEyes, GoOnWithoutOneThatIsLost) {
    watch();
    eye("robot1").halts_later = true;
    eye("robot1").status_now = ComponentStatus::error;
    team.look();
    desk.execute(named("stop", stop("localization")));
    team.look();
    EXPECT_EQ(desk.result_of("stop"), "OK");
    desk.execute(named("again", start("localization")));
    EXPECT_EQ(desk.result_of("again"), "OK");
    EXPECT_EQ(std::ranges::count(eye("robot2").calls, "start"), 2);
}

TEST_F(TwoEyes, GoOnWithoutOneThatIsFoundLostAfterTheStop) {
    watch();
    eye("robot1").halts_later = true;
    desk.execute(named("stop", stop("localization")));
    EXPECT_EQ(desk.result_of("stop"), "RUNNING");
    eye("robot1").status_now = ComponentStatus::error;
    world.advance(3s);
    team.look();
    desk.execute(named("again", start("localization")));
    world.advance(1s);
    EXPECT_EQ(desk.result_of("again"), "OK");
}

TEST_F(TwoEyes, KeepTheNameOfAPersonWhoStandsWhileNobodyAsks) {
    watch();
    see({{"p", 1'000, 2'000}}, {{"q", 1'020, 1'990}, {"r", 6'000, 2'000}}, 2s);
    auto const before = names();
    ASSERT_THAT(before, testing::SizeIs(2));
    desk.execute(stop("localization"));
    world.advance(20s);
    desk.execute(start("localization"));
    see({{"p", 1'000, 2'000}}, {{"q", 1'020, 1'990}, {"r", 6'000, 2'000}}, 2s);
    EXPECT_EQ(names(), before);
}

TEST_F(TwoEyes, ReportTheHeadingOfTheLastMeasurement) {
    watch();
    for (int i = 0; i < 8; ++i) {
        auto list = list_of("robot1", {{"p", 1'000, 2'000}});
        list[2].values = {"1000, 2000, 90"};
        Located const located{.of = "position_data",
                              .ref = "p",
                              .crs = "",
                              .position = {1'000, 2'000, 0},
                              .orientation = {0, 0, 90},
                              .certainty = Located::Covariance{{2'500, 0, 0, 0, 2'500, 0, 0, 0, 64}}};
        eye("robot1").fires("person_localized", list, {located});
        world.advance(250ms);
    }
    names();
    auto const event = desk.last_received<ReceiveEvent>();
    EXPECT_THAT(find(event.results->parameters, "position_data")->values, ElementsAre(testing::EndsWith(", 90")));
    auto const& located = event.results->located.at(0);
    EXPECT_THAT(located.orientation, ElementsAre(0, 0, 90));
    EXPECT_THAT(std::get<Located::Covariance>(located.certainty).rows, testing::SizeIs(9));
}

TEST_F(TwoEyes, SeeOnePersonWithTwoNamesAsOne) {
    watch();
    see({{"tall", 1'000, 2'000}}, {{"person-7", 1'020, 1'990}}, 2s);
    EXPECT_THAT(names(), ElementsAre("person-1"));
    auto const event = desk.last_received<ReceiveEvent>();
    EXPECT_EQ(event.component_ref.code, "localization");
    EXPECT_EQ(find(event.results->parameters, "person_ref")->data_type_ref.codebook_ref, fused_codebook);
    ASSERT_EQ(event.results->located.size(), 1u);
    EXPECT_NEAR(event.results->located.front().position[0], 1'010, 30);
}

TEST_F(TwoEyes, SeeTwoPersonsWithOneNameAsTwo) {
    watch();
    see({{"person-1", 1'000, 2'000}}, {{"person-1", 6'000, 2'000}}, 2s);
    EXPECT_THAT(names(), ElementsAre("person-1", "person-2"));
}

TEST_F(TwoEyes, KeepTheNameOfAPersonWhoWalksFromOneViewIntoTheOther) {
    watch();
    for (int x = 0; x <= 6'000; x += 250) {
        std::vector<Seen> const first = x < 4'000 ? std::vector<Seen>{{"a", x, 0}} : std::vector<Seen>{};
        std::vector<Seen> const second = x > 2'000 ? std::vector<Seen>{{"b", x, 0}} : std::vector<Seen>{};
        see(first, second, 250ms);
    }
    EXPECT_THAT(names(), ElementsAre("person-1"));
}

TEST_F(TwoEyes, ForgetAPersonWhomNobodySees) {
    watch();
    see({{"a", 0, 0}}, {{"b", 0, 0}}, 2s);
    see({}, {}, 2s);
    EXPECT_THAT(names(), IsEmpty());
    see({{"c", 0, 0}}, {}, 2s);
    EXPECT_THAT(names(), ElementsAre("person-1")) << "the name lasts five seconds";
    see({}, {}, 7s);
    see({{"d", 0, 0}}, {}, 2s);
    EXPECT_THAT(names(), ElementsAre("person-2"));
}

TEST_F(TwoEyes, LoseThePersonsOfAUnitThatLeaves) {
    watch();
    see({{"a", 0, 0}}, {{"b", 5'000, 0}}, 2s);
    EXPECT_THAT(names(), ElementsAre("person-1", "person-2"));
    world.change({"robot2.localization"}, {});
    sees("robot1", {{"a", 0, 0}});
    world.advance(2s);
    sees("robot1", {{"a", 0, 0}});
    world.advance(300ms);
    EXPECT_THAT(names(), ElementsAre("person-1"));
}

TEST_F(TwoEyes, StopAndFreeAllMembers) {
    watch();
    desk.execute(named("stop", stop("localization")));
    EXPECT_EQ(desk.result_of("stop"), "OK");
    EXPECT_THAT(eye("robot1").calls, Contains("halt"));
    desk.received();
    sees("robot1", {{"a", 0, 0}});
    world.advance(2s);
    EXPECT_THAT(desk.received(), Not(Contains(HasSubstr("person_localized"))));
    desk.release("localization");
    auto other = world.connect();
    EXPECT_EQ(other.bind("robot1.localization"), ReturnCode::ok);
    EXPECT_EQ(other.bind("robot2.localization"), ReturnCode::ok);
}

TEST_F(TwoEyes, CountTheGreatestNumberWithoutPositions) {
    desk.bind("detection");
    desk.subscribe("person_detected", {}, true);
    desk.execute(named("count", start("detection")));
    desk.received();
    world["robot1.detection"].fires("person_detected", {date_time("timestamp", {}), integer("number", 2)});
    world["robot2.detection"].fires("person_detected", {date_time("timestamp", {}), integer("number", 1)});
    auto const events = desk.received();
    ASSERT_EQ(events.size(), 1u);
    EXPECT_THAT(events.front(), HasSubstr("number=2"));
}

TEST_F(TwoEyes, ReportEachNumberOnceAlsoZero) {
    desk.bind("detection");
    desk.subscribe("person_detected", {}, true);
    desk.execute(named("count", start("detection")));
    desk.received();
    std::string numbers;
    auto const detect = [&](std::string const& robot, int number) {
        world[robot + ".detection"].fires("person_detected", {date_time("timestamp", {}), integer("number", number)});
        for (auto const& words : desk.received())
            if (auto const at = words.find("number="); at != words.npos) numbers += words.substr(at + 7, 1);
    };
    detect("robot1", 1);
    detect("robot2", 1);
    detect("robot1", 0);
    EXPECT_EQ(numbers, "1") << "robot2 still detects somebody";
    detect("robot2", 0);
    detect("robot1", 0);
    EXPECT_EQ(numbers, "10");
}

TEST_F(TwoEyes, IgnoreAnEventWithoutANumber) {
    desk.bind("detection");
    desk.subscribe("person_detected", {}, true);
    desk.execute(named("count", start("detection")));
    desk.received();
    world["robot1.detection"].fires("person_detected");
    EXPECT_THAT(desk.received(), IsEmpty());
    world["robot1.detection"].fires("person_detected", {date_time("timestamp", {}), integer("number", 2)});
    EXPECT_EQ(desk.received().size(), 1u);
}

TEST_F(TwoEyes, CountPersonsWithPositionsOnce) {
    watch();
    desk.bind("detection");
    desk.subscribe("person_detected", {}, true);
    desk.execute(named("count", start("detection")));
    see({{"a", 0, 0}}, {{"b", 20, 0}, {"c", 4'000, 0}}, 2s);
    world["robot1.detection"].fires("person_detected", {date_time("timestamp", {}), integer("number", 1)});
    std::string last;
    for (auto const& words : desk.received())
        if (words.find("person_detected") != words.npos) last = words;
    EXPECT_THAT(last, HasSubstr("number=2"));
}

TEST_F(TwoEyes, FailIfNoMemberStarts) {
    eye("robot1").throws_in = eye("robot2").throws_in = {"start"};
    desk.bind("localization");
    desk.execute(named("watch", start("localization")));
    EXPECT_EQ(desk.result_of("watch"), "ERROR");
    auto other = world.connect();
    EXPECT_EQ(other.bind("robot1.localization"), ReturnCode::ok) << "nothing was kept";
}

TEST_F(TwoEyes, ReportAWrongListOnce) {
    watch();
    for (int i = 0; i < 3; ++i) see({{"a", 1'000, 0}, {"a", 5'000, 0}}, {}, 250ms);
    auto const errors = [&] {
        auto const received = desk.received();
        return std::ranges::count_if(received,
                                     [](auto const& each) { return each.find("USER_DEFINED_ERROR localization") != each.npos; });
    };
    EXPECT_EQ(errors(), 1);
    see({{"a", 1'000, 0}}, {}, 250ms);
    EXPECT_EQ(errors(), 0);
    see({{"a", 1'000, 0}, {"a", 5'000, 0}}, {}, 250ms);
    EXPECT_EQ(errors(), 1);
}

TEST_F(TwoEyes, WarnOfAUnitThatIsTurned) {
    watch();
    constexpr double turn = 10 * std::numbers::pi / 180;
    for (int i = 0; i < 4 * 90; ++i) {
        std::vector<Seen> right, turned;
        for (int person = 0; person < 4; ++person) {
            double const time = i / 4.0 + 17 * person;
            double const x = 4'000 + 2'500 * std::sin(time / (3 + person)), y = 2'500 * std::cos(time / (4 + person));
            right.push_back({"a" + std::to_string(person), static_cast<int>(x), static_cast<int>(y)});
            turned.push_back({"b" + std::to_string(person), static_cast<int>(x * std::cos(turn) - y * std::sin(turn)),
                              static_cast<int>(x * std::sin(turn) + y * std::cos(turn))});
        }
        see(right, turned, 250ms);
    }
    EXPECT_EQ(desk.status_of("localization"), "WARNING");
    EXPECT_THAT(desk.received(), Contains(HasSubstr("USER_DEFINED_ERROR localization")));
}

// --- Events of several units ---

namespace {

// A recognizer of speech; here the component named `detection`.
Part recognizer(std::string const& robot) {
    auto part = in_engine(robot, named("detection", desk_lamp));
    part.profile.parameters.clear();
    part.profile.messages = {
        {.kind = MessageKind::event,
         .name = "speech_recognized",
         .results =
             {{.name = "timestamp", .data_type_ref = {"DateTime", {}, {}, {}}, .default_value = {}, .description = {}},
              {.name = "recognized_text", .data_type_ref = {"string[]", {}, {}, {}}, .default_value = {}, .description = {}}},
         .arguments = {},
         .timeout = {}}};
    part.on_start = OnStart::becomes_active;
    return part;
}

}  // namespace

class TwoEars : public TwoEyes {
protected:
    TwoEars() {
        world.change({"robot1.detection", "robot2.detection"}, {recognizer("robot1"), recognizer("robot2")});
        world.advance(300ms);
        desk.bind("detection");
        desk.subscribe("speech_recognized", {}, true);
        desk.execute(named("listen", start("detection")));
        desk.received();
    }
    void hears(std::string const& robot, std::string const& words) {
        world[robot + ".detection"].fires("speech_recognized",
                                          {date_time("timestamp", world.now.utc), texts("recognized_text", {words})});
    }
    std::size_t heard() {
        auto const all = desk.received();
        return static_cast<std::size_t>(
            std::ranges::count_if(all, [](auto const& words) { return words.find("speech_recognized") != words.npos; }));
    }
};

TEST_F(TwoEars, HearOneSentenceOnce) {
    hears("robot1", "hello");
    world.advance(500ms);
    hears("robot2", "hello");
    EXPECT_EQ(heard(), 1u);
    hears("robot1", "goodbye");
    EXPECT_EQ(heard(), 1u);
    world.advance(2s);
    hears("robot2", "goodbye");
    EXPECT_EQ(heard(), 1u) << "another sentence with the same words";
}

TEST_F(TwoEars, DoNotHearTheOwnRobots) {
    desk.bind("speech");
    desk.execute(say("hello"));
    hears("robot2", "hello");
    hears("robot1", "wait");
    EXPECT_EQ(heard(), 1u) << "robot1 speaks, and knows its own words";
    world["robot1.speech"].finishes();
    world.advance(1s);
    hears("robot2", "hello");
    EXPECT_EQ(heard(), 0u);
    world.advance(1s);
    hears("robot2", "hello");
    EXPECT_EQ(heard(), 1u);
}

// --- Names that travel down again ---

namespace {

Part follower(std::string const& robot) {
    auto part = in_engine(robot, named("navigation", desk_lamp));
    part.profile.parameters = {{.name = "target_object_ref",
                                .data_type_ref = {.code = "RoISIdentifier", .authority = {}, .codebook_ref = {}, .version = {}},
                                .default_value = {},
                                .description = {}}};
    part.codebooks = {{"target_object_ref", {"urn:" + robot}}};
    part.mandatory = {{"target_object_ref"}};
    part.on_start = OnStart::acts;
    return part;
}

}  // namespace

TEST_F(TwoEyes, GiveAFollowerItsOwnNameOfThePerson) {
    world.change({"robot1.navigation", "robot2.navigation"}, {follower("robot1"), follower("robot2")});
    watch();
    see({{"tall", 1'000, 0}}, {{"person-7", 1'000, 0}}, 2s);
    desk.bind("navigation");
    desk.execute(named("follow", start("navigation", {reference("target_object_ref", "person-1")})));
    EXPECT_EQ(desk.result_of("follow"), "RUNNING") << desk.reason_of("follow");
    EXPECT_EQ(in_words(world["robot1.navigation"].started_with), "target_object_ref=tall");
    EXPECT_EQ(world["robot1.navigation"].started_with.front().data_type_ref.codebook_ref, "urn:robot1");
}

TEST_F(TwoEyes, ChooseAFollowerThatSensesThePerson) {
    world.change({"robot1.navigation", "robot2.navigation"}, {follower("robot1"), follower("robot2")});
    watch();
    see({}, {{"person-7", 1'000, 0}}, 2s);
    desk.bind("navigation");
    desk.execute(named("follow", start("navigation", {reference("target_object_ref", "person-1")})));
    EXPECT_EQ(in_words(world["robot2.navigation"].started_with), "target_object_ref=person-7");
    auto const unknown = desk.execute(named("nobody", start("navigation", {reference("target_object_ref", "person-9")})));
    EXPECT_EQ(unknown.return_code, ReturnCode::error);
    EXPECT_THAT(unknown.reason, HasSubstr("does not sense the target"));
}

}  // namespace rois::choosing::test
