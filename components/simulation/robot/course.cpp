#include "simulation/robot/course.hpp"

#include <algorithm>
#include <cmath>

namespace rois::simulation {
namespace {

// A motion is complete within both tolerances, which save the last, very small steps.
constexpr Metres at_place = 0.0002;
constexpr Radians at_heading = from_degrees(0.1);

double braking(double left, double deceleration, Seconds dt) {
    double const one_step = deceleration * dt;
    return std::sqrt(one_step * one_step + 2 * deceleration * std::max(0.0, left)) - one_step;
}

double towards(double from, double wanted, double most) { return from + std::clamp(wanted - from, -most, most); }

double sign(double value) { return value < 0 ? -1 : 1; }

// The shortest duration from standstill to standstill.
Seconds shortest(double way, double speed, double acceleration) {
    if (way >= speed * speed / acceleration) return way / speed + speed / acceleration;
    return 2 * std::sqrt(way / acceleration);
}

// The maximum speed with which a way from standstill to standstill takes exactly this time.
double pace(double way, double acceleration, Seconds time) {
    double const reach = acceleration * time;
    return (reach - std::sqrt(std::max(0.0, reach * reach - 4 * acceleration * way))) / 2;
}

MetresPerSecond paced(MetresPerSecond speed, std::optional<MetresPerSecond> const& fastest) {
    return fastest ? std::min(speed, *fastest) : speed;
}

// Whether the robot drives at less than half the wanted speed. stand() cannot be used here: it would take a slow motion for a
// stalled one.
bool is_slower_than(MetresPerSecond wanted, DriveState const& state) { return std::abs(state.twist.linear) < wanted / 2; }

// Sums up the turns of a robot, also beyond a half turn.
class Turned {
public:
    Radians by(Radians heading) {
        if (last_) sum_ += wrapped(heading - *last_);
        last_ = heading;
        return sum_;
    }

private:
    Radians sum_ = 0;
    std::optional<Radians> last_;
};

// A turn on the spot: the start of a Line, or a Curve with radius 0.
class TurnOnTheSpot {
public:
    explicit TurnOnTheSpot(Radians turn) : turn_(turn) {}

    Seconds shortest_time(RobotPlan const& plan) const {
        return shortest(std::abs(turn_), plan.max_turn_rate, plan.max_turn_acceleration);
    }
    void take(Seconds time, RobotPlan const& plan) { fastest_ = pace(std::abs(turn_), plan.max_turn_acceleration, time); }

    // Returns nothing when the turn is complete.
    std::optional<Twist> steer(DriveState const& state) {
        Radians const left = turn_ - turned_.by(state.pose.heading);
        if (std::abs(left) < at_heading && state.stand()) return std::nullopt;
        RadiansPerSecond const rate = state.rate_to_stop_in(left);
        return Twist{0, fastest_ ? std::clamp(rate, -*fastest_, *fastest_) : rate};
    }

private:
    Radians turn_;
    std::optional<RadiansPerSecond> fastest_;
    Turned turned_;
};

class LineCourse : public Course {
public:
    explicit LineCourse(Line line) : line_(line), turn_(line.turn) {}

    Twist steer(DriveState const& state, Progress& progress) override {
        if (!track_) {
            if (!state.stand()) return {};
            track_ = Pose{state.pose.position, wrapped(state.pose.heading + line_.turn)};
            if (!is_free(state)) {
                progress.state = MotionState::unreachable;
                return {};
            }
            if (line_.duration) take(*line_.duration, state.plan);
        }
        if (!turned_) {
            if (auto const twist = turn_.steer(state)) return *twist;
            turned_ = true;
        }
        return drive(state, progress);
    }

private:
    bool is_free(DriveState const& state) const {
        if (line_.distance == 0) return true;
        Point const end = track_->position + line_.distance * unit(track_->heading);
        Radians const heading = line_.distance < 0 ? wrapped(track_->heading + std::numbers::pi) : track_->heading;
        return state.around.plan().can_go_straight(track_->position, end, state.plan.radius) &&
               !wall_is_too_near(state.around.plan(), end, heading, state.plan.radius);
    }

