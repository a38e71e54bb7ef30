// Members that answer late, as those of another engine do.
#include "choosing/team.hpp"
#include "engine/asynchronous.hpp"

namespace rois::choosing::test {

namespace {

class LateMembers : public testing::Test {
protected:
    void come(Part part) {
        part.confirms_binding = true;
        auto component = std::make_unique<SlowComponent>(part);
        members.push_back(component.get());
        component->answers_prepare = false;
        ComponentChange change;
        change.coming.push_back(std::move(component));
        team.choosing.change(std::move(change), [this](ComponentChange whole) {
            whole.belongings.profiles = {common};
            return world.engine->change(std::move(whole), world.now);
        });
        work();
    }
    // Handles what the members have reported.
    void work() { world.advance(50ms); }

    void answer(SlowComponent& member, std::string const& what, ComponentAnswer answer) {
        member.answer(what, std::move(answer));
        work();
    }
    static std::ptrdiff_t waiting(SlowComponent const& member, std::string const& what) {
        return std::ranges::count(member.questions, what, &SlowComponent::Question::what);
    }
    // Answers whatever is asked, until nothing is.
    void let_all() {
        for (bool asked = true; asked;) {
            asked = false;
            for (auto* member : members)
                for (auto const* what : {"bind", "prepare"})
                    for (; waiting(*member, what) > 0; asked = true)
                        what == std::string_view{"bind"} ? answer(*member, what, Done{}) : let_prepare(*member);
        }
    }
    void let_prepare(SlowComponent& member) {
        member.let_prepare();
        work();
    }
    bool can_be_used(std::string const& ref) {
        auto other = world.connect();
        auto const bound = world.begin_to_say(other.session, Bind{Application::identifier(ref)});
        world.advance(1s);
        return bound->said && code_of(*bound) == ReturnCode::ok && world.engine->not_halted().empty();
    }
    // The application leaves, and only then do the members answer.
    void leave() {
        desk.leave();
        work();
        let_all();
    }

    Team team{{"robot1", "robot2"}};
    World& world = team.world;
    Application desk = world.connect();
    std::vector<SlowComponent*> members;
};

class LateSensors : public LateMembers {
protected:
    LateSensors() {
        for (auto const* robot : {"robot1", "robot2"}) come(in_engine(robot, localization));
        EXPECT_EQ(desk.bind("localization"), ReturnCode::ok);
        auto const watch = world.begin_to_say(desk.session, Execute{{{named("watch", start("localization"))}}});
        work();
        answer(*members[0], "bind", Done{});  // it is asked whether the command is possible
        let_prepare(*members[0]);
        EXPECT_TRUE(watch->said);
    }
};

class LateRobot : public LateMembers {
protected:
    LateRobot() {
        team.go("robot1");
        team.go("robot2");
        come(Team::driving("robot1"));
        EXPECT_EQ(desk.bind("navigation"), ReturnCode::ok);
    }
    auto& robot() { return *members.front(); }
    // A command begins on the robot, and is aborted. Then there is another robot.
    void lose(SlowComponent& lost) {
        begin({drive_to("go", {"1000, 0, 0"})});
        let_all();
        lost.answers_halts = false;
        come(Team::driving("robot2"));
        lost.port().completed(lost.begun.back(), CompletedStatus::abort, {}, Afterwards::as_before, "lost");
        work();
        EXPECT_EQ(desk.result_of("go"), "ABORT");
    }
    void accept_and_stop(std::shared_ptr<TestedOperation> const& asked) {
        answer(*members[1], "bind", Done{});
        let_prepare(*members[1]);
        ASSERT_TRUE(asked->said) << "accepted, and not begun yet";
        desk.execute(named("stop", stop("navigation")));
        work();
        EXPECT_EQ(desk.result_of("stop"), "OK");
    }
    std::shared_ptr<TestedOperation> begin(std::vector<CommandUnit> units, bool check_only = false) {
        auto asked = world.begin_to_say(desk.session, Execute{{std::move(units)}, check_only});
        work();
        return asked;
    }
};

}  // namespace

TEST_F(LateSensors, AreFreeAgainIfTheApplicationLeavesBeforeTheyAreBound) {
    ASSERT_EQ(waiting(*members[0], "bind"), 1);
    leave();
    EXPECT_TRUE(can_be_used("localization"));
}

TEST_F(LateSensors, AreFreeAgainIfTheApplicationLeavesBeforeTheyHaveStarted) {
    answer(*members[0], "bind", Done{});
    ASSERT_EQ(waiting(*members[0], "prepare"), 1);
    leave();
    EXPECT_TRUE(can_be_used("localization"));
}

TEST_F(LateSensors, AreStoppedBeforeTheyHaveStarted) {
    answer(*members[0], "bind", Done{});
    desk.execute(named("stop", stop("localization")));
    let_all();
    world.advance(100ms);
    EXPECT_EQ(desk.result_of("stop"), "OK");
    EXPECT_THAT(members[0]->begun, IsEmpty());
    EXPECT_THAT(members[1]->begun, IsEmpty());
}

TEST_F(LateRobot, CarriesOutSeveralCommandsOfOneSequence) {
    auto const checked =
        begin({drive_to("1", {"1000, 0, 0"}), drive_to("2", {"2000, 0, 0"}), drive_to("3", {"3000, 0, 0"})}, true);
    let_all();
    ASSERT_TRUE(checked->said);
    EXPECT_EQ(code_of(*checked), ReturnCode::ok);
}

TEST_F(LateRobot, IsFreeAgainIfTheApplicationLeavesBeforeItIsBound) {
    begin({drive_to("go", {"1000, 0, 0"})});
    ASSERT_EQ(waiting(robot(), "bind"), 1);
    leave();
    EXPECT_TRUE(can_be_used("navigation"));
}

TEST_F(LateRobot, IsFreeAgainIfTheApplicationLeavesBeforeItHasStarted) {
    auto const accepted = begin({drive_to("go", {"1000, 0, 0"})});
    for (int i = 0; i < 10 && !accepted->said; ++i) {
        if (waiting(robot(), "bind") > 0) answer(robot(), "bind", Done{});
        if (waiting(robot(), "prepare") > 0) let_prepare(robot());
    }
    leave();
    EXPECT_TRUE(can_be_used("navigation"));
}

// A lost engine cannot confirm that its robot stands still. Its own engine stops it.
TEST_F(LateRobot, StopsWhileItIsChosenInsteadOfOneThatIsLost) {
    lose(robot());
    robot().port().changed({.status = ComponentStatus::error, .location = {}, .parameters = {}});
    world.engine->and_work([] {}, world.now);
    auto const again = world.begin_to_say(desk.session, Execute{{{drive_to("again", {"1000, 0, 0"})}}});
    accept_and_stop(again);
}

TEST_F(LateRobot, StopsWhileItIsChosenInsteadOfOneThatCannotBeBoundAgain) {
    lose(robot());
    auto const again = begin({drive_to("again", {"1000, 0, 0"})});
    answer(robot(), "bind", Failed{"its engine is lost"});
    accept_and_stop(again);
}

}  // namespace rois::choosing::test
