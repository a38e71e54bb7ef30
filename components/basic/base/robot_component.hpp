// Base classes of a robot's components: continuous functions run until they are stopped (detection, localization, recognition);
// actions end by themselves (navigation, speech).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "basic/body/body.hpp"
#include "basic/body/wire_units.hpp"
#include "engine/local_component.hpp"
#include "media/media.hpp"

namespace rois::basic {

// The robot that a component acts on, and its description.
struct Context {
    std::shared_ptr<Body> body;
    ComponentDescription description;
    std::shared_ptr<media::Media> media;  // null without a media server
};

// Declares that this parameter takes positions (decision 27).
Context with_position_parameter(Context, std::string parameter);

// Declares that this parameter takes identifiers from these codebooks. The first codebook is the default.
Context with_identifier_parameter(Context, std::string parameter, std::vector<std::string_view> const& codebooks);

// Declares that only the newest of these parameters is stored, as the others are alternatives to it.
Context with_alternatives(Context, std::vector<std::string> parameters);

// Declares that the component moves the robot or a part of it (decision 33).
Context with_motion(Context);

// Makes the context of the body's component with this ref.
Context make_context(std::shared_ptr<Body>, std::shared_ptr<media::Media>, std::string ref,
                     std::shared_ptr<ComponentProfile const>);

// Observes its body, which it shares with the robot's other components. Its status is UNINITIALIZED before the first observation.
// Not thread-safe: the engine, which owns the component, and the body call it one at a time, but not always on the same thread.
class RobotComponent : public LocalComponent, private Observer {
public:
    explicit RobotComponent(Context);
    ~RobotComponent() override;
    RobotComponent(RobotComponent const&) = delete;
    RobotComponent& operator=(RobotComponent const&) = delete;

    ComponentDescription const& description() const final { return context_.description; }
    void attach(ComponentPort&) final;
    ComponentStatus status() const final;
    std::optional<Located> location() const final;
    Prepared prepare(std::string_view command_type, ParameterList const&) final;

protected:
    Body& body() const { return *context_.body; }
    Perception const& perception() const { return body().perception(); }
    media::Media& media() const { return *context_.media; }
    std::optional<Instant> const& last_step() const { return last_step_; }
    WorldTime step_length() const { return step_length_; }  // world time between the last two observations

    Located located_entity(std::string of, std::string ref, Pose const&, Metres height,
                           std::optional<Covariance> const& covariance) const;
    // Reads a position or the name of a place. Returns nothing if the text is neither.
    std::optional<Target> target(std::string_view text) const;
    // Returns an error if one of the values is not a valid target, else nothing.
    std::optional<std::string> not_targets(Parameter const&) const;

    // Called after every observation: first watch(), also while the component is inactive, then on_step().
    virtual void watch(Instant) {}
    virtual void on_step(Instant when) = 0;
    void time_passed(Instant) override {}
    // The status after the first step: READY or WARNING.
    virtual ComponentStatus running_status() const { return ComponentStatus::ready; }

    // Returns an error for an invalid value, nothing if all are valid. They have been validated against their data types.
    virtual std::optional<std::string> parameter_problem(ParameterList const&) const { return {}; }
    // Prepares `start` with valid parameters, and a command of the component's own profile (LocalComponent::prepare).
    virtual Prepared prepare_start(ParameterList const&) = 0;
    virtual Prepared prepare_command(std::string_view command_type, ParameterList const& arguments);

private:
    void observe(Instant when) final;

    Context context_;
    std::optional<Instant> last_step_;
    WorldTime observed_{};  // the world time of the last observation
    WorldTime step_length_{};
};

// Active from `start` until `stop`.
class ContinuousFunction : public RobotComponent {
public:
    using RobotComponent::RobotComponent;

    Halted halt(Instant now) final;
    void suspend(Instant now) final;
    void resume(Instant now) final;
    void parameters_changed(ParameterList const&, Instant now) final;

protected:
    // Returns an error for parameters with which the function cannot start.
    virtual std::optional<std::string> start_problem(ParameterList const&) const { return {}; }
    // Resets the reports: everything sensed from now on counts as new.
    virtual void begin() = 0;
    // Applies new parameters; called before begin(), and on changes while active.
    virtual void apply(ParameterList const&) {}
    // Called after each step while active and not suspended.
    virtual void sense(Instant when) = 0;
    virtual void suspended() {}
    virtual void resumed() {}

private:
    Prepared prepare_start(ParameterList const&) final;
    void start(CommandHandle, ParameterList const&);
    void on_step(Instant when) final;

    enum class State : std::uint8_t { idle, active, suspended } state_ = State::idle;
};

// Runs from `start` to its end. elapsed() counts world time, except while suspended. New parameters apply from the next start.
class Action : public RobotComponent {
public:
    using RobotComponent::RobotComponent;

    Halted halt(Instant now) final;
    void suspend(Instant now) final;
    void resume(Instant now) final;

protected:
    // A function that begins the action, which may end at once.
    using Plan = std::function<void()>;
    // Reads the parameters. Returns how to begin the action, or why that is impossible.
    virtual std::variant<Plan, Refused> plan(ParameterList const&) = 0;
    // Called after each step while running and not suspended.
    virtual void act() = 0;
    // Ends the motion, suspends it, resumes it.
    virtual void stop() = 0;
    virtual void hold() = 0;
    virtual void go_on() = 0;
    // Whether all motion has ended after stop(). Only then is `halt` confirmed.
    virtual bool has_stopped() const { return true; }

    // Completes the command. The action must have been stopped or stop by itself. `reason` explains a status other than OK.
    void end(CompletedStatus, std::string reason = {});
    WorldTime elapsed() const { return elapsed_; }

private:
    Prepared prepare_start(ParameterList const&) final;
    void on_step(Instant when) final;

    std::optional<CommandHandle> command_;
    bool suspended_ = false;
    bool halting_ = false;  // the engine waits for halted()
    WorldTime elapsed_{};
};

}  // namespace rois::basic
