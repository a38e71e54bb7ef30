// The components of the engine, with their parameters and bindings (decisions 4 to 7).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/agenda.hpp"
#include "engine/commands/command.hpp"
#include "engine/commands/parameters.hpp"
#include "engine/component.hpp"
#include "engine/component_index.hpp"
#include "engine/conditions/vocabulary.hpp"
#include "engine/frames/frames.hpp"
#include "engine/notifications/notification_queue.hpp"
#include "engine/providers/hosted_component.hpp"
#include "types/messages.hpp"

namespace rois {

struct Session;

// A halt that a component has not confirmed (decision 35).
struct UnconfirmedHalt {
    bool failed = false;                             // the component threw, or did not confirm in time; its status is ERROR
    Ticket first{};                                  // of the tickets that confirm it
    Deadlines::Ticket due;                           // when the time to confirm ends, or the next attempt begins
    std::vector<std::shared_ptr<Command>> waiting;   // commands that continue once the halt is confirmed
    std::vector<std::function<void(Instant)>> over;  // called once it is confirmed, has failed, or the component has left
};

// A component, and what the engine knows about it.
class RegisteredComponent final : public std::enable_shared_from_this<RegisteredComponent> {
public:
    // The state of the component's commands.
    enum class Activity : std::uint8_t { idle, running, active };

    // `profile` includes the messages of the sub components; `engine` is the name of the engine or sub engine that it belongs to.
    // Results in a frame of `frames` are converted to the engine's frame.
    RegisteredComponent(ComponentDescription const&, std::shared_ptr<HostedComponent>, ComponentProfile profile,
                        std::string engine, Agenda&, Frames const& frames);

    Identifier const& ref() const { return ref_; }
    ComponentEntry const& entry() const { return entry_; }
    // The ref without the name of its sub engine: "navigation" of "robot2.navigation".
    std::string_view code_in_engine() const { return std::string_view{ref_.code}.substr(code_begin_); }
    // The name of its provider; empty: it has none that others share.
    std::string const& provider() const { return provider_; }
    // The type in the form that conditions compare.
    std::string const& type_key() const { return type_key_; }
    bool moves() const { return moves_; }
    std::shared_ptr<ComponentTraits const> traits() const;  // for other engines
    // Includes the messages of the sub components, and the implied ones (add_parameter_messages).
    ComponentProfile const& profile() const { return *entry_.profile; }

    // The component itself. The calls return before the component has carried them out.
    HostedComponent& hosted() const { return *hosted_; }

    // Destroys the component, which has left the engine. The ref and the profile stay readable.
    void depart();
    bool has_departed() const { return has_departed_; }

    // Checks the results of a message against the profile. Invalid results are reported like an exception (decision 16).
    enum class Fit : std::uint8_t { right, wrong };
    Fit check(MessageKind, std::string_view message, Results const&, Report = Report::each);

    // Returns the rows of an answer to a query, in the engine's frame; none if they do not fit the profile.
    std::vector<Results> accepted(std::string_view query_type, std::vector<Results> rows);
    // Returns the results of an event in the engine's frame; null if they do not fit the profile.
    std::shared_ptr<Results const> accepted(EventOccurred const&);
    // Converts the results of a command to the engine's frame. If that is impossible, the command ends with ERROR.
    void accept(CommandEnded&);
    void accept(ComponentState);

    // The location and the parameters that the component has reported, and how often it has reported its state.
    Results reported() const;
    std::uint64_t reported_states() const { return reported_states_; }

    // The status, as `asker` sees it (decision 7).
    ComponentStatus status_for(Session const* asker) const;

    // The parameters that set_parameter accepts.
    std::vector<ParameterProfile> const& settable() const { return settable_; }
    // The stored parameters for the session that has bound the component; the defaults for all others (decision 30).
    ParameterList const& parameters_for(Session const* asker) const;
    // The answer of get_parameter to `asker`: parameters_for(), and parameters that the component has reported. Those that can
    // be set are returned only to the session that has bound it. Returns nullopt if the reported ones do not fit the profile.
    std::optional<ParameterList> all_parameters(Session const* asker) const;
    // Restores the default parameters at the end of a binding. Notifies the component if they changed.
    void restore_defaults(Instant now);
    // The stored parameters that are not the defaults.
    ParameterList changed_parameters() const;
    // Sets parameters from before a restart, unless the profile does not accept them any more. Notifies the component.
    void restore_parameters(ParameterList const&, Instant now);

