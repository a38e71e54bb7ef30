#include "simulation/world_stage.hpp"

#include <gtest/gtest.h>

namespace rois::simulation {
namespace {

using Kind = Happening::Kind;

// The times and texts of people's happenings of one kind.
std::vector<std::pair<Seconds, std::string>> of_people(Hall const& hall, Kind kind) {
    std::vector<std::pair<Seconds, std::string>> found;
    for (Happening const& happening : hall.chronicle().since(0))
        if (happening.kind == kind && std::holds_alternative<PersonId>(happening.who))
            found.emplace_back(in_seconds(happening.at), happening.text);
    return found;
}

bool left(Hall const& hall) { return !of_people(hall, Kind::left).empty(); }

TEST(Visitor, PlaysTheRoleAndLeaves) {
    Role role = tanaka({{Walk{{"desk"}}, {}},
                        {Face{{"robot1"}}, {}},
                        {Say{"en", "Hello, I am Tanaka."}, {}},
                        {Gesture{"wave"}, {}},
                        {Leave{}, {}}});
    role.enters = 2;
    Hall hall{plain_hall(), only(role), 1};
    run(hall, 1.9);
    EXPECT_TRUE(hall.people().empty());
    ASSERT_TRUE(runs_until(hall, 1, [&] { return !hall.people().empty(); }));
    EXPECT_EQ(hall.people()[0].role, "tanaka");
    ASSERT_TRUE(runs_until(hall, 30, [&] { return hall.people()[0].speaking.has_value(); }));
    EXPECT_LT(distance(hall.people()[0].pose.position, Point{5, 7}), 0.1);
    EXPECT_NEAR(bearing(hall.people()[0].pose, Point{2, 4}), 0, from_degrees(6));
    ASSERT_TRUE(runs_until(hall, 60, [&] { return left(hall); }));
    EXPECT_TRUE(hall.people().empty());
    auto const begun = of_people(hall, Kind::speech_started), ended = of_people(hall, Kind::speech_finished);
    ASSERT_EQ(begun.size(), 1u);
    ASSERT_EQ(ended.size(), 1u);
    EXPECT_EQ(ended[0].second, "Hello, I am Tanaka.");
    EXPECT_NEAR(ended[0].first - begun[0].first, speech_duration("Hello, I am Tanaka."), 0.02);
    EXPECT_EQ(of_people(hall, Kind::gesture_made).at(0).second, "wave");
}

TEST(Visitor, AnActionWaitsForItsTime) {
    Hall hall{plain_hall(), only(tanaka({{Say{"en", "Now."}, 7.0}})), 1};
    ASSERT_TRUE(runs_until(hall, 20, [&] { return !of_people(hall, Kind::speech_started).empty(); }));
    EXPECT_NEAR(of_people(hall, Kind::speech_started)[0].first, 7.02, 0.03);
}

// Stands in front of the robot, looks at it, and gives this answer to its speech or bow.
Role answering(std::vector<Answer> answers) {
    return tanaka({{Walk{{Point{4, 4}}}, {}}, {Face{{"robot1"}}, {}}, {Wait{60}, {}}}, std::move(answers));
}

TEST(Visitor, AnswersWhatTheRobotSays) {
    Hall hall{plain_hall(),
              only(answering({{"NAME", "", "en", "I am Tanaka.", "", false}, {"*", "", "en", "Pardon?", "shake_head", true}})),
              1};
    run(hall, 10);
    hall.speak(robot1, said("What is your name?"));
    EXPECT_TRUE(of_people(hall, Kind::speech_started).empty()) << "not before the end of the speech";
    run(hall, 4);
    ASSERT_EQ(of_people(hall, Kind::speech_started).size(), 1u);
    EXPECT_EQ(of_people(hall, Kind::speech_started)[0].second, "I am Tanaka.");
    for (int i = 0; i < 2; ++i) {
        hall.speak(robot1, said("Nice weather."));
        run(hall, 4);
    }
    ASSERT_EQ(of_people(hall, Kind::speech_started).size(), 2u) << "asks only once";
    EXPECT_EQ(of_people(hall, Kind::speech_started)[1].second, "Pardon?");
    EXPECT_EQ(of_people(hall, Kind::gesture_made).size(), 1u);
}

TEST(Visitor, AnswersAReaction) {
    Hall hall{plain_hall(), only(answering({{"", "9", "", "", "bow", false}})), 1};
    run(hall, 10);
    hall.show(robot1, "28", 2);
    run(hall, 3);
    EXPECT_TRUE(of_people(hall, Kind::gesture_made).empty());
    hall.show(robot1, "9", 2);
    run(hall, 3);
    ASSERT_EQ(of_people(hall, Kind::gesture_made).size(), 1u);
    EXPECT_EQ(of_people(hall, Kind::gesture_made)[0].second, "bow");
}

TEST(Visitor, AnswersSpeechAndTheBowThatFollowsAtOnce) {
    Hall hall{plain_hall(), only(answering({{"*", "", "en", "Thank you.", "", true}, {"", "9", "", "", "bow", true}})), 1};
    run(hall, 10);
    auto const greet = [&] {
        hall.speak(robot1, said("Your meeting is in room 3.", 0.5, 1.0));
        run(hall, 1.02);
        hall.show(robot1, "9", 2);
        run(hall, 6);
    };
    greet();
    ASSERT_EQ(of_people(hall, Kind::speech_started).size(), 1u);
    ASSERT_EQ(of_people(hall, Kind::gesture_made).size(), 1u);
    EXPECT_GE(of_people(hall, Kind::gesture_made)[0].first, of_people(hall, Kind::speech_finished)[0].first);
    greet();
    EXPECT_EQ(of_people(hall, Kind::speech_started).size(), 1u) << "`once` allows one answer";
    EXPECT_EQ(of_people(hall, Kind::gesture_made).size(), 1u);
}

TEST(Visitor, KeepsEightAnswersInMindAtMost) {
    Hall hall{plain_hall(), only(answering({{"*", "", "en", "I am sorry, I do not understand you at all.", "", false}})), 1};
    run(hall, 10);
    for (int i = 0; i < 20; ++i) {
        hall.speak(robot1, said("Quick.", 0.5, 0.1));
        run(hall, 0.12);
    }
    run(hall, 60);
    EXPECT_GE(of_people(hall, Kind::speech_started).size(), 8u);
    EXPECT_LE(of_people(hall, Kind::speech_started).size(), 9u);
}

TEST(Visitor, DoesNotAnswerALowVoiceOrOneThatIsBrokenOff) {
    Hall hall{plain_hall(), only(answering({{"*", "", "en", "Yes?", "", false}})), 1};
    run(hall, 10);
    hall.speak(robot1, said("Hello.", 0.02));
    run(hall, 4);
    auto const speech = hall.speak(robot1, said("Hello.", 0.5, 5.0));
    run(hall, 1);
    hall.break_off(robot1, speech);
    run(hall, 4);
    EXPECT_TRUE(of_people(hall, Kind::speech_started).empty());
}

TEST(Visitor, DoesNotAnswerAnIgnoredRobot) {
    Role role = answering({{"*", "", "en", "Yes?", "", false}});
    role.actions.insert(role.actions.begin() + 2, {Ignore{}, {}});
    Hall hall{plain_hall(), only(role), 1};
    run(hall, 10);
    hall.speak(robot1, said("Hello."));
    run(hall, 4);
    EXPECT_TRUE(of_people(hall, Kind::speech_started).empty());
}

TEST(Visitor, StaysForARobotThatAttendsToThemButNotForEver) {
    std::vector<ScriptedAction> const actions{{Walk{{Point{3.5, 4}}}, {}}, {Face{{"robot1"}}, {}}, {Wait{10}, {}}, {Leave{}, {}}};
    FloorPlan attending = plain_hall(), away = plain_hall();
    away.robots[0].start.heading = from_degrees(180);
    Hall with{attending, only(tanaka(actions)), 1}, without{away, only(tanaka(actions)), 1};
    ASSERT_TRUE(runs_until(without, 90, [&] { return left(without); }));
    ASSERT_TRUE(runs_until(with, 180, [&] { return left(with); }));
    EXPECT_GT(with.now() - without.now(), WorldTime{10'000});
    EXPECT_LT(with.now() - without.now(), WorldTime{30'000});
}

TEST(Visitor, WaitsOnTheWayForARobotThatComesUp) {
    Hall hall{plain_hall(), only(tanaka({{Wander{120}, {}}})), 3};
    run(hall, 4);
    PersonId const id = hall.people()[0].id;
    auto const follow = hall.drive(robot1).begin("follow", KeepDistance{entity_id(id), 1.0});
    EXPECT_TRUE(runs_until(hall, 60,
                           [&] {
                               Person const* person = hall.person(id);
                               bool const near = distance(person->pose.position, hall.robot(robot1).pose.position) < 1.1;
                               return near && person->velocity.isZero() &&
                                      std::abs(bearing(person->pose, hall.robot(robot1).pose.position)) < from_degrees(10);
                           }))
        << "stands and looks at it, state " << static_cast<int>(state(hall, robot1, *follow));
}

TEST(Visitor, SharesAPlaceWithOthers) {
    Role first = tanaka({{Walk{{"desk"}}, {}}, {Wait{60}, {}}}), second = first;
    second.id = "suzuki";
    Hall hall{plain_hall(), {"two", {}, {first, second}, {}, {}}, 1};
    run(hall, 20);
    ASSERT_EQ(hall.people().size(), 2u);
    EXPECT_GE(distance(hall.people()[0].pose.position, hall.people()[1].pose.position), 2 * person_radius);
    for (Person const& person : hall.people()) EXPECT_LT(distance(person.pose.position, Point{5, 7}), 1.0);
}

TEST(Scenarios, RoundsRepeatWithoutDuplicatePeople) {
    Role brief = tanaka({{Wait{5}, {}}}), lasting = tanaka({{Walk{{"desk"}}, {}}, {Wait{150}, {}}});
    lasting.id = "suzuki";
    lasting.enters = 10;
    Hall hall{plain_hall(), {"rounds", {}, {brief, lasting}, 60.0, {}}, 1};
    run(hall, 301);
    int brief_visits = 0, lasting_visits = 0;
    for (Happening const& happening : hall.chronicle().since(0)) {
        if (happening.kind != Kind::entered) continue;
        ++(std::fmod(in_seconds(happening.at), 60) < 5 ? brief_visits : lasting_visits);
    }
    EXPECT_EQ(brief_visits, 6);
    EXPECT_EQ(lasting_visits, 2);
}

TEST(Scenarios, StrangersComeWithinTheGaps) {
    Scenario scenario;
    scenario.arrivals = Arrivals{10, 20, 100};
    Hall hall{shipped_plan("reception-hall.xml"), scenario, 5};
    run(hall, 600);
    Seconds before = 0;
    for (auto const& [at, text] : of_people(hall, Kind::entered)) {
        EXPECT_GE(at - before, 9.98);
        EXPECT_LE(at - before, 21.5) << "the entrance may be occupied for a moment";
        before = at;
    }
    EXPECT_GT(of_people(hall, Kind::entered).size(), 25u);
}

TEST(Scenarios, StrangersStayAwayFromAFullHall) {
    Scenario scenario;
    scenario.arrivals = Arrivals{1, 2, 3};
    Hall hall{shipped_plan("reception-hall.xml"), scenario, 5};
    EXPECT_FALSE(runs_until(hall, 300, [&] { return hall.people().size() > 3; }));
    EXPECT_EQ(hall.people().size(), 3u);
}

}  // namespace
}  // namespace rois::simulation
