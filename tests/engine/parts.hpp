// The parts of the world that the engine's tests play in: components that do as the test says.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/component.hpp"
#include "engine/engine.hpp"
#include "types/profiles.hpp"

namespace rois {

// Where things happen by themselves: what is put on it is done when the engine next advances its devices.
class Stage final : public Device {
public:
    void put(std::function<void()> what) { waiting_.push_back(std::move(what)); }
    void advance(Instant now) override;

private:
    std::vector<std::function<void()>> waiting_;
};

// What a component does when it is told to start.
enum class OnStart : std::uint8_t {
    acts,            // begins at once, and goes on until the test ends it
    becomes_active,  // a continuous function: completes at once, and stays active
    is_done,         // completes at once
    stays_silent     // says nothing; the test may speak for it
};

// A component of the world, as it is before the engine has it.
struct Part {
    std::string ref;
    ComponentProfile profile;
    OnStart on_start = OnStart::acts;
    std::vector<std::vector<std::string>> mandatory;  // of each group of alternatives, one value must be there to start
    CompletedStatus status_when_stopped = CompletedStatus::abort;
    std::string engine;  // of a sub engine
    std::string crs{};   // the frame in which it takes positions, and which parameters are positions
    std::vector<std::string> positions{};
    std::vector<Codebooks> codebooks{};  // from which it takes identifiers
    bool moves = false;
};

class ScriptedComponent final : public Component {
public:
    ScriptedComponent(Part const& part, std::function<void(std::function<void()>)> happen);

    // The script: may be changed at any time.
    OnStart on_start;
    ComponentStatus status_now = ComponentStatus::ready;
    // Names of calls that an exception leaves; or how else they go wrong: "nothing performed", "nothing known", "nothing right".
    std::set<std::string> throws_in;
    bool throws_no_exception = false;  // but something else
    bool halts_later = false;          // says `not_yet` when told to halt
    std::vector<std::string> told;     // the calls that reached it
    ParameterList started_with;
    ParameterList changed_to;            // the last parameters_changed
    std::optional<ParameterList> reads;  // readable_parameters, instead of what it says otherwise
    std::vector<Results> knows;          // rows that it answers queries with, instead of what it says otherwise
    std::optional<Located> where;        // nothing: nobody knows

    // What it says by itself; the engine has heard it when the call returns.
    void begins();
    void stands_still();  // confirms the halt
    void finishes(CompletedStatus = CompletedStatus::ok, Results = {}, Afterwards = Afterwards::as_before);
    void answers(CommandHandle, CompletedStatus = CompletedStatus::ok);
    void fires(std::string const& event_type, ParameterList results = {}, std::vector<Located> located = {});
    void reports(ErrorType, std::string const& text);
    CommandHandle latest() const { return latest_; }  // the command that it was told last

    ComponentDescription const& description() const override;
    void attach(ComponentPort& port) override { port_ = &port; }
    ComponentStatus status() const override;
    std::optional<std::string> refusal(std::string_view command_type, ParameterList const& parameters) const override;
    void reconcile(ParameterList& stored, ParameterList const& arrived) const override;
    void start(CommandHandle, ParameterList const& parameters, Instant now) override;
    Halted halt(Instant now) override;
    void suspend(Instant now) override;
    void resume(Instant now) override;
    void parameters_changed(ParameterList const& parameters, Instant now) override;
    void perform(CommandHandle, std::string_view command_type, ParameterList const& arguments, Instant now) override;
    CompletedStatus status_when_stopped() const override;
    std::optional<Located> location() const override;
    ParameterList readable_parameters() const override;
    std::vector<Results> query(std::string_view query_type, Instant now) override;

private:
    void called(std::string const& name) const;

    Part part_;
    ComponentDescription description_;
    std::function<void(std::function<void()>)> happen_;
    ComponentPort* port_ = nullptr;
    CommandHandle latest_{};
};

// What nearly all profiles include.
extern ComponentProfile const common;

// Drives: target_position is mandatory; tells `reached_target`; has the command `dock` (side, left by default; times, 1; within
// 500 ms; results charge) and the query `route` (length, to).
extern Part const navigation;
// Speaks: speech_text or SSML_text, of which the later replaces the earlier; `start` within 2 s.
extern Part const speech;
// Detects people, continuously; has no parameters.
extern Part const detection;
// Finds people, continuously; tells `person_localized` (timestamp, person_ref, position_data).
extern Part const localization;
// Has a parameter of each type; knows two codebooks for `owner`, none for `owners`.
extern Part const desk_lamp;

// The same part under another name; and of a sub engine.
Part named(std::string ref, Part part);
Part in_engine(std::string engine, Part part);

}  // namespace rois
