// The hall as a component: steered visitors, and time with speed 0.
#include "simulation/adapters/simulated_hall.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::AnyOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

// The test advances the world.
class Steerer {
public:
    explicit Steerer(double speed = 0, std::vector<Role> roles = {})
        : simulation{std::make_shared<Simulation>(reception(), Scenario{"test", {}, std::move(roles), {}, {}}, 7, speed)},
          component{simulated_hall(simulation, profile()), [this] { return now_; }, [this] { return simulation->hall().now(); }} {
        component.allow_any_command();
    }
    ~Steerer() { EXPECT_THAT(component.words(), Each(AnyOf("started", StartsWith("completed")))) << "no events and errors"; }
    Steerer(Steerer const&) = delete;
    Steerer& operator=(Steerer const&) = delete;

    static ComponentProfile profile() {
        auto const* const file = "simulated_hall.xml";
        return xml::read_component_profile(schemas(), file, std::string{files::simulation().at(file)});
    }

    // Returns why the component refuses the command; empty if it accepts it.
    std::string refusal(std::string const& type, ParameterList const& arguments) {
        return component.refusal(type, arguments).value_or("");
    }

    CommandHandle enter(std::string const& name, bool known = false) {
        return component.perform("enter", {text("visitor_ref", name), text("language", "en"), boolean("known", known)});
    }
    CommandHandle walk(std::string const& name, std::vector<std::string> positions) {
        return component.perform("walk", {text("visitor_ref", name), texts("target_position", std::move(positions))});
    }
    CommandHandle let_pass(int milliseconds) { return component.perform("let_pass", {integer("time", milliseconds)}); }

    void advance_once() {
        now_ = now_ + std::chrono::milliseconds{10};
        simulation->advance(now_);
        component.after_step();
    }
    // Advances like the engine's ticks until no requested time is left.
    void advance() {
        do {
            advance_once();
        } while (simulation->goes_on());
    }

    // Returns "OK", "ERROR visitor anna is not in the hall" or "goes on".
    std::string outcome(CommandHandle command) const { return component.outcome(command).value_or("goes on"); }
    Results visitors() { return component.query("visitors"); }

