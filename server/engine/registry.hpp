// Which components exist, what is stored for them, and who has bound them (decisions 4 to 7).
#pragma once

#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/agenda.hpp"
#include "engine/command.hpp"
#include "engine/component.hpp"
#include "engine/component_index.hpp"
#include "engine/frames.hpp"
#include "engine/parameters.hpp"
#include "engine/vocabulary.hpp"
#include "types/messages.hpp"

namespace rois {

struct Session;

// A halt that a component has not confirmed (decision 35).
struct UnconfirmedHalt {
    bool failed = false;                            // the component threw, or did not confirm in time: its status is ERROR
    Deadlines::Ticket due;                          // the end of that time, or the next attempt
    std::vector<std::shared_ptr<Command>> waiting;  // commands that continue when it is confirmed; empty once it has failed
};

// A component as the engine has it. It is the component's port.
class RegisteredComponent final : public ComponentPort, public std::enable_shared_from_this<RegisteredComponent> {
public:
    // What the component does, as far as commands are concerned.
    enum class Activity : std::uint8_t { idle, running, active };

    // `profile` has the messages of the sub components; `engine` is the name of the engine or sub engine that has it. What it
    // tells in a frame of `frames` is told on in the engine's own.
    RegisteredComponent(std::unique_ptr<Component>, ComponentProfile profile, std::string engine, Agenda&, Frames const& frames);

    Identifier const& ref() const { return ref_; }
    ComponentEntry const& entry() const { return entry_; }
    // Its ref without the name of its sub engine: "navigation" of "robot2.navigation".
    std::string_view code_in_engine() const { return std::string_view{ref_.code}.substr(code_begin_); }
    // Its type as conditions compare it.
    std::string const& type_key() const { return type_key_; }
    bool moves() const { return moves_; }
    // With the messages of the sub components, and those that go without saying.
    ComponentProfile const& profile() const { return *entry_.profile; }

    // The component goes; what knows it still can read its ref and profile, and all calls fail without a word.
    void depart() { component_.reset(); }
    bool has_departed() const { return component_ == nullptr; }

    // Asks or tells the component something. An exception that leaves it is reported and makes its status ERROR (decision 16).
    enum class Called : std::uint8_t { ok, failed };
    template <class What>
    Called call(What const& what, Report = Report::each) const;

    // Whether these results of a message are what the profile says; wrong ones are reported as an exception is (decision 16).
    enum class Answer : std::uint8_t { right, wrong };
    Answer check(MessageKind, std::string_view message, Results const&, Report = Report::each) const;

    // What it answers to a query of its profile, a row or several; none when it failed, cannot answer, or answers wrong.
    std::vector<Results> answer(std::string_view query_type, Instant now) const;

    // Decision 7: as `asker` sees it.
    ComponentStatus status_for(Session const* asker) const;

    // What a component of this type may be told by set_parameter.
    std::vector<ParameterProfile> const& settable() const { return settable_; }
    // Decision 30: what is stored, for the session that has it bound; the defaults for every other asker.
    ParameterList const& parameters_for(Session const* asker) const;
    // What get_parameter answers to `asker`: parameters_for(), and beside them what the component reads. A parameter that an
    // application can set is read for the session that has the component bound only. Nothing when the component failed, or reads
    // what is not of the profile's type; what the profile has not is not told.
    std::optional<ParameterList> all_parameters(Session const* asker) const;
    // The end of a binding: stores the defaults again, and tells the component if that changed anything.
    void restore_defaults(Instant now);

    // What `start` takes: those, and the arguments of the profile's own `start`, which are not stored.
    std::vector<ParameterProfile> const& startable() const { return startable_; }
    // Why the component cannot start with what arrived: an argument that has no default value is not there.
    std::optional<std::string> why_no_start(ParameterList const& normalized) const;
    // What is stored, and what `start` was given beside it or has by default.
    ParameterList for_start(ParameterList stored, ParameterList const& arrived) const;

    // What conditions ask: whether it has such a parameter, be it only to be read, or an event or a query with such a result; and
    // where it is, nothing also when it failed.
    bool has_parameter(std::string_view name) const;
    bool tells(std::string_view name) const;
    std::optional<Located> location() const;

    // Why these parameters cannot be taken: positions are in a frame that nobody knows. `normalized` ones.
    std::optional<std::string> why_no_frame(ParameterList const& normalized) const;

    // Why these parameters cannot be taken: an identifier is from a codebook that the component does not know (decision 31).
    // `profiles` are those that the parameters were checked against; `normalized` ones.
    std::optional<std::string> why_no_codebook(std::vector<ParameterProfile> const& profiles,
                                               ParameterList const& normalized) const;

    // The parameters with positions in the component's own frame; nothing when it takes them as they are.
    std::optional<ParameterList> in_own_frame(ParameterList const&) const;

    // `stored` with what arrived to be stored, as the component reconciles the two; nothing when it failed.
    std::optional<ParameterList> merged(ParameterList stored, ParameterList const& arrived) const;

