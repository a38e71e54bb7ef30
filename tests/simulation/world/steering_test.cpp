// Steered visitors.
#include "simulation/scenario/steering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/world_stage.hpp"

namespace rois::simulation {
namespace {

using Kind = Happening::Kind;
using State = OrderStatus::State;
using testing::ElementsAre;
using testing::HasSubstr;

Role called(std::string name) {
    Role role;
    role.id = std::move(name);
    role.language = "de";
    return role;
}

Way to(Point const& where, std::optional<Radians> heading = {}) { return {{Target{where, heading}}}; }

bool ends(Hall& hall, SharedOrderStatus const& status, Seconds at_most = 60) {
    return runs_until(hall, at_most, [&] { return status->state != State::running; });
}

// A hall with one steered visitor.
struct Steered : testing::Test {
    Hall hall{plain_hall(), nobody(), 1};

    void SetUp() override {
        ASSERT_TRUE(ends(hall, hall.let_in(called("anna"))));
        ASSERT_EQ(hall.people().size(), 1u);
    }
    Person const& anna() { return hall.people()[0]; }
    std::vector<std::string> reported(Kind kind) {
        std::vector<std::string> texts;
        for (Happening const& happening : hall.chronicle().since(0))
            if (happening.kind == kind) texts.push_back(happening.text + happening.language);
        return texts;
    }
};

TEST_F(Steered, ComesInByTheEntranceAndStays) {
    EXPECT_EQ(anna().role, "anna");
    EXPECT_TRUE(is_steered(anna().id));
    EXPECT_EQ(anna().pose.position, Point(9, 4));
    run(hall, 300);
    EXPECT_EQ(anna().pose.position, Point(9, 4));
}

TEST_F(Steered, GoesFromOneTargetToTheNext) {
    auto const status = hall.steer("anna", Way{{Target{{7, 2}, {}}, Target{{5, 6}, from_degrees(-90)}}});
    ASSERT_TRUE(runs_until(hall, 10, [&] { return distance(anna().pose.position, {7, 2}) < 0.1; }));
    EXPECT_EQ(status->state, State::running);
    ASSERT_TRUE(ends(hall, status));
    EXPECT_EQ(status->state, State::done);
    EXPECT_LT(distance(anna().pose.position, {5, 6}), 0.1);
    run(hall, 1);
    EXPECT_NEAR(anna().pose.heading, from_degrees(-90), 0.01);
}

TEST_F(Steered, SpeaksAndGesturesWhileGoing) {
    auto const goes = hall.steer("anna", to({2, 7}));
    auto const first = hall.steer("anna", Say{"", "Guten Tag."}), second = hall.steer("anna", Say{"en", "Good day."});
    auto const waves = hall.steer("anna", Gesture{"wave"});
    hall.step();
    EXPECT_EQ(anna().speaking->text, "Guten Tag.");
    EXPECT_EQ(anna().gesturing->id, "wave");
    EXPECT_FALSE(anna().velocity.isZero());
    ASSERT_TRUE(ends(hall, second));
    ASSERT_TRUE(ends(hall, waves));
    EXPECT_EQ(first->state, State::done);
    EXPECT_EQ(waves->state, State::done);
    EXPECT_EQ(goes->state, State::running);
    EXPECT_THAT(reported(Kind::speech_finished), ElementsAre("Guten Tag.de", "Good day.en"))
        << "the visitor's language is the default";
    EXPECT_THAT(reported(Kind::gesture_made), ElementsAre("wave"));
}

TEST_F(Steered, LeavingFailsOpenOrders) {
    auto const words = hall.steer("anna", Say{"", std::string(1'000, 'a')});
    auto const leaves = hall.steer("anna", Leave{});
    ASSERT_TRUE(ends(hall, leaves));
    EXPECT_EQ(leaves->state, State::done);
    EXPECT_TRUE(hall.people().empty());
    EXPECT_EQ(words->state, State::failed);
    EXPECT_EQ(words->reason, "the visitor has left the hall");
    EXPECT_EQ(hall.steer("anna", Leave{})->reason, "visitor anna is not in the hall");
    ASSERT_TRUE(ends(hall, hall.let_in(called("anna")))) << "may enter again";
    EXPECT_EQ(hall.people().size(), 1u);
}

TEST_F(Steered, StandsStillAfterStopSteering) {
    auto const goes = hall.steer("anna", to({2, 7}));
    auto const words = hall.steer("anna", Say{"", "Guten Tag."}), more = hall.steer("anna", Say{"", "Na?"});
    auto const comes = hall.let_in(called("bob"));
    hall.step();
    hall.stop_steering();
    for (auto const& status : {goes, words, more}) EXPECT_EQ(status->state, State::dropped);
    auto const here = anna().pose.position;
    run(hall, 20);
    EXPECT_EQ(anna().pose.position, here);
    EXPECT_EQ(hall.people().size(), 1u) << "waiting visitors do not enter";
    EXPECT_EQ(comes->state, State::running) << "the order is dropped";
    EXPECT_THAT(reported(Kind::speech_finished), ElementsAre("Guten Tag.de")) << "speech in progress continues";
    EXPECT_TRUE(ends(hall, hall.steer("anna", to({5, 5}))));
}

TEST_F(Steered, CannotEnterTwice) {
    EXPECT_EQ(hall.let_in(called("anna"))->reason, "anna is in the hall already");
    auto const bob = hall.let_in(called("bob"));
    EXPECT_EQ(hall.let_in(called("bob"))->reason, "bob is in the hall already") << "waits already";
    run(hall, 5);
    EXPECT_EQ(bob->state, State::running) << "anna stands in the entrance";
    hall.steer("anna", to({5, 6}));
    ASSERT_TRUE(ends(hall, bob));
    EXPECT_EQ(bob->state, State::done);
    EXPECT_THAT(hall.people()[1].role, "bob");
}

// The robot stands in the door, which is one metre wide.
FloorPlan hall_with_blocked_door() {
    FloorPlan plan = plain_hall();
    plan.walls = {{Point{5, 0}, Point{5, 7}}};
    plan.places[1].pose.position = Point{7, 7};
    plan.robots[0].start = {Point{5, 7.5}, 0};
    return plan;
}

TEST(Steering, FailsWhenAnObstacleStaysInTheWay) {
    Hall hall{hall_with_blocked_door(), nobody(), 1};
    ASSERT_TRUE(ends(hall, hall.let_in(called("anna"))));
    auto const goes = hall.steer("anna", to({2, 4}));
    ASSERT_TRUE(ends(hall, goes, 120));
    EXPECT_EQ(goes->state, State::failed);
    EXPECT_EQ(goes->reason, "a person or robot is in the way");
    auto const here = hall.people()[0].pose.position;
    run(hall, 5);
    EXPECT_EQ(hall.people()[0].pose.position, here) << "the visitor has stopped";
}

TEST(Steering, FailsWithoutAWay) {
    FloorPlan plan = plain_hall();
    plan.walls = {{Point{5, 0}, Point{5, 8}}};
    plan.places[1].pose.position = Point{7, 7};
    Hall hall{plan, nobody(), 1};
    ASSERT_TRUE(ends(hall, hall.let_in(called("anna"))));
    auto const goes = hall.steer("anna", to({2, 2}));
    ASSERT_TRUE(ends(hall, goes));
    EXPECT_EQ(goes->reason, "no way leads there");
}

TEST(Steering, RefusesPeopleOfTheScenario) {
    Hall hall{plain_hall(), only(tanaka({{Wait{60}, {}}})), 1};
    run(hall, 1);
    EXPECT_THAT(hall.steer("tanaka", Leave{})->reason, HasSubstr("tanaka belongs to the scenario"));
    EXPECT_THAT(hall.let_in(called("tanaka"))->reason, HasSubstr("already"));
}

TEST(Steering, ASteeredVisitorMayHaveTheNameOfARoleThatHasNotEntered) {
    Role role = tanaka({{Wait{60}, {}}});
    role.enters = 5;
    Hall hall{plain_hall(), only(role), 1};
    ASSERT_TRUE(ends(hall, hall.let_in(called("tanaka"))));
    ASSERT_TRUE(ends(hall, hall.steer("tanaka", to({5, 6}))));
    run(hall, 10);
    EXPECT_EQ(hall.people().size(), 1u) << "Tanaka enters only once";
    ASSERT_TRUE(ends(hall, hall.steer("tanaka", Leave{})));
    run(hall, 1);
    ASSERT_EQ(hall.people().size(), 1u) << "now the scenario's Tanaka enters";
    EXPECT_FALSE(is_steered(hall.people()[0].id));
}

// Records the arrivals of the scenario with all random values.
struct Doorkeeper {
    Hall& hall;
    std::string written{};
    std::uint64_t read = 0;

    void watch(Seconds duration) {
        for (auto const end = hall.now() + world_time(duration); hall.now() < end;) {
            hall.step();
            for (Happening const& happening : hall.chronicle().since(read)) {
                read = happening.sequence;
                auto const* id = std::get_if<PersonId>(&happening.who);
                if (happening.kind != Kind::entered || is_steered(*id)) continue;
                auto const* person = hall.person(*id);
                written += std::to_string(happening.at.count()) + " " + std::to_string(static_cast<std::uint32_t>(*id)) + " " +
                           person->role + " " + std::to_string(person->height) + "\n";
            }
        }
    }
};

TEST(Steering, DoesNotChangeTheScenario) {
    FloorPlan const plan = shipped_plan("reception-hall.xml");
    Hall alone{plan, reception_day(plan), 9}, steered{plan, reception_day(plan), 9};
    Doorkeeper usual{alone}, other{steered};
    usual.watch(600);
    other.watch(5);
    for (auto const* name : {"anna", "bob", "carl", "dora"}) {
        auto const comes = steered.let_in(called(name));
        other.watch(1);
        EXPECT_EQ(comes->state, State::done);
        steered.steer(name, Way{{*steered.target("cloakroom")}});
        other.watch(4);
    }
    other.watch(575);
    EXPECT_GT(std::ranges::count(usual.written, '\n'), 20);
    EXPECT_EQ(other.written, usual.written);
    EXPECT_EQ(std::ranges::count_if(steered.people(), [](Person const& person) { return is_steered(person.id); }), 4);
}

}  // namespace
}  // namespace rois::simulation
