#include "basic/base/robot_component.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "basic/base/parameter_reading.hpp"

namespace rois::basic {

Context make_context(std::shared_ptr<Body> body, std::shared_ptr<media::Media> media, std::string ref,
                     std::shared_ptr<ComponentProfile const> profile) {
    Identifier identifier{.code = std::move(ref),
                          .authority = profile->object.code_space,
                          .codebook_ref = profile->object.identifier,
                          .version = {}};
    ComponentDescription description{.ref = std::move(identifier),
                                     .engine = body->name(),
                                     .profile = std::move(profile),
                                     .provider = body->provider(),
                                     .returns_at_once = body->returns_at_once(),
                                     .crs = body->uses_engines_frame() ? "" : body->crs(),
                                     .positions = {},
                                     .codebooks = {}};
    return {.body = std::move(body), .description = std::move(description), .media = std::move(media)};
}

Context with_position_parameter(Context context, std::string parameter) {
    context.description.positions.push_back(std::move(parameter));
    return context;
}

Context with_identifier_parameter(Context context, std::string parameter, std::vector<std::string_view> const& codebooks) {
    context.description.codebooks.push_back({std::move(parameter), {codebooks.begin(), codebooks.end()}});
    return context;
}

Context with_alternatives(Context context, std::vector<std::string> parameters) {
    context.description.alternatives.push_back(std::move(parameters));
    return context;
}

Context with_motion(Context context) {
    context.description.moves = true;
    return context;
}

RobotComponent::RobotComponent(Context context) : context_{std::move(context)} {}

RobotComponent::~RobotComponent() {
    if (is_attached()) body().part(*this);
}

void RobotComponent::attach(ComponentPort& port) {
    LocalComponent::attach(port);
    observed_ = body().now();
    body().join(*this);
}

ComponentStatus RobotComponent::status() const { return last_step_ ? running_status() : ComponentStatus::uninitialized; }

std::optional<Located> RobotComponent::location() const {
    return located_entity("location", body().name(), body().pose(), 0, {});
}

Prepared RobotComponent::prepare(std::string_view command_type, ParameterList const& parameters) {
    bool const starts = command_type == "start";
    if (!starts && command_type != "set_parameter") return prepare_command(command_type, parameters);
    if (auto problem = parameter_problem(parameters)) return Refused{std::move(*problem)};
    if (starts) return prepare_start(parameters);
    return [this, parameters](CommandHandle, Instant now) { parameters_changed(parameters, now); };
}

Prepared RobotComponent::prepare_command(std::string_view command_type, ParameterList const&) {
    throw std::logic_error("the component's profile has the command '" + std::string{command_type} +
                           "', but the component does not implement it");
}

Located RobotComponent::located_entity(std::string of, std::string ref, Pose const& pose, Metres height,
                                       std::optional<Covariance> const& covariance) const {
    return located(std::move(of), std::move(ref), body().crs(), pose, height, covariance);
}

std::optional<Target> RobotComponent::target(std::string_view text) const {
    if (auto position = target_from_wire(text)) return position;
    auto const& places = body().places();
    auto const place = std::ranges::find(places, text, &NamedPlace::name);
    return place == places.end() ? std::nullopt : std::optional{Target{place->pose.position, place->pose.heading}};
}

std::optional<std::string> RobotComponent::not_targets(Parameter const& targets) const {
    return basic::not_targets(targets, body().places(), [&](auto const& text) { return target(text).has_value(); });
}

void RobotComponent::observe(Instant when) {
    last_step_ = when;
    step_length_ = body().now() - std::exchange(observed_, body().now());
    watch(when);
    on_step(when);
}

Prepared ContinuousFunction::prepare_start(ParameterList const& parameters) {
    if (auto problem = start_problem(parameters)) return Refused{std::move(*problem)};
    return [this, parameters](CommandHandle command, Instant) { start(command, parameters); };
}

void ContinuousFunction::start(CommandHandle command, ParameterList const& parameters) {
    state_ = State::active;
    apply(parameters);
    begin();
    port().completed(command, CompletedStatus::ok, {}, Afterwards::active);
}

Halted ContinuousFunction::halt(Instant) {
    state_ = State::idle;
    return Halted::confirmed;
}

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

void ContinuousFunction::on_step(Instant when) {
    if (state_ == State::active) sense(when);
}

Prepared Action::prepare_start(ParameterList const& parameters) {
    auto planned = plan(parameters);
    if (auto* refused = std::get_if<Refused>(&planned)) return std::move(*refused);
    return [this, begin = std::get<Plan>(std::move(planned))](CommandHandle command, Instant) {
        command_ = command;
        suspended_ = false;
        elapsed_ = {};
        begin();
        if (command_) port().started(command);
    };
}

Halted Action::halt(Instant) {
    if (std::exchange(command_, {})) stop();
    halting_ = !has_stopped();
    return halting_ ? Halted::not_yet : Halted::confirmed;
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

void Action::on_step(Instant) {
    if (halting_ && has_stopped()) {
        halting_ = false;
        confirm_halt();
    }
    if (!command_ || suspended_) return;
    elapsed_ += step_length();
    act();
}

void Action::end(CompletedStatus status, std::string reason) {
    if (auto const command = std::exchange(command_, {}))
        port().completed(*command, status, {}, Afterwards::as_before, std::move(reason));
}

}  // namespace rois::basic
