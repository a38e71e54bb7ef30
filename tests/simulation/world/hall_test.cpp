#include "simulation/world/random.hpp"
#include "simulation/world_stage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rois::simulation {
namespace {

// The shipped day, with busy robots.
void set_to_work(Hall& hall) {
    for (Robot const& robot : hall.robots()) {
        hall.drive(robot.id).begin("navigation",
                                   GoTo{{{Point{9, 4}, {}}, {Point{12, 8}, {}}, {Point{4, 4}, {}}, {Point{9, 2}, {}}}});
        hall.speak(robot.id, said("Welcome to the reception.", 0.8));
    }
}

TEST(Hall, TheSameSeedGivesTheSameHistoryHoweverTimeIsCut) {
    FloorPlan const plan = shipped_plan("two-robots.xml");
    Scenario const day = reception_day(plan);
    Hall at_once{plan, day, 42}, in_pieces{plan, day, 42};
    set_to_work(at_once);
    set_to_work(in_pieces);
    at_once.advance(WorldTime{400'000});
    Random random{1};
    for (WorldTime until{0}; until < WorldTime{400'000};) {
        until = std::min(WorldTime{400'000}, until + WorldTime{static_cast<WorldTime::rep>(random.below(3'000))});
        in_pieces.advance(until);
    }
    EXPECT_EQ(observed(at_once), observed(in_pieces));
    EXPECT_EQ(at_once.now(), WorldTime{400'000});
}

TEST(Hall, AnotherSeedGivesAnotherHistory) {
    FloorPlan const plan = shipped_plan("reception-hall.xml");
    Hall one{plan, reception_day(plan), 1}, other{plan, reception_day(plan), 2};
    one.advance(WorldTime{120'000});
    other.advance(WorldTime{120'000});
    EXPECT_NE(observed(one), observed(other));
}

TEST(Hall, AdvancesByWholeStepsOnly) {
    Hall hall{plain_hall(), nobody(), 1};
    hall.advance(WorldTime{59});
    EXPECT_EQ(hall.now(), WorldTime{40});
    hall.advance(WorldTime{60});
    EXPECT_EQ(hall.now(), WorldTime{60});
    hall.advance(WorldTime{10});
    EXPECT_EQ(hall.now(), WorldTime{60});
}

TEST(Hall, RefusesAPlanWithAFlaw) {
    FloorPlan plan = plain_hall();
    plan.places.clear();
    EXPECT_THROW((Hall{plan, nobody(), 1}), std::invalid_argument);
    plan = plain_hall();
    plan.robots.clear();
    EXPECT_THROW((Hall{plan, nobody(), 1}), std::invalid_argument);
    plan = hall_with_two_robots();
    plan.robots[1].start = plan.robots[0].start;
    EXPECT_THROW((Hall{plan, nobody(), 1}), std::invalid_argument);
}

TEST(FloorPlan, WallsBlockSightAndDesksDoNot) {
    FloorPlan plan = divided_hall();
    plan.desks = {{Point{6.5, 1}, Point{7.5, 3}}};
    EXPECT_FALSE(plan.in_sight(Point{2, 2}, Point{8, 2}));
    EXPECT_TRUE(plan.in_sight(Point{2, 7}, Point{8, 7}));
    EXPECT_TRUE(plan.in_sight(Point{6, 2}, Point{8, 2}));
}

// More than twenty minutes of the shipped day, with robots that drive to and fro among the people.
class LongRun : public testing::TestWithParam<char const*> {};
TEST_P(LongRun, PeopleAndRobotsNeverTouchWallsOrEachOther) {
    FloorPlan const plan = shipped_plan(GetParam());
    Hall hall{plan, reception_day(plan), 11};
    Random random{3};
    std::vector<MotionId> motions(hall.robots().size());
    Metres people_to_walls = 9, robots_to_walls = 9, people_apart = 9, robots_apart = 9, person_to_robot = 9;
    std::vector<Twist> before(hall.robots().size());
    runs_until(hall, 1'200, [&] {
        for (Robot const& robot : hall.robots()) {
            auto const i = static_cast<std::size_t>(robot.id);
            Drive& drive = hall.drive(robot.id);
            if (drive.owner().empty() || random.chance(0.0005)) {
                Place const& place = plan.places[random.below(plan.places.size())];
                motions[i] = *drive.begin("navigation", GoTo{{{place.pose.position, place.pose.heading}},
                                                             random.chance(0.5) ? RoutingPolicy::time : RoutingPolicy::distance});
            }
            EXPECT_LE(std::abs(robot.twist.linear - before[i].linear), drive.plan().max_acceleration * 0.02 + 1e-9);
            before[i] = robot.twist;
            robots_to_walls = std::min(robots_to_walls, plan.clearance(robot.pose.position) - drive.plan().radius);
            for (Robot const& other : hall.robots())
                if (other.id < robot.id)
                    robots_apart = std::min(robots_apart, distance(other.pose.position, robot.pose.position));
        }
        for (Person const& person : hall.people()) {
            people_to_walls = std::min(people_to_walls, plan.clearance(person.pose.position));
            for (Robot const& robot : hall.robots())
                person_to_robot = std::min(person_to_robot, distance(person.pose.position, robot.pose.position));
            for (Person const& other : hall.people())
                if (other.id < person.id)
                    people_apart = std::min(people_apart, distance(other.pose.position, person.pose.position));
        }
        return testing::Test::HasFailure();
    });
    EXPECT_GE(people_to_walls, person_radius - 1e-6);
    EXPECT_GE(robots_to_walls, 0);
    EXPECT_GE(people_apart, 2 * person_radius);
    EXPECT_GE(robots_apart, 2 * 0.28);
    EXPECT_GE(person_to_robot, person_radius + 0.28);
}
INSTANTIATE_TEST_SUITE_P(Shipped, LongRun, testing::Values("reception-hall.xml", "two-robots.xml"));

TEST(ShippedDay, VisitorsComeSoonAndRepeatedly) {
    FloorPlan const plan = shipped_plan("reception-hall.xml");
    Hall hall{plan, reception_day(plan), 1};
    std::vector<Seconds> entries;
    std::size_t most = 0;
    std::map<PersonId, Seconds> looked_at;  // how long somebody stood and looked at the robot
    std::uint64_t read = 0;
    runs_until(hall, 1'800, [&] {
        for (Happening const& happening : hall.chronicle().since(read)) {
            read = happening.sequence;
            if (happening.kind == Happening::Kind::entered) entries.push_back(in_seconds(happening.at));
        }
        most = std::max(most, hall.people().size());
        for (Person const& person : hall.people()) {
            bool const looks = std::abs(bearing(person.pose, hall.robot(robot1).pose.position)) < from_degrees(20);
            if (looks && person.velocity.isZero()) looked_at[person.id] += 0.02;
        }
        return false;
    });
    ASSERT_GT(entries.size(), 45u);
    EXPECT_LE(entries[0], 2);
    for (std::size_t i = 1; i < entries.size(); ++i) EXPECT_LE(entries[i] - entries[i - 1], 60) << "after " << entries[i - 1];
    EXPECT_LE(most, 8u);
    auto const patient = std::ranges::count_if(looked_at, [](auto const& each) { return each.second > 60; });
    EXPECT_GT(patient, 10) << "many stand long enough to be received";
}

TEST(ShippedDay, ARobotCanReceiveTanaka) {
    FloorPlan const plan = shipped_plan("reception-hall.xml");
    Hall hall{plan, reception_day(plan), 1};
    ASSERT_TRUE(runs_until(hall, 20, [&] { return !hall.people().empty() && hall.people()[0].pose.position.y() > 7; }));
    auto const go = hall.drive(robot1).begin("navigation", GoTo{{{hall.people()[0].pose.position, {}}}});
    ASSERT_TRUE(runs_until(hall, 60, [&] { return over(state(hall, robot1, *go)); }));
    EXPECT_EQ(state(hall, robot1, *go), MotionState::arrived);
    ASSERT_TRUE(runs_until(hall, 5, [&] { return hall.find("tanaka").has_value(); })) << "identified";
    hall.speak(robot1, said("Your meeting is in room 3."));
    auto thanked = [](Happening const& happening) {
        return happening.kind == Happening::Kind::speech_started && happening.text == "Thank you very much.";
    };
    EXPECT_TRUE(runs_until(hall, 20, [&] { return std::ranges::any_of(hall.chronicle().since(0), thanked); }));
}

TEST(Voice, AnUtteranceEndsByItselfInTheWorldsTime) {
    Hall hall{plain_hall(), nobody(), 1};
    auto const speech = hall.speak(robot1, said("Good morning.", 0.5, 2.0));
    EXPECT_TRUE(hall.robot(robot1).speaking);
    run(hall, 1.9);
    EXPECT_EQ(hall.speech_state(robot1, speech), SpeechState::speaking);
    run(hall, 0.1);
    EXPECT_EQ(hall.speech_state(robot1, speech), SpeechState::spoken);
    EXPECT_FALSE(hall.robot(robot1).speaking);
}

TEST(Voice, IsSilentWhileHeldAndSaysTheRestAfterwards) {
    Hall hall{plain_hall(), nobody(), 1};
    auto const speech = hall.speak(robot1, said("Good morning.", 0.5, 2.0));
    run(hall, 1);
    hall.hold_speech(robot1, speech);
    EXPECT_FALSE(hall.robot(robot1).speaking);
    run(hall, 10);
    EXPECT_EQ(hall.speech_state(robot1, speech), SpeechState::held);
    hall.go_on_speaking(robot1, speech);
    run(hall, 0.9);
    EXPECT_EQ(hall.speech_state(robot1, speech), SpeechState::speaking);
    run(hall, 0.2);
    EXPECT_EQ(hall.speech_state(robot1, speech), SpeechState::spoken);
}

TEST(Voice, ANewUtteranceBreaksTheOldOne) {
    Hall hall{plain_hall(), nobody(), 1};
    auto const first = hall.speak(robot1, said("Good morning.", 0.5, 2.0));
    auto const second = hall.speak(robot1, said("Stop.", 0.5, 1.0));
    EXPECT_EQ(hall.speech_state(robot1, first), SpeechState::broken);
    hall.break_off(robot1, first);
    EXPECT_EQ(hall.speech_state(robot1, second), SpeechState::speaking);
    std::vector<Happening::Kind> kinds;
    for (Happening const& happening : hall.chronicle().since(0)) kinds.push_back(happening.kind);
    using Kind = Happening::Kind;
    EXPECT_THAT(kinds, testing::ElementsAre(Kind::speech_started, Kind::speech_broken, Kind::speech_started));
}

TEST(Speech, TakesAsLongAsItsText) {
    EXPECT_DOUBLE_EQ(speech_duration("Hi"), 0.5);
    EXPECT_NEAR(speech_duration("Welcome to the reception."), 1.6, 0.1);
    EXPECT_NEAR(speech_duration("こんにちは。"), 0.9, 0.05);
    EXPECT_GT(speech_duration("Grüße"), speech_duration("Gruß") - 1e-9);
}

TEST(Chronicle, IsReadByPositionAndKeepsTheLast) {
    Chronicle chronicle;
    for (std::uint64_t i = 1; i <= Chronicle::capacity + 10; ++i) chronicle.add({0, WorldTime{i}, {}, robot1, {}, {}, {}, 0, {}});
    EXPECT_EQ(chronicle.last(), Chronicle::capacity + 10);
    EXPECT_EQ(chronicle.since(0).front().sequence, 11u) << "the oldest are gone";
    EXPECT_EQ(chronicle.since(0).size(), Chronicle::capacity);
    auto const news = chronicle.since(Chronicle::capacity + 8);
    ASSERT_EQ(news.size(), 2u);
    EXPECT_EQ(news.front().sequence, Chronicle::capacity + 9);
    EXPECT_TRUE(chronicle.since(chronicle.last()).empty());
    EXPECT_TRUE(chronicle.since(chronicle.last() + 5).empty());
}

}  // namespace
}  // namespace rois::simulation