    std::shared_ptr<Simulation> simulation;
    Operated component;

private:
    Instant now_{Steady{}, Utc{std::chrono::seconds{1'800'000'000}}};
};

TEST(SimulatedHall, BelongsToNoRobot) {
    Steerer steerer;
    auto const& description = steerer.component.description();
    EXPECT_EQ(description.ref.code, "simulated_hall");
    EXPECT_EQ(description.ref.codebook_ref, "urn:x-rois:def:component:simulation::Hall");
    EXPECT_EQ(description.engine, "");
    EXPECT_THAT(description.positions, ElementsAre("target_position"));
    EXPECT_FALSE(steerer.component.location());
    EXPECT_EQ(steerer.component.status(), ComponentStatus::uninitialized);
    steerer.advance();
    EXPECT_EQ(steerer.component.status(), ComponentStatus::ready);
}

TEST(SimulatedHall, LetsTimePass) {
    Steerer steerer;
    steerer.advance();
    steerer.advance();
    EXPECT_EQ(steerer.simulation->hall().now(), WorldTime{20}) << "the first step has been made, and no other";
    auto const short_time = steerer.let_pass(100), long_time = steerer.let_pass(2'000);
    EXPECT_EQ(steerer.outcome(short_time), "goes on");
    while (steerer.simulation->hall().now() < WorldTime{120}) steerer.advance_once();
    EXPECT_EQ(steerer.outcome(short_time), "OK");
    EXPECT_EQ(steerer.outcome(long_time), "goes on") << "requests are processed in order";
    steerer.advance();
    EXPECT_EQ(steerer.simulation->hall().now(), WorldTime{2'120});
    EXPECT_EQ(steerer.outcome(long_time), "OK");
}

TEST(SimulatedHall, RefusesLetPassIfTimePassesByItself) {
    Steerer steerer{1};
    EXPECT_THAT(steerer.refusal("let_pass", {integer("time", 100)}), HasSubstr("let_pass needs --sim-speed 0"));
    steerer.enter("anna");
    steerer.advance();
    EXPECT_THAT(values(steerer.visitors(), "visitor_ref"), ElementsAre("anna")) << "visitors can be steered";
}

TEST(SimulatedHall, RefusesInvalidArguments) {
    Steerer steerer;
    for (int const time : {0, -20, 30, 3'600'020})
        EXPECT_THAT(steerer.refusal("let_pass", {integer("time", time)}),
                    HasSubstr("a multiple of 20 ms, more than 0 and at most 1 hour"))
            << time;
    auto const anna = text("visitor_ref", "anna");
    for (auto const* name : {"", "an na", "an:na", "an.na", "robot"})
        EXPECT_THAT(steerer.refusal("leave", {text("visitor_ref", name)}), HasSubstr("is not a valid visitor name")) << name;
    EXPECT_THAT(steerer.refusal("leave", {text("visitor_ref", std::string(65, 'a'))}), HasSubstr("64 bytes"));
    EXPECT_THAT(steerer.refusal("enter", {anna, text("language", "jp")}),
                HasSubstr("'jp' is not supported; expected one of de, en"));
    EXPECT_THAT(steerer.refusal("enter", {anna, text("language", "")}), HasSubstr("'language'"));
    EXPECT_EQ(steerer.refusal("say", {anna, text("text", "Hello"), text("language", "")}), "") << "the visitor's language";
    EXPECT_THAT(steerer.refusal("say", {anna, text("text", " ")}), HasSubstr("'text' must have 1 to 16384 bytes"));
    EXPECT_THAT(steerer.refusal("say", {anna, text("text", "Hello"), text("language", "xx")}), HasSubstr("'xx'"));
    EXPECT_THAT(steerer.refusal("gesture", {anna, text("gesture", "jump")}),
                HasSubstr("'jump' is unknown; expected one of wave, nod"));
    auto const walk = [&](std::vector<std::string> to) { return steerer.refusal("walk", {anna, texts("target_position", to)}); };
    EXPECT_THAT(walk({}), HasSubstr("at least one position"));
    EXPECT_THAT(walk({"attic"}), HasSubstr("'attic' is not a valid target"));
    EXPECT_THAT(walk({"3000, 2000", "13000, 1000"}),
                HasSubstr("'13000, 1000' is outside of the hall, in a wall or in furniture"));
    EXPECT_EQ(walk({"desk", "3000, 2000", "3000, 2000, 90"}), "");
}

TEST(SimulatedHall, ReportsHowCommandsEnd) {
    Steerer steerer;
    steerer.advance();
    auto const nobody = steerer.walk("anna", {"desk"});
    EXPECT_EQ(steerer.outcome(nobody), "ERROR visitor anna is not in the hall") << "at once";
    auto const comes = steerer.enter("anna", true), too_early = steerer.walk("anna", {"desk"});
    EXPECT_EQ(steerer.outcome(comes), "goes on");
    EXPECT_THAT(steerer.outcome(too_early), HasSubstr("ERROR visitor anna is not"));
    steerer.let_pass(20);
    steerer.advance();
    EXPECT_EQ(steerer.outcome(comes), "OK");
    EXPECT_EQ(steerer.outcome(steerer.enter("anna")), "ERROR anna is in the hall already");

    auto const first = steerer.walk("anna", {"3000, 6000"}), second = steerer.walk("anna", {"desk"});
    auto const says =
        steerer.component.perform("say", {text("visitor_ref", "anna"), text("text", "Hello."), text("language", "")});
    auto const waves = steerer.component.perform("gesture", {text("visitor_ref", "anna"), text("gesture", "wave")});
    steerer.let_pass(60'000);
    steerer.advance();
    EXPECT_EQ(steerer.outcome(first), "ABORT") << "replaced by the second";
    for (auto const command : {second, says, waves}) EXPECT_EQ(steerer.outcome(command), "OK");
    EXPECT_THAT(values(steerer.visitors(), "position_data"), ElementsAre(MatchesRegex("(29|30).., (19|20).., 90")));

    auto const leaves = steerer.component.perform("leave", {text("visitor_ref", "anna")});
    steerer.let_pass(60'000);
    steerer.advance();
    EXPECT_EQ(steerer.outcome(leaves), "OK");
    EXPECT_THAT(values(steerer.visitors(), "visitor_ref"), IsEmpty());
}

TEST(SimulatedHall, ListsAllVisitors) {
    Steerer steerer{0, {known(visitor("tanaka", {does(Wait{60})})), visitor("late", {does(Wait{60})}, 100)}};
    steerer.advance();
    steerer.let_pass(1'000);
    steerer.advance();
    steerer.enter("anna");
    steerer.let_pass(1'000);
    steerer.advance();
    EXPECT_THAT(values(steerer.visitors(), "visitor_ref"), ElementsAre("tanaka")) << "he stands in the entrance";
    Steerer other{0, {visitor("late", {does(Walk{at(5, 5)}), does(Wait{60})})}};
    other.advance();
    other.let_pass(10'000);
    other.advance();
    other.enter("anna", true);
    other.let_pass(20);
    other.advance();
    auto const all = other.visitors();
    EXPECT_THAT(values(all, "visitor_ref"), ElementsAre("late", "anna")) << "in order of arrival";
    EXPECT_THAT(values(all, "position_data"), ElementsAre(StartsWith("5"), "11000, 4000, 180"));
    EXPECT_EQ(codebook_of(all, "position_data"), "urn:x-rois:def:crs:simulation::hall");
    EXPECT_EQ(value(all, "known"), "false true");
    EXPECT_EQ(value(all, "steered"), "false true");
    EXPECT_TRUE(other.component.rows("weather").empty());
}

// stop, release and the end of a session also end the visitors' orders.
TEST(SimulatedHall, HaltEndsItsCommandsAndStopsTheVisitors) {
    Steerer steerer;
    steerer.advance();
    steerer.enter("anna");
    steerer.let_pass(20);
    steerer.advance();
    auto const walks = steerer.walk("anna", {"desk"}), waits = steerer.let_pass(10'000);
    steerer.advance_once();
    EXPECT_EQ(steerer.simulation->hall().now(), WorldTime{60}) << "time passes";
    EXPECT_EQ(steerer.component.stop(), Halted::confirmed);
    steerer.advance();
    steerer.advance();
    EXPECT_EQ(steerer.simulation->hall().now(), WorldTime{60}) << "no time passes";
    steerer.let_pass(10'000);
    steerer.advance();
    EXPECT_THAT(values(steerer.visitors(), "position_data"), ElementsAre(StartsWith("10")))
        << "the visitor stopped after one step";
    EXPECT_EQ(steerer.outcome(walks), "goes on") << "the engine ends it";
    EXPECT_EQ(steerer.outcome(waits), "goes on");
}

}  // namespace
}  // namespace rois::simulation::stage
