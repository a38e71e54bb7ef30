#include "simulation/robot_component.hpp"

#include <utility>

#include "simulation/component_refs.hpp"
#include "simulation/wire_units.hpp"

namespace rois::simulation {

Fitting fitting(std::shared_ptr<Simulation> const& simulation, std::shared_ptr<media::Media> const& media, Robot const& robot,
                std::string_view name, std::shared_ptr<ComponentProfile const> profile) {
    bool const first = robot.id == simulation->hall().robots().front().id;
    std::string const engine = first ? "" : robot.name;
    Identifier const identifier{.code = component_ref(name, engine),
                                .authority = profile->object.code_space,
                                .codebook_ref = profile->object.identifier,
                                .version = {}};
    return {.simulation = simulation, .robot = robot.id, .description = {identifier, engine, std::move(profile)}, .media = media};
}

RobotComponent::RobotComponent(Fitting fitting) : fitting_{std::move(fitting)} {}

RobotComponent::~RobotComponent() { fitting_.simulation->part(*this); }

void RobotComponent::attach(ComponentPort& port) {
    port_ = &port;
    fitting_.simulation->join(*this);
}

ComponentStatus RobotComponent::status() const { return last_step_ ? condition() : ComponentStatus::uninitialized; }

// Where the robot is.
std::optional<Located> RobotComponent::location() const {
    Robot const& self = hall().robot(robot());
    return located("location", self.name, hall().plan().crs, self.pose, 0, {});
}

std::optional<std::string> RobotComponent::refusal(std::string_view command_type, ParameterList const& parameters) const {
    bool const starts = command_type == "start";
    if (!starts && command_type != "set_parameter") return impossible(command_type, parameters);
    if (auto problem = unfit(parameters)) return problem;
    return starts ? missing(parameters) : std::nullopt;
}

void RobotComponent::observe(Instant when) {
    last_step_ = when;
    stepped(when);
}

void ContinuousFunction::start(CommandHandle command, ParameterList const& parameters, Instant) {
    state_ = State::active;
    apply(parameters);
    begin();
    port().completed(command, CompletedStatus::ok, {}, Afterwards::active);
}

void ContinuousFunction::halt(Instant) { state_ = State::idle; }

void ContinuousFunction::suspend(Instant) {
    if (state_ != State::active) return;
    state_ = State::suspended;
    suspended();
}

void ContinuousFunction::resume(Instant) {
    if (state_ != State::suspended) return;
    state_ = State::active;
    resumed();
}

void ContinuousFunction::parameters_changed(ParameterList const& parameters, Instant) {
    if (state_ != State::idle) apply(parameters);
}

void ContinuousFunction::stepped(Instant when) {
    if (state_ == State::active) sense(when);
}

void Action::start(CommandHandle command, ParameterList const& parameters, Instant) {
    command_ = command;
    suspended_ = false;
    elapsed_ = {};
    begin(parameters);
    if (command_) port().started(command);
}

void Action::halt(Instant) {
    if (!command_) return;
    command_.reset();
    cease();
}

void Action::suspend(Instant) {
    if (!command_ || suspended_) return;
    suspended_ = true;
    hold();
}

void Action::resume(Instant) {
    if (!command_ || !suspended_) return;
    suspended_ = false;
    go_on();
}

void Action::stepped(Instant) {
    if (!command_ || suspended_) return;
    elapsed_ += Hall::step_length;
    act();
}

void Action::end(CompletedStatus status) {
    if (auto const command = std::exchange(command_, {})) port().completed(*command, status);
}

}  // namespace rois::simulation
