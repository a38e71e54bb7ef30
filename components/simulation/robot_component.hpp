// What the components of a robot have in common, and the two kinds that nearly all of them are: functions that go on until they
// are stopped (detection, localization, recognition) and actions that come to an end (navigation, speech).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/component.hpp"
#include "media/media.hpp"
#include "simulation/simulation.hpp"
#include "simulation/wire_units.hpp"

namespace rois::simulation {

// Where a component belongs.
struct Fitting {
    std::shared_ptr<Simulation> simulation;
    RobotId robot{};
    ComponentDescription description;
    std::shared_ptr<media::Media> media;  // null where nothing is streamed
};

// Of a component that takes positions as values of this parameter (decision 27).
Fitting taking_positions(Fitting, std::string parameter);

// Of a component that takes identifiers from these codebooks as values of this parameter; the first codebook is the default.
Fitting taking_identifiers(Fitting, std::string parameter, std::vector<std::string_view> const& codebooks);

// Of a component that moves the robot or a part of it (decision 33).
Fitting moving(Fitting);

// Of a component of the robot that is named `name`, or with the robot's name before it (component_refs.hpp).
Fitting fitting(std::shared_ptr<Simulation> const&, std::shared_ptr<media::Media> const&, Robot const&, std::string_view name,
                std::shared_ptr<ComponentProfile const>);

// Looks at the hall after every step of the world. UNINITIALIZED before the first one.
class RobotComponent : public Component, private Observer {
public:
    explicit RobotComponent(Fitting);
    ~RobotComponent() override;
    RobotComponent(RobotComponent const&) = delete;
    RobotComponent& operator=(RobotComponent const&) = delete;

    ComponentDescription const& description() const final { return fitting_.description; }
    void attach(ComponentPort&) final;
    ComponentStatus status() const final;
    std::optional<Located> location() const final;
    std::optional<std::string> refusal(std::string_view command_type, ParameterList const&) const final;

protected:
    Hall& hall() { return fitting_.simulation->hall(); }
    Hall const& hall() const { return fitting_.simulation->hall(); }
    RobotId robot() const { return fitting_.robot; }
    media::Media& media() const { return *fitting_.media; }
    ComponentPort& port() { return *port_; }
    std::optional<Instant> const& last_step() const { return last_step_; }
    bool world_goes_on() const { return fitting_.simulation->runs_by_itself() || fitting_.simulation->goes_on(); }

    // What is in the hall, as this robot's messages have it: in the robot's own frame when it has one, named by crs(). A text as
    // of to_wire(), and the structured form as of located().
    std::string const& crs() const;
    std::string told(Pose const&) const;
    Located told_located(std::string of, std::string ref, Pose const&, Metres height,
                         std::optional<Covariance> const& covariance) const;
    // The other way: a position in the robot's frame, or the name of a place; nothing when it is neither.
    std::optional<Target> target(std::string_view text) const;

    virtual void stepped(Instant when) = 0;
    // The same for what goes on whether the component is active or not; called before stepped().
    virtual void watch(Instant) {}
    void time_passed(Instant) override {}
    // Once the world has begun: READY or WARNING.
    virtual ComponentStatus condition() const { return ComponentStatus::ready; }

    // What is wrong with a value among these, and what `start` lacks; nothing when all is well. Values are of their types.
    virtual std::optional<std::string> unfit(ParameterList const&) const { return {}; }
    virtual std::optional<std::string> missing(ParameterList const&) const { return {}; }
    // Why a command of the profile cannot be carried out with these arguments.
    virtual std::optional<std::string> impossible(std::string_view, ParameterList const&) const { return {}; }

private:
    void observe(Instant when) final;
    RobotFrame const* own_frame() const;  // null: the hall's

    Fitting fitting_;
    ComponentPort* port_ = nullptr;
    std::optional<Instant> last_step_;
};

// Active from `start` on, until it is stopped.
class ContinuousFunction : public RobotComponent {
public:
    using RobotComponent::RobotComponent;

    void start(CommandHandle, ParameterList const&, Instant now) final;
    Halted halt(Instant now) final;
    void suspend(Instant now) final;
    void resume(Instant now) final;
    void parameters_changed(ParameterList const&, Instant now) final;

protected:
    // Everything that was told is forgotten: what is sensed from now on is new.
    virtual void begin() = 0;
    // New parameters, before `begin` and whenever they change while active.
    virtual void apply(ParameterList const&) {}
    // Once a step, while active and not suspended.
    virtual void sense(Instant when) = 0;
    virtual void suspended() {}
    virtual void resumed() {}

private:
    void stepped(Instant when) final;

    enum class State : std::uint8_t { idle, active, suspended } state_ = State::idle;
};

// Runs from `start` to its end. Its time is the world's, and stands still while it is suspended. New parameters count from the
// next start on.
class Action : public RobotComponent {
public:
    using RobotComponent::RobotComponent;

    void start(CommandHandle, ParameterList const&, Instant now) final;
    Halted halt(Instant now) final;
    void suspend(Instant now) final;
    void resume(Instant now) final;

protected:
    // May end the action at once.
    virtual void begin(ParameterList const&) = 0;
    // Once a step, while it runs and is not suspended.
    virtual void act() = 0;
    // Whether nothing of it moves any more after cease(). `halt` is confirmed then.
    virtual bool has_ceased() const { return true; }
    // Stands still from now on: for good, for a while, no longer.
    virtual void cease() = 0;
    virtual void hold() = 0;
    virtual void go_on() = 0;

    // Completes the command; the action has ceased, or ceases by itself. `reason`: why not with OK.
    void end(CompletedStatus, std::string reason = {});
    WorldTime elapsed() const { return elapsed_; }

private:
    void stepped(Instant when) final;

    std::optional<CommandHandle> command_;
    bool suspended_ = false;
    bool halting_ = false;  // the engine waits for halted()
    WorldTime elapsed_{};
};

}  // namespace rois::simulation
