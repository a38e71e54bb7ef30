// Wheelchair robot (Annex C.4): navigation with brakes, a preferred speed and a state whose changes are reported. The robot is
// the wheelchair: brakes, speed and state apply to motions of all its components.
#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "basic/adapters/example_components.hpp"
#include "basic/base/parameter_reading.hpp"
#include "basic/components/navigation.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

// Returns "3250.5".
std::string one_decimal(double value) {
    std::array<char, 32> text{};
    auto const end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 1).ptr;
    return {text.data(), end};
}

class WheelchairRobot final : public Navigation {
public:
    explicit WheelchairRobot(Context context) : Navigation{std::move(context), "wheelchair_robot"} {}

    void parameters_changed(ParameterList const& parameters, Instant) override { base().limit_speed(speed_of(parameters)); }

    Prepared prepare_command(std::string_view, ParameterList const& arguments) override {
        return [this, on = is_true(arguments, "status")](CommandHandle command, Instant) { brake(command, on); };
    }

    void brake(CommandHandle command, bool on) {
        base().brake(on);
        if (auto const earlier = std::exchange(braking_, {}))
            port().completed(*earlier, on ? CompletedStatus::ok : CompletedStatus::abort, {}, Afterwards::as_before,
                             on ? "" : "the brakes were released before the wheelchair stood");
        port().started(command);
        if (on && !base().status().stands) {
            braking_ = command;
        } else {
            port().completed(command, CompletedStatus::ok);
        }
    }

    std::vector<Results> query(std::string_view query_type, Instant) override {
        if (query_type != "wc_status_change") return {};
        return one_row(state_results(state()));
    }

private:
    struct State {
        bool brakes = false;
        bool pause = false;
        std::string_view wheelchair;
        std::string_view navigation;

        bool operator==(State const&) const = default;
    };

    std::optional<std::string> parameter_problem(ParameterList const& parameters) const override {
        auto const speed = to_double(text_of(parameters, "preferred_max_speed"));
        if (speed && !(*speed > 0))
            return "parameter 'preferred_max_speed' must be more than 0 mm/s, not " +
                   std::string{text_of(parameters, "preferred_max_speed")};
        auto const mode = text_of(parameters, "navigation_mode");
        if (!mode.empty() && mode != "Location" && mode != "Tag")
            return "parameter 'navigation_mode' must be 'Location' or 'Tag', not " + quoted(mode);
        auto const tag = text_of(parameters, "behaviour_tag");
        auto const& places = body().places();
        if (!tag.empty() && std::ranges::find(places, tag, &NamedPlace::name) == places.end())
            return "parameter 'behaviour_tag': " + quoted(tag) + " is not one of the places " + listed(places, &NamedPlace::name);
        return Navigation::parameter_problem(parameters);
    }

    std::variant<Plan, Refused> plan(ParameterList const& parameters) override {
        std::string tag{text_of(parameters, "behaviour_tag")};
        if (goes_by_tag(parameters) && tag.empty())
            return Refused{"parameter 'behaviour_tag' is mandatory when 'navigation_mode' is 'Tag'"};
        auto way = goes_by_tag(parameters) ? visit({std::move(tag)}, parameters) : Navigation::plan(parameters);
        auto const* set_out = std::get_if<Plan>(&way);
        if (set_out == nullptr) return way;
        return [this, speed = speed_of(parameters), set_out = *set_out] {
            base().limit_speed(speed);
            set_out();
        };
    }

    static bool goes_by_tag(ParameterList const& parameters) { return text_of(parameters, "navigation_mode") == "Tag"; }

    static std::optional<double> speed_of(ParameterList const& parameters) {
        auto const speed = to_double(text_of(parameters, "preferred_max_speed"));
        return speed ? std::optional{*speed / 1000} : std::nullopt;
    }

    State state() const {
        auto const status = base().status();
        auto const& motion = status.motion;
        State now{.brakes = status.brakes,
                  .pause = motion == MotionState::held,
                  .wheelchair = "stopped",
                  .navigation = motion ? "running" : "stopped"};
        if (now.brakes) {
            now.wheelchair = "brakes";
        } else if (now.pause) {
            now.wheelchair = "paused";
        } else if (motion == MotionState::obstructed) {
            now.wheelchair = "obstacle";
        } else if (motion || !status.stands) {
            now.wheelchair = "running";
        } else if (status.last_outcome == MotionState::unreachable) {
            now.wheelchair = "path_error";
        }
        return now;
    }

    Results state_results(State const& state) const {
        auto const place = located_entity("position", body().name(), body().pose(), 0, {}).position;
        return {{text("position", one_decimal(place[0]) + ", " + one_decimal(place[1])), boolean("brake_status", state.brakes),
                 boolean("pause_status", state.pause), text("wc_status", std::string{state.wheelchair}),
                 text("nav_status", std::string{state.navigation})},
                {}};
    }

    void watch(Instant) override {
        if (braking_ && base().status().stands) port().completed(*std::exchange(braking_, {}), CompletedStatus::ok);
        auto const now = state();
        if (reported_ && *reported_ != now) port().event("wc_status_change", state_results(now));
        reported_ = now;
    }

    std::optional<CommandHandle> braking_;  // a `brake` that completes when the wheelchair stands
    std::optional<State> reported_;
};

}  // namespace

std::unique_ptr<LocalComponent> wheelchair_robot(Context context) {
    return std::make_unique<WheelchairRobot>(std::move(context));
}

}  // namespace rois::basic
