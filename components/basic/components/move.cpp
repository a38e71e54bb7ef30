// Move (7.6.15): a short motion relative to the robot's pose.
#include "basic/base/drive_action.hpp"
#include "basic/base/parameter_reading.hpp"
#include "basic/components/basic_components.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

// How long the robot waits for a blocked way.
constexpr WorldTime patience{10'000};

class Move final : public DriveAction {
public:
    explicit Move(Context context) : DriveAction{with_alternatives(std::move(context), {"line", "curve"}), "move"} {}

private:
    std::optional<std::string> parameter_problem(ParameterList const& parameters) const override {
        auto const line = integers_of(parameters, "line");
        auto const curve = integers_of(parameters, "curve");
        if (!line.empty() && !curve.empty()) return "'line' and 'curve' exclude each other: set only one of them";
        if (!line.empty() && line.size() != 2)
            return "parameter 'line' must be two numbers, distance (mm) and orientation (degree), not " +
                   std::to_string(line.size());
        if (!curve.empty() && curve.size() != 2)
            return "parameter 'curve' must be two numbers, radius (mm) and direction (degree), not " +
                   std::to_string(curve.size());
        return negative(parameters, "time");
    }

    std::variant<Plan, Refused> plan(ParameterList const& parameters) override {
        std::optional<Seconds> duration;
        if (auto const time = integer_of(parameters, "time").value_or(0); time > 0) duration = time / 1000.0;
        if (auto const line = integers_of(parameters, "line"); !line.empty())
            return way(Line{.distance = line[0] / 1000.0, .turn = from_degrees(line[1]), .duration = duration});
        if (auto const curve = integers_of(parameters, "curve"); !curve.empty())
            return way(Curve{.radius = curve[0] / 1000.0, .turn = from_degrees(curve[1]), .duration = duration});
        return Refused{"parameter 'line' or 'curve' is mandatory"};
    }

    Plan way(Motion motion) {
        return [this, motion = std::move(motion)] { drive(motion); };
    }

    void act() override {
        auto const state = progress().state;
        if (state == MotionState::arrived) return end(CompletedStatus::ok);
        if (over(state)) return end(CompletedStatus::error, "a wall or desk is in the way");
        if (blocked(state) >= patience) give_up(CompletedStatus::error, blocking_reason());
    }
};

}  // namespace

std::unique_ptr<LocalComponent> move(Context context) { return std::make_unique<Move>(std::move(context)); }

}  // namespace rois::basic