    // The parameters that `start` accepts: settable(), and the arguments of the profile's own `start`, which are not stored.
    std::vector<ParameterProfile> const& startable() const { return startable_; }
    // Returns which argument without a default value is missing for `start`, or nullopt.
    std::optional<std::string> why_no_start(ParameterList const& normalized) const;
    // The parameters for `start`: the stored ones, and its arguments or their defaults.
    ParameterList for_start(ParameterList stored, ParameterList const& arrived) const;

    // For conditions. Read-only parameters count, too; a result may be that of an event or of a query. The position is nullopt
    // if it is unknown or the component failed.
    bool has_parameter(std::string_view name) const;
    bool has_result(std::string_view name) const;
    std::optional<Located> const& location() const { return state_.location; }

    // Returns which position is in a frame that is not among `known`, or nullopt. The parameters must be normalized.
    std::optional<std::string> why_no_frame(ParameterList const& normalized, Frames const& known) const;

    // Returns which identifier is from a codebook that the component does not know (decision 31), or nullopt. `profiles`: the
    // parameters' profiles. The parameters must be normalized.
    std::optional<std::string> why_no_codebook(std::vector<ParameterProfile> const& profiles,
                                               ParameterList const& normalized) const;

    // Converts positions to the component's frame. Returns nullopt if nothing needs conversion.
    std::optional<ParameterList> in_own_frame(ParameterList const&) const;

    // Returns `stored` with the new values. Of each group of alternatives, the newest ones are left.
    ParameterList merged(ParameterList stored, ParameterList const& arrived) const;
    CompletedStatus status_when_stopped() const { return status_when_stopped_; }
    bool confirms_binding() const { return confirms_binding_; }

    // A logical component stands for it (docs/choosing.md). Only conditions that name units can match it.
    bool is_member = false;
    // Of a logical component: the refs of its members.
    std::vector<std::string> const& members() const { return members_; }
    bool is_logical() const { return !members_.empty(); }
    Session* own_session = nullptr;

    Session* bound_to = nullptr;
    Switching switching = Switching::none;  // as agreed in the binding
    // Of a logical component that was bound by `bind_any`: the condition, which may sort its members.
    std::shared_ptr<QueryExpression const> preference;
    // The answer to the last command of this session, which comes before what the component reports to it (decision 22).
    NotificationQueue::Hold answer = 0;
    NotificationQueue::Hold answer_to(Session const& session) const { return bound_to == &session ? answer : 0; }
    std::size_t binds_asked = 0;  // questions whether it can be bound, without an answer
    bool is_free() const { return bound_to == nullptr && !has_failed_to_halt(); }
    ParameterList parameters;  // stored for the session that has bound it; the defaults without a binding
    Activity activity = Activity::idle;
    // `all`: everything is suspended. `some`: a command has begun after the suspension.
    enum class Suspended : std::uint8_t { nothing, some, all } suspended = Suspended::nothing;
    void note_begin() {
        stands_still = false;
        if (suspended == Suspended::all) suspended = Suspended::some;
    }
    // Returns whether an action or function runs that is not suspended.
    bool works() const { return suspended != Suspended::all && (activity != Activity::idle || !functions.empty()); }
    std::shared_ptr<Command> start;                   // whose action is running, or null
    std::vector<std::shared_ptr<Command>> functions;  // running commands of the component's own profile

    std::optional<UnconfirmedHalt> halting;
    bool has_failed_to_halt() const { return halting && halting->failed; }
    // Released, but perhaps still moving: it can be bound when this is over.
    bool is_being_halted() const { return bound_to == nullptr && halting && !halting->failed; }
    bool has_stood = false;     // has confirmed a halt at least once
    bool stands_still = false;  // has confirmed a halt, and nothing has begun since

    std::uint64_t halts = 0;  // how often it was halted
    std::uint64_t stops = 0;  // how often what it did was ended, other than by a `start` that replaces another

    // `suspend` was called for a lease that ended, and is not confirmed yet.
    bool is_being_held = false;

    // The component has thrown an exception, or reported something that does not fit its profile.
    void report_failure(std::string_view problem, Report);
    // The component has not answered in time. Its status is ERROR until its next report.
    void report_silence(std::string_view what, Steady now);
    // Reports COMPONENT_NOT_RESPONDING. The engines of several levels find the same silence at nearly the same time: it is
    // reported once.
    void report_no_response(std::string text, Report, Steady now);
    void end_silence() { is_silent_ = false; }
    void report(ErrorType, std::string text, Report);
    // Called after a command or query has succeeded.
    void clear_failure();
    // Called for a new binding: errors with Report::once are reported again.
    void forget_reported_errors() { reported_once_.clear(); }

private:
    // The types of a message's results; null if the profile has no such message.
    TypedProfiles const* results_of(MessageKind, std::string_view message) const;
    // Returns false, and reports the failure, if conversion is impossible.
    bool to_engine_frame(Results&, std::string_view message, Report);
    void notify_of_parameters(Instant now);
    void replace_alternatives(ParameterList& stored, ParameterList const& arrived) const;
    bool is_position(std::string_view parameter) const;