    // Slows down both parts of the motion equally.
    void take(Seconds time, RobotPlan const& plan) {
        Metres const way = std::abs(line_.distance);
        Seconds const straight = shortest(way, plan.max_speed, plan.max_acceleration), turning = turn_.shortest_time(plan);
        if (time <= straight + turning) return;
        double const slower = time / (straight + turning);
        fastest_ = pace(way, plan.max_acceleration, straight * slower);
        turn_.take(turning * slower, plan);
    }

    Twist drive(DriveState const& state, Progress& progress) {
        Point const gone = frame(*track_).inverse() * state.pose.position;
        Metres const left = line_.distance - gone.x();
        bool const there = std::abs(left) < at_place || left * line_.distance <= 0;
        MetresPerSecond const speed = there ? 0 : paced(state.speed_to_stop_in(std::abs(left)), fastest_);
        stall_.update(state, is_slower_than(speed, state));
        progress.state = stall_.is_stalled() ? MotionState::obstructed : MotionState::moving;
        if (there && state.stand()) progress.state = MotionState::arrived;
        if (there) return {};
        return {sign(left) * speed, back_on_track(state, gone.y())};
    }

    // The turn may leave an error of at_heading: correct the heading while driving, and steer back to the line.
    RadiansPerSecond back_on_track(DriveState const& state, Metres aside) const {
        Radians const off = wrapped(state.pose.heading - track_->heading);
        Radians const aim = -std::clamp(aside, -0.1, 0.1) * sign(line_.distance);
        return state.stand() ? 0 : 2 * (aim - off);
    }

    Line line_;
    TurnOnTheSpot turn_;
    std::optional<MetresPerSecond> fastest_;
    std::optional<Pose> track_;  // start and direction of the line
    bool turned_ = false;
    StallDetector stall_;
};

class CurveCourse : public Course {
public:
    explicit CurveCourse(Curve curve) : curve_(curve), on_the_spot_(curve.turn) {}

    std::optional<Metres> circle() const override {
        if (!started_ || curve_.radius == 0) return std::nullopt;
        return curve_.radius * sign(curve_.turn);
    }

    Twist steer(DriveState const& state, Progress& progress) override {
        if (!started_) {
            if (!state.stand()) return {};
            started_ = true;
            if (!is_free(state)) {
                progress.state = MotionState::unreachable;
                return {};
            }
            if (curve_.duration) take(*curve_.duration, state.plan);
        }
        if (curve_.radius != 0) return drive(state, progress);
        auto const twist = on_the_spot_.steer(state);
        if (!twist) progress.state = MotionState::arrived;
        return twist.value_or(Twist{});
    }

private:
    bool is_free(DriveState const& state) const {
        constexpr Metres apart = 0.03;
        Radians const angle = std::min(std::abs(curve_.turn), 2 * std::numbers::pi);
        Radians const side = state.pose.heading + sign(curve_.turn) * std::numbers::pi / 2;
        // Forwards, the centre is on the side of the turn; backwards, on the other side.
        Point const centre = state.pose.position + curve_.radius * unit(side);
        Metres const length = std::abs(curve_.radius) * angle;
        for (Metres gone = 0; gone <= length + apart; gone += apart) {
            Radians const part = length > 0 ? angle * std::min(1.0, gone / length) : 0;
            Point const at = centre - curve_.radius * unit(side + sign(curve_.turn) * part);
            if (state.around.plan().clearance(at) < state.plan.radius) return false;
        }
        Point const end = centre - curve_.radius * unit(side + curve_.turn);
        Radians const heading = state.pose.heading + curve_.turn + (curve_.radius < 0 ? std::numbers::pi : 0);
        return length == 0 || !wall_is_too_near(state.around.plan(), end, wrapped(heading), state.plan.radius);
    }