    Session* bound_to = nullptr;
    bool is_free() const { return bound_to == nullptr && !has_failed_to_halt(); }
    ParameterList parameters;  // stored for the session that has it bound; the defaults without a binding
    Activity activity = Activity::idle;
    // `some`: a command has begun since the component was suspended.
    enum class Suspended : std::uint8_t { nothing, some, all } suspended = Suspended::nothing;
    void something_begins() {
        if (suspended == Suspended::all) suspended = Suspended::some;
    }
    // Whether an action or a function runs that is not suspended.
    bool works() const { return suspended != Suspended::all && (activity != Activity::idle || !functions.empty()); }
    std::shared_ptr<Command> start;                   // whose action runs, or null
    std::vector<std::shared_ptr<Command>> functions;  // those of its own profile that run

    std::optional<UnconfirmedHalt> halting;
    bool has_failed_to_halt() const { return halting && halting->failed; }
    bool has_stood = false;  // it has confirmed a halt, at least once

    // It answered a command, but there was no memory to keep the answer. The engine does not know what the component does now.
    bool answer_lost = false;

    // A command or query of it: what failed before is over.
    void succeeded();
    // Whoever has bound it now has heard nothing of it yet.
    void bound_anew() { told_once_.clear(); }

    void started(CommandHandle) override;
    void completed(CommandHandle, CompletedStatus, Results, Afterwards, std::string reason) override;
    void halted() override;
    void event(std::string_view event_type, Results) override;
    void error(ErrorType, std::string text, Report) override;

private:
    // What a message tells; null when the profile has no such message.
    TypedProfiles const* results_of(MessageKind, std::string_view message) const;
    // Never throws: if memory runs out, the failure is not reported.
    void report_failure(std::string_view problem, Report) const noexcept;
    void report(ErrorType, std::string text, Report) const;
    // Nothing when it failed, because what it told cannot be told in the engine's frame.
    std::optional<Results> told(Results, std::string_view message, Report) const;
    std::optional<ParameterList> reconciled(ParameterList stored, ParameterList const& arrived) const;
    bool is_position(std::string_view parameter) const;

    std::unique_ptr<Component> component_;
    mutable bool failed_ = false;            // an exception left it
    mutable std::set<ErrorType> told_once_;  // and not to be told so again
    Identifier ref_;
    std::size_t code_begin_ = 0;  // of its code within its engine
    ComponentEntry entry_;
    std::string type_key_;
    std::vector<ParameterProfile> settable_;
    ParameterList defaults_;                         // of these
    std::vector<ParameterProfile> start_arguments_;  // of the profile's own `start`, beside them
    std::vector<ParameterProfile> startable_;        // both
    std::vector<ParameterProfile> readable_;         // by get_parameter
    std::vector<TypedProfiles> results_;             // of the profile's messages, in their order
    Agenda& agenda_;
    Frames const& frames_;
    std::string crs_;
    bool moves_ = false;
    std::vector<std::string> positions_;
    std::vector<Codebooks> codebooks_;
};

template <class What>
RegisteredComponent::Called RegisteredComponent::call(What const& what, Report report) const {
    if (!component_) return Called::failed;
    try {
        what(*component_);
        return Called::ok;
    } catch (std::exception const& exception) {
        report_failure(exception.what(), report);
    } catch (...) {
        report_failure("an unknown exception left the component", report);
    }
    return Called::failed;
}

// All components of the engine, by ref.
class Registry {
public:
    using Components = std::map<std::string, std::shared_ptr<RegisteredComponent>, std::less<>>;

    // Throws std::runtime_error when the ref is taken.
    RegisteredComponent& add(std::shared_ptr<RegisteredComponent>);

    // Nobody finds it any more.
    void remove(RegisteredComponent const&);

    RegisteredComponent* find(std::string_view ref) const;  // null when unknown

    // The component that an application means. Else `component` is null and `problem` says why: no component has this code, or
    // the code is from the codebook or of the authority of something else (decision 31).
    struct Meant {
        RegisteredComponent* component = nullptr;
        std::string problem;
    };
    Meant meant(Identifier const& component_ref) const;

    Components const& all() const { return components_; }
    // The components that move the robot.
    std::vector<RegisteredComponent*> const& moving() const { return moving_; }

    // The components that alone can meet the demand; all when there is none.
    ComponentsInOrder possible(std::optional<Demand> const& demand) const { return everybody_.possible(demand); }

    // The components whose profile has this message.
    ComponentIndex const& with(MessageKind kind, std::string_view message) const { return tellers(kind, message).components; }

    // What those components tell with this message, as all their profiles say it. Good until the next change.
    Declarations const& results(MessageKind, std::string_view message) const;

    // The parameters of all components: what conditions may speak of. Good until the next change.
    Declarations const& parameters() const;

    enum class Bound : std::uint8_t { ok, taken, not_halted };
    static Bound bind(RegisteredComponent&, Session&, Instant now);

private:
    // Who has a message, and what they tell with it: nothing when that is to be gathered anew.
    struct Tellers {
        ComponentIndex components;
        mutable std::optional<Declarations> results;
    };
    using ByName = std::map<std::string, Tellers, std::less<>>;

    Tellers& change(MessageProfile const&);
    Tellers const& tellers(MessageKind, std::string_view message) const;

    Components components_;
    std::vector<RegisteredComponent*> moving_;
    ComponentIndex everybody_;
    mutable std::optional<Declarations> parameters_;  // nothing when they are to be gathered anew
    std::map<MessageKind, ByName> by_message_;
};

}  // namespace rois