    std::shared_ptr<HostedComponent> hosted_;
    bool has_departed_ = false;
    bool failed_ = false;  // an exception left the component
    bool is_silent_ = false;
    std::set<ErrorType> reported_once_;   // errors that are not to be reported again
    std::optional<Steady> found_silent_;  // when COMPONENT_NOT_RESPONDING was reported last
    ComponentState state_;                // with normalized parameters, in the engine's frame
    std::uint64_t reported_states_ = 0;
    bool fits_ = true;  // the reported parameters fit the profile
    std::string provider_;
    Identifier ref_;
    std::size_t code_begin_ = 0;  // where its code within its engine begins
    ComponentEntry entry_;
    std::string type_key_;
    std::vector<ParameterProfile> settable_;
    ParameterList defaults_;                         // of settable_
    std::vector<ParameterProfile> start_arguments_;  // of the profile's own `start`, without settable_
    std::vector<ParameterProfile> startable_;        // settable_ and start_arguments_
    std::vector<ParameterProfile> readable_;         // parameters that get_parameter returns
    std::vector<TypedProfiles> results_;             // the result types of the profile's messages, in their order
    Agenda& agenda_;
    Frames const& frames_;
    std::string crs_;
    bool moves_ = false;
    std::vector<std::string> positions_;
    std::vector<Codebooks> codebooks_;
    std::vector<std::vector<std::string>> alternatives_;
    CompletedStatus status_when_stopped_;
    bool confirms_binding_;
    std::vector<std::string> members_;
};

// All components of the engine, by ref.
class Registry {
public:
    using Components = std::map<std::string, std::shared_ptr<RegisteredComponent>, std::less<>>;

    // Throws std::runtime_error if the ref is taken.
    RegisteredComponent& add(std::shared_ptr<RegisteredComponent>);

    void remove(RegisteredComponent const&);

    // Sets RegisteredComponent::is_member. Call it after components were added or removed.
    void mark_members() noexcept;
    std::vector<RegisteredComponent*> const& logical() const { return logical_; }

    RegisteredComponent* find(std::string_view ref) const;  // null when unknown

    // The result of looking up a component_ref. If no component is found, `component` is null and `problem` says why: the code is
    // unknown to the asker, or the codebook or authority does not belong to components (decision 31).
    struct Lookup {
        RegisteredComponent* component = nullptr;
        std::string problem;
    };
    Lookup meant(Identifier const& component_ref, Session const& asker) const;

    Components const& all() const { return components_; }
    // The components that move the robot.
    std::vector<RegisteredComponent*> const& moving() const { return moving_; }

    // Returns the components that can meet the demand; all of them without a demand.
    ComponentsInOrder possible(std::optional<Demand> const& demand, View view) const { return index_.possible(demand, view); }

    // The components whose profile has this message.
    ComponentIndex const& with(MessageKind kind, std::string_view message) const { return providers(kind, message).components; }

    // The results of this message in the profiles of the components that a client sees, for conditions. Valid until the
    // components change.
    Declarations const& results(MessageKind, std::string_view message, Rights const*) const;
    // The parameters of these components. Valid until the components change.
    Declarations const& parameters(Rights const*) const;

    enum class Bound : std::uint8_t { ok, taken, not_halted };
    static Bound bind(RegisteredComponent&, Session&, Instant now);

private:
    // By the patterns of those who see them; nullopt: everything. They are collected when they are needed.
    using Seen = std::map<std::optional<std::vector<std::string>>, Declarations>;

    // The components that have a message, and its results.
    struct Providers {
        ComponentIndex components;
        mutable Seen results;
    };
    using ByName = std::map<std::string, Providers, std::less<>>;

    Providers& change(MessageProfile const&);
    Providers const& providers(MessageKind, std::string_view message) const;

    Components components_;
    std::vector<RegisteredComponent*> moving_;
    std::vector<RegisteredComponent*> logical_;
    ComponentIndex index_;
    mutable Seen parameters_;
    std::map<MessageKind, ByName> by_message_;
};

}  // namespace rois
