// Scripted components for the engine's tests.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "engine/local_component.hpp"
#include "types/profiles.hpp"

namespace rois {

// A device that runs the functions that were put on it when the engine next advances its devices.
class Stage final : public Device {
public:
    void put(std::function<void()> what) { waiting_.push_back(std::move(what)); }
    void advance(Instant now) override;

private:
    std::vector<std::function<void()>> waiting_;
};

// The reaction of a component to `start`.
enum class OnStart : std::uint8_t {
    acts,            // begins at once, and acts until the test ends it
    becomes_active,  // a continuous function: completes at once, and stays active
    is_done,         // completes at once
    stays_silent     // reports nothing; the test may report for it
};

// The properties of a component before it is added to the engine.
struct Part {
    std::string ref;
    ComponentProfile profile;
    OnStart on_start = OnStart::acts;
    std::vector<std::vector<std::string>> mandatory;  // groups of alternatives; each group needs one value for `start`
    CompletedStatus status_when_stopped = CompletedStatus::abort;
    std::string engine;  // name of the sub engine
    std::string crs{};   // the frame of its positions, and the parameters that are positions
    std::vector<std::string> positions{};
    std::vector<Codebooks> codebooks{};  // for its identifiers
    bool moves = false;
    bool confirms_binding = false;
};

class ScriptedComponent final : public LocalComponent {
public:
    ScriptedComponent(Part const& part, std::function<void(std::function<void()>)> happen);

    // The script. The test may change it at any time.
    OnStart on_start;
    ComponentStatus status_now = ComponentStatus::ready;
    // Calls that throw, or fail in another way: "nothing performed", "nothing known", "nothing right".
    std::set<std::string> throws_in;
    std::optional<int> accepts;                          // number of commands that `prepare` accepts; it refuses later ones
    bool throws_no_exception = false;                    // throws another type
    bool halts_later = false;                            // `halt` returns `not_yet`
    std::vector<std::string> calls;                      // the calls that it received
    std::function<void(std::string const& call)> watch;  // is called with each of them; may be empty
    ParameterList started_with;
    ParameterList changed_to;            // by the last set_parameter, or the end of a binding
    std::optional<ParameterList> reads;  // result of readable_parameters, instead of the usual one
    std::vector<Results> knows;          // rows of answers to queries, instead of the usual one
    std::optional<Located> where;        // nullopt: unknown

    // Reports of the component. The engine has handled each one when the call returns.
    void begins();
    void stands_still();  // confirms the halt
    void finishes(CompletedStatus = CompletedStatus::ok, Results = {}, Afterwards = Afterwards::as_before);
    void answers(CommandHandle, CompletedStatus = CompletedStatus::ok);
    void fires(std::string const& event_type, ParameterList results = {}, std::vector<Located> located = {});
    void reports(ErrorType, std::string const& text);
    CommandHandle latest() const { return latest_; }  // the newest command that it received

    ComponentDescription const& description() const override;
    ComponentStatus status() const override;
    Prepared prepare(std::string_view command_type, ParameterList const& parameters) override;
    Halted halt(Instant now) override;
    void suspend(Instant now) override;
    void resume(Instant now) override;
    void parameters_changed(ParameterList const& parameters, Instant now) override;
    std::optional<Located> location() const override;
    ParameterList readable_parameters() const override;
    std::vector<Results> query(std::string_view query_type, Instant now) override;

    // Returns whether the test has changed its state since the engine last saw it.
    bool has_changed() const;

private:
    void called(std::string const& name) const;
    void start(CommandHandle, ParameterList const& parameters);
    void perform(CommandHandle, std::string_view command_type, ParameterList const& arguments);

    Part part_;
    ComponentDescription description_;
    std::function<void(std::function<void()>)> happen_;
    CommandHandle latest_{};
    mutable std::optional<ComponentState> seen_;
};

// Included by nearly all profiles.
extern ComponentProfile const common;

// Drives. target_position is mandatory. Has the event `reached_target`, the command `dock` (side, left by default; times, 1;
// within 500 ms; results charge) and the query `route` (length, to).
extern Part const navigation;
// Speaks speech_text or SSML_text; setting one removes the other. `start` within 2 s.
extern Part const speech;
// Detects people, continuously. Has no parameters.
extern Part const detection;
// Locates people, continuously. Has the event `person_localized` (timestamp, person_ref, position_data).
extern Part const localization;
// Has a parameter of each type. Knows two codebooks for `owner`, none for `owners`.
extern Part const desk_lamp;

// The same part with another name, or in a sub engine.
Part named(std::string ref, Part part);
Part in_engine(std::string engine, Part part);

}  // namespace rois
