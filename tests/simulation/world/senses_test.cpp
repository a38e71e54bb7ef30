#include "simulation/robot/senses.hpp"

#include "simulation/world_stage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rois::simulation {
namespace {

// Walks to a point, looks to another one, and stays.
Role staying(Point const& p, Whereabouts const& looks_at) {
    return tanaka({{Walk{{p}}, {}}, {Face{looks_at}, {}}, {Wait{3'600}, {}}});
}

// A hall with tanaka, who stays.
std::unique_ptr<Hall> hall_with(FloorPlan const& plan, Role role) {
    auto hall = std::make_unique<Hall>(plan, only(std::move(role)), 1);
    run(*hall, 15);
    return hall;
}

TEST(PeopleSeen, AreInRangeViewAndSight) {
    EXPECT_EQ(people_seen(*hall_with(plain_hall(), staying(Point{6, 4}, {"robot1"})), robot1).size(), 1u);
    FloorPlan short_sighted = plain_hall();
    short_sighted.robots[0].sensors.people.range = 3;
    EXPECT_TRUE(people_seen(*hall_with(short_sighted, staying(Point{6, 4}, {"robot1"})), robot1).empty());
    FloorPlan looks_away = plain_hall();
    looks_away.robots[0].start.heading = from_degrees(125);
    EXPECT_TRUE(people_seen(*hall_with(looks_away, staying(Point{6, 4}, {"robot1"})), robot1).empty());
    EXPECT_TRUE(people_seen(*hall_with(divided_hall(), staying(Point{7, 3}, {"robot1"})), robot1).empty());
}

TEST(PeopleSeen, AreMeasuredWithTheStatedNoise) {
    auto const hall = hall_with(plain_hall(), staying(Point{6, 4}, {"robot1"}));
    Pose const truth = hall->people()[0].pose;
    double sum = 0, squares = 0, turned = 0;
    constexpr int count = 2'000;
    for (int i = 0; i < count; ++i) {
        hall->step();
        auto const seen = people_seen(*hall, robot1);
        ASSERT_EQ(seen.size(), 1u);
        double const off = seen[0].pose.position.x() - truth.position.x();
        sum += off;
        squares += off * off;
        turned += std::pow(wrapped(seen[0].pose.heading - truth.heading), 2);
    }
    Covariance const stated = people_seen(*hall, robot1)[0].covariance;
    EXPECT_NEAR(sum / count, 0, 0.005);
    EXPECT_NEAR(squares / count, stated(0, 0), stated(0, 0) * 0.15);
    EXPECT_NEAR(turned / count, stated(2, 2), stated(2, 2) * 0.15);
}

TEST(PeopleSeen, AreTheSameForAllCallsInAStep) {
    auto const hall = hall_with(plain_hall(), staying(Point{6, 4}, {"robot1"}));
    auto const one = people_seen(*hall, robot1), other = people_seen(*hall, robot1);
    EXPECT_EQ(one[0].pose.position, other[0].pose.position);
    hall->step();
    EXPECT_NE(one[0].pose.position, people_seen(*hall, robot1)[0].pose.position);
}

TEST(Tracks, KeepTheirNameWhileSeenAndALittleLonger) {
    FloorPlan plan = divided_hall();
    // Passes behind the door: is hidden from the robot for a moment, then for long.
    Role role = tanaka({{Walk{{Point{8, 7.3}}}, {}},
                        {Wait{4}, {}},
                        {Walk{{Point{6, 1}}}, {}},
                        {Wait{30}, {}},
                        {Walk{{Point{8, 7.3}}}, {}},
                        {Wait{99}, {}}});
    plan.robots[0].start = {Point{2, 7}, 0};
    Hall hall{plan, only(role), 1};
    ASSERT_TRUE(runs_until(hall, 15, [&] { return hall.find("person-1").has_value(); }));
    PersonId const who = std::get<PersonId>(*hall.find("person-1"));
    EXPECT_EQ(hall.track(who), "person-1");
    ASSERT_TRUE(runs_until(hall, 30, [&] { return people_seen(hall, robot1).empty(); }));
    EXPECT_EQ(hall.track(who), "person-1") << "hidden for a moment";
    ASSERT_TRUE(runs_until(hall, 6, [&] { return !hall.track(who); }));
    EXPECT_FALSE(hall.find("person-1"));
    ASSERT_TRUE(runs_until(hall, 60, [&] { return hall.track(who).has_value(); }));
    EXPECT_EQ(hall.track(who), "person-2") << "the same person after being lost";
}

TEST(Tracks, APermanentIdIsKnownForAsLongAsTheTemporaryName) {
    FloorPlan plan = divided_hall();
    plan.robots[0].start = {Point{4, 7}, 0};
    // Is identified in the door, goes behind the wall, and comes back facing away from the robot.
    Hall hall{plan,
              only(tanaka({{Walk{{Point{6, 7}}}, {}},
                           {Face{{"robot1"}}, {}},
                           {Wait{2}, {}},
                           {Walk{{Point{6, 1}}}, {}},
                           {Ignore{}, {}},
                           {Wait{20}, {}},
                           {Walk{{Point{6, 7}}}, {}},
                           {Face{{Point{6, 9}}}, {}},
                           {Wait{99}, {}}})),
              1};
    ASSERT_TRUE(runs_until(hall, 20, [&] { return hall.find("tanaka").has_value(); }));
    ASSERT_TRUE(runs_until(hall, 30, [&] { return people_seen(hall, robot1).empty(); }));
    EXPECT_TRUE(hall.find("tanaka")) << "hidden for a moment";
    ASSERT_TRUE(runs_until(hall, 10, [&] { return !hall.find("person-1"); }));
    EXPECT_FALSE(hall.find("tanaka")) << "no sensor has seen them for long";
}

TEST(PeopleRecognized, AreNearAndTurnedToTheRobot) {
    auto const near = hall_with(plain_hall(), staying(Point{4, 4}, {"robot1"}));
    auto const recognized = people_recognized(*near, robot1);
    ASSERT_EQ(recognized.size(), 1u);
    EXPECT_EQ(recognized[0].id, "tanaka");
    EXPECT_EQ(recognized[0].track, "person-1");
    EXPECT_EQ(near->find("tanaka"), near->find("person-1"));
    auto const far = hall_with(plain_hall(), staying(Point{6, 4}, {"robot1"}));
    EXPECT_TRUE(people_recognized(*far, robot1).empty());
    EXPECT_FALSE(far->find("tanaka")) << "no robot has identified them";
    EXPECT_TRUE(people_recognized(*hall_with(plain_hall(), staying(Point{4, 4}, {Point{8, 4}})), robot1).empty());
}

TEST(PeopleRecognized, HaveNoPermanentIdIfTheyAreStrangers) {
    Role role = staying(Point{4, 4}, {"robot1"});
    role.known = false;
    auto const hall = hall_with(plain_hall(), role);
    auto const recognized = people_recognized(*hall, robot1);
    ASSERT_EQ(recognized.size(), 1u);
    EXPECT_FALSE(recognized[0].id);
    EXPECT_EQ(recognized[0].track, "person-1");
    EXPECT_FALSE(hall->find("tanaka"));
}

TEST(SoundsHeard, IncludeOtherRobotsButNotTheRobotItself) {
    Hall hall{hall_with_two_robots(), nobody(), 1};
    hall.speak(robot2, said("Hello."));
    auto const heard = sounds_heard(hall, robot1);
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0].ref, "sound-robot2");
    EXPECT_EQ(heard[0].who, entity_id(robot2));
    EXPECT_TRUE(sounds_heard(hall, robot2).empty());
}

TEST(Hearing, IsHalvedByAWall) {
    Hall const open{plain_hall(), nobody(), 1}, divided{divided_hall(), nobody(), 1};
    EXPECT_TRUE(hears(open, robot1, Point{8, 4}));
    EXPECT_FALSE(hears(divided, robot1, Point{8, 4}));
    EXPECT_TRUE(hears(divided, robot1, Point{5.5, 4}));
}

TEST(Gestures, AreSeenInView) {
    Hall const hall{divided_hall(), nobody(), 1};
    EXPECT_TRUE(sees_gesture(hall, robot1, Point{4, 4}));
    EXPECT_FALSE(sees_gesture(hall, robot1, Point{1, 4})) << "behind it";
    EXPECT_FALSE(sees_gesture(hall, robot1, Point{6, 4})) << "behind the wall";
}

TEST(References, NameRobotsPlacesAndPositions) {
    Hall hall{hall_with_two_robots(), nobody(), 1};
    EXPECT_EQ(hall.find("robot2"), Entity{robot2});
    EXPECT_FALSE(hall.find("robot3"));
    EXPECT_FALSE(hall.find("person-1"));
    ASSERT_TRUE(hall.target("desk"));
    EXPECT_EQ(hall.target("desk")->position, Point(5, 7));
    EXPECT_EQ(hall.target("1000, 2000")->position, Point(1, 2));
    EXPECT_FALSE(hall.target("garden"));
}

}  // namespace
}  // namespace rois::simulation
