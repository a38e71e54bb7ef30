#include "simulation/basic/robot_component.hpp"

#include <utility>

#include "simulation/basic/component_refs.hpp"
#include "simulation/world/wire_units.hpp"

namespace rois::simulation {
namespace {

// Returns null if the robot uses the hall's frame.
RobotFrame const* frame_of(FloorPlan const& plan, RobotId robot) {
    auto const& frame = plan.robots.at(static_cast<std::size_t>(robot)).frame;
    return frame ? &*frame : nullptr;
}

Pose moved(Pose const& pose, Eigen::Isometry2d const& by, Radians turn) {
    return {by * pose.position, wrapped(pose.heading + turn)};
}

}  // namespace

Context make_context(std::shared_ptr<Simulation> const& simulation, std::shared_ptr<media::Media> const& media,
                     Robot const& robot, std::string_view name, std::shared_ptr<ComponentProfile const> profile) {
    bool const first = robot.id == simulation->hall().robots().front().id;
    Identifier const identifier{.code = component_ref(name, first ? "" : robot.name),
                                .authority = profile->object.code_space,
                                .codebook_ref = profile->object.identifier,
                                .version = {}};
    auto const* const frame = frame_of(simulation->hall().plan(), robot.id);
    return {.simulation = simulation,
            .robot = robot.id,
            .description = {.ref = identifier,
                            .engine = robot.name,
                            .profile = std::move(profile),
                            .crs = frame == nullptr ? "" : frame->crs,
                            .positions = {},
                            .codebooks = {}},
            .media = media};
}

Context with_position_parameter(Context context, std::string parameter) {
    context.description.positions.push_back(std::move(parameter));
    return context;
}

Context with_identifier_parameter(Context context, std::string parameter, std::vector<std::string_view> const& codebooks) {
    context.description.codebooks.push_back({std::move(parameter), {codebooks.begin(), codebooks.end()}});
    return context;
}

Context with_motion(Context context) {
    context.description.moves = true;
    return context;
}

RobotComponent::RobotComponent(Context context) : context_{std::move(context)} {}

RobotComponent::~RobotComponent() { context_.simulation->part(*this); }

void RobotComponent::attach(ComponentPort& port) {
    port_ = &port;
    context_.simulation->join(*this);
}

ComponentStatus RobotComponent::status() const { return last_step_ ? running_status() : ComponentStatus::uninitialized; }

std::optional<Located> RobotComponent::location() const {
    Robot const& self = hall().robot(robot());
    return located_entity("location", self.name, self.pose, 0, {});
}

std::optional<std::string> RobotComponent::refusal(std::string_view command_type, ParameterList const& parameters) const {
    bool const starts = command_type == "start";
    if (!starts && command_type != "set_parameter") return command_problem(command_type, parameters);
    if (auto problem = parameter_problem(parameters)) return problem;
    return starts ? start_problem(parameters) : std::nullopt;
}

RobotFrame const* RobotComponent::own_frame() const { return frame_of(hall().plan(), robot()); }

std::string const& RobotComponent::crs() const {
    auto const* const frame = own_frame();
    return frame == nullptr ? hall().plan().crs : frame->crs;
}

std::string RobotComponent::pose_text(Pose const& pose) const {
    auto const* const own = own_frame();
    return to_wire(own == nullptr ? pose : moved(pose, frame(own->origin).inverse(), -own->origin.heading));
}

Located RobotComponent::located_entity(std::string of, std::string ref, Pose const& pose, Metres height,
                                       std::optional<Covariance> const& covariance) const {
    auto const* const own = own_frame();
    if (own == nullptr) return located(std::move(of), std::move(ref), crs(), pose, height, covariance);
    auto const into = frame(own->origin).inverse();
    std::optional<Covariance> turned = covariance;
    if (turned) {
        Covariance turn = Covariance::Identity();
        turn.topLeftCorner<2, 2>() = into.linear();
        turned = turn * *covariance * turn.transpose();
    }
    return located(std::move(of), std::move(ref), own->crs, moved(pose, into, -own->origin.heading), height, turned);
}

std::optional<Target> RobotComponent::target(std::string_view text) const {
    auto const* const own = own_frame();
    auto meant = own == nullptr ? std::nullopt : target_from_wire(text);
    if (!meant) return hall().target(text);
    meant->position = frame(own->origin) * meant->position;
    if (meant->heading) meant->heading = wrapped(*meant->heading + own->origin.heading);
    return meant;
}

void RobotComponent::observe(Instant when) {
    last_step_ = when;
    watch(when);
    on_step(when);
}

void ContinuousFunction::start(CommandHandle command, ParameterList const& parameters, Instant) {
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

void Action::start(CommandHandle command, ParameterList const& parameters, Instant) {
    command_ = command;
    suspended_ = false;
    elapsed_ = {};
    begin(parameters);
    if (command_) port().started(command);
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
        port().halted();
    }
    if (!command_ || suspended_) return;
    elapsed_ += Hall::step_length;
    act();
}

void Action::end(CompletedStatus status, std::string reason) {
    if (auto const command = std::exchange(command_, {}))
        port().completed(*command, status, {}, Afterwards::as_before, std::move(reason));
}

}  // namespace rois::simulation