    void take(Seconds time, RobotPlan const& plan) {
        if (curve_.radius == 0) {
            if (time > on_the_spot_.shortest_time(plan)) on_the_spot_.take(time, plan);
            return;
        }
        Metres const radius = std::abs(curve_.radius), way = radius * std::abs(curve_.turn);
        double const acceleration = std::min(plan.max_acceleration, plan.max_turn_acceleration * radius);
        if (time > shortest(way, std::min(plan.max_speed, plan.max_turn_rate * radius), acceleration))
            fastest_ = pace(way, acceleration, time);
    }

    Twist drive(DriveState const& state, Progress& progress) {
        Metres const radius = std::abs(curve_.radius);
        Radians const left = std::abs(curve_.turn) - sign(curve_.turn) * turned_.by(state.pose.heading);
        bool const there = left * radius < at_place && left < at_heading;
        MetresPerSecond const fastest_to_stop =
            std::min(state.speed_to_stop_in(left * radius), std::abs(state.rate_to_stop_in(left)) * radius);
        MetresPerSecond const speed = there ? 0 : paced(fastest_to_stop, fastest_);
        stall_.update(state, is_slower_than(speed, state));
        progress.state = stall_.is_stalled() ? MotionState::obstructed : MotionState::moving;
        if (there && state.stand()) progress.state = MotionState::arrived;
        return {sign(curve_.radius) * speed, 0};
    }

    Curve curve_;
    TurnOnTheSpot on_the_spot_;
    std::optional<MetresPerSecond> fastest_;
    Turned turned_;
    bool started_ = false;
    StallDetector stall_;
};

class StayCourse : public Course {
public:
    Twist steer(DriveState const&, Progress&) override { return {}; }
};

}  // namespace

bool DriveState::stand() const { return std::abs(twist.linear) < 0.005 && std::abs(twist.angular) < 0.01; }

MetresPerSecond DriveState::speed_to_stop_in(Metres left) const {
    return std::min(plan.max_speed, braking(left, plan.max_acceleration, dt));
}

RadiansPerSecond DriveState::rate_to_stop_in(Radians left) const {
    return sign(left) * std::min(plan.max_turn_rate, braking(std::abs(left), plan.max_turn_acceleration, dt));
}

Accelerations driving(RobotPlan const& plan) { return {plan.max_acceleration, plan.max_turn_acceleration}; }

Accelerations stopping(RobotPlan const& plan) {
    return {std::max(plan.max_acceleration, plan.max_speed / RobotPlan::time_to_stop),
            std::max(plan.max_turn_acceleration, plan.max_turn_rate / RobotPlan::time_to_stop)};
}

Twist DriveState::next(Twist const& wanted, Accelerations const& limits, std::optional<Metres> circle) const {
    double const acceleration = circle ? std::min(limits.linear, limits.angular * std::abs(*circle)) : limits.linear;
    MetresPerSecond const linear = towards(twist.linear, wanted.linear, acceleration * dt);
    if (circle) return {linear, linear / *circle};
    RadiansPerSecond const rate = std::clamp(wanted.angular, -plan.max_turn_rate, plan.max_turn_rate);
    return {linear, towards(twist.angular, rate, limits.angular * dt)};
}

Pose moved(Pose const& from, Twist const& twist, Seconds time) {
    Radians const turned = twist.angular * time;
    Metres const gone = twist.linear * time;
    Metres const chord = std::abs(turned) < 1e-9 ? gone : gone * std::sin(turned / 2) / (turned / 2);
    return {from.position + chord * unit(from.heading + turned / 2), wrapped(from.heading + turned)};
}

void StallDetector::update(DriveState const& state, bool wants_to_move) {
    waited_ = wants_to_move && state.stand() ? waited_ + state.dt : 0;
}

std::unique_ptr<Course> course_of(Line line) { return std::make_unique<LineCourse>(line); }
std::unique_ptr<Course> course_of(Curve curve) { return std::make_unique<CurveCourse>(curve); }
std::unique_ptr<Course> course_of(Stay) { return std::make_unique<StayCourse>(); }

}  // namespace rois::simulation
