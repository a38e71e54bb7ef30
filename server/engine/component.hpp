// The interface between the engine and its components: links to other engines and programs implement `Component`; drivers and
// simulations in this process derive from `LocalComponent` (local_component.hpp), which is simpler.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "types/codes.hpp"
#include "types/instant.hpp"
#include "types/messages.hpp"
#include "types/profiles.hpp"
#include "types/values.hpp"

namespace rois {

// Identifies a command between the engine and a component. Unique for the life of the engine; a command_id is not.
enum class CommandHandle : std::uint64_t {};

// Identifies a question of the engine to a component. Unique for the life of the engine, and ascending.
enum class Ticket : std::uint64_t {};

// The constant properties of a component.
struct ComponentDescription {
    Identifier ref;                                   // code = the instance's name, unique in the engine (decision 25)
    std::string engine;                               // name of the sub engine that it belongs to; empty for the main engine
    std::shared_ptr<ComponentProfile const> profile;  // without the messages of its sub components, which the engine adds

    // Components and devices with the same provider are called one at a time. Empty: the component is a provider of its own.
    std::string provider;
    // Whether all calls to the component return at once. If not, its provider has a thread of its own. A component that may block
    // and says `true` delays the clients whose requests it serves.
    bool returns_at_once = false;

    // The frame of the positions that the component receives; empty: the engine's. Positions that the component reports name
    // their frame themselves (codebook_ref, crs).
    std::string crs;
    // The parameters that hold positions (located data, decision 27). Without a frame, they are in the engine's frame; an unknown
    // frame is rejected. Other parameters count as positions if they name a known frame.
    std::vector<std::string> positions;
    // The codebooks that each identifier parameter accepts; the engine rejects all others. A codebook that the profile declares
    // for the parameter (codebook_ref of data_type_ref) is accepted too, and is the default.
    std::vector<Codebooks> codebooks{};
    // Groups of parameters of which only the newest is stored, such as `line` and `curve`. If several of a group arrive together,
    // all are stored.
    std::vector<std::vector<std::string>> alternatives{};
    // The status of a `start` that `stop` ends: ABORT, except for Follow (decision 8).
    CompletedStatus status_when_stopped = CompletedStatus::abort;
    // Whether the component moves the robot or a part of it. Such a component acts only while its application gives signs of life
    // (decision 33).
    bool moves = false;
    // Whether `bind` must be asked before the component is bound.
    bool confirms_binding = false;
    // Of a logical component (docs/choosing.md): the refs of its members, which need not be there. Only conditions that name
    // units match them. The component uses them as an application does, in a session of its own: see ComponentPort::ask.
    std::vector<std::string> members{};
};

// A binding that an application asks for. `order`: the members of a logical component, in the sort order of the application's
// condition; empty: it has none. `parameters`: those that the application has set before the engine was restarted; for components
// of other engines, which bind the component again.
struct Binding {
    std::uint64_t session = 0;  // the number of the application's session
    Switching switching = Switching::none;
    std::vector<std::string> order{};
    ParameterList parameters{};
};

// What the engine knows of a component's state between two reports.
struct ComponentState {
    ComponentStatus status = ComponentStatus::uninitialized;  // not `busy`: the engine knows who has bound the component
    std::optional<Located> location;                          // the present position; `ref` names the robot
    ParameterList parameters;                                 // the read-only ones of get_parameter (recognizable languages, ...)

    bool operator==(ComponentState const&) const = default;
};

// The state of a component after one of its commands has completed.
enum class Afterwards : std::uint8_t {
    as_before,  // a continuous function that was active before the command stays active
    active,     // a continuous function is active until it is stopped (detection, recognition, an open stream, ...)
    idle        // no function is active
};

// How often a repeated failure is reported. `each`: every time. `once`: until the component succeeds or another session binds it.
// Use `once` for failures that any client can cause at any time.
enum class Report : std::uint8_t { each, once };

// --- Answers of a component ---

// A command that `prepare` has checked and is ready to begin. The engine calls it as it calls the component.
using Begin = std::function<void(CommandHandle, Instant now)>;
struct Refused {
    std::string reason;  // why the component can never carry out this command with these parameters
};
struct Done {};
struct Failed {
    std::string reason;
};
// Done: bind, suspend, resume. Begin: prepare. Rows of results: query; no row if it cannot answer.
using ComponentAnswer = std::variant<Done, Begin, Refused, Failed, std::vector<Results>>;

// --- Reports of a component ---

struct CommandStarted {
    CommandHandle command;
};

struct CommandEnded {
    CommandHandle command;
    CompletedStatus status = CompletedStatus::ok;
    Results results{};
    Afterwards afterwards = Afterwards::as_before;
    std::string reason{};
};

struct HaltConfirmed {
    Ticket ticket;
};

// The component has not stopped. The engine calls `halt` again.
struct HaltFailed {
    Ticket ticket;
};

struct EventOccurred {
    std::string event_type;
    std::shared_ptr<Results const> results;
};

struct ErrorOccurred {
    ErrorType type;
    std::string text;
    Report report = Report::each;
};

struct Answered {
    Ticket ticket;
    ComponentAnswer answer;
};

using StateChanged = std::shared_ptr<ComponentState const>;

// An operation in the component's own session. `then` is called later, as the engine calls the component. Null: the operation was
// not performed.
struct OperationAsked {
    using Then = std::function<void(Reply const*)>;
    Operation operation;
    Then then;
};

// A logical component goes on with another member.
struct MemberSwitched {
    std::string from;  // refs
    std::string to;
    std::string reason;
};

using ComponentReport = std::variant<CommandStarted, CommandEnded, HaltConfirmed, HaltFailed, EventOccurred, ErrorOccurred,
                                     StateChanged, Answered, OperationAsked, MemberSwitched>;

// The component's way to report to the engine, which owns the port. Thread-safe. All functions return at once: the engine handles
// the reports of a provider in their order. The port lives as long as the component.
class ComponentPort {
public:
    virtual ~ComponentPort() = default;

    virtual void report(ComponentReport&&) = 0;

    // Returns whether many reports of this provider wait for the engine: a link should not read more of them now. Any thread.
    virtual bool is_full() const { return false; }

    // The answer to a question. Each ticket may be answered once; late answers are counted and ignored.
    void answered(Ticket ticket, ComponentAnswer answer) { report(Answered{ticket, std::move(answer)}); }

    // The state has changed. Until the first report the status is UNINITIALIZED.
    void changed(ComponentState state) { report(std::make_shared<ComponentState const>(std::move(state))); }

    // The command has begun to act. Must be called within the profile's timeout (decision 16). `completed` includes it.
    void started(CommandHandle command) { report(CommandStarted{command}); }

    // The command has ended. Must be called once for each command. A report for a command that has already ended is counted and
    // ignored. `reason` says, for people, why the status is not OK; it becomes the result `reason` of get_command_result.
    void completed(CommandHandle command, CompletedStatus status, Results results = {},
                   Afterwards afterwards = Afterwards::as_before, std::string reason = {}) {
        report(CommandEnded{command, status, std::move(results), afterwards, std::move(reason)});
    }

    // The component stands still, as asked by the `halt` with this ticket.
    void halted(Ticket ticket) { report(HaltConfirmed{ticket}); }

    // An event of the profile occurred.
    void event(std::string_view event_type, Results results) {
        report(EventOccurred{std::string{event_type}, std::make_shared<Results const>(std::move(results))});
    }

    // Reports an error, with or without a command that failed. `text` is for people.
    void error(ErrorType type, std::string text, Report each = Report::each) {
        report(ErrorOccurred{type, std::move(text), each});
    }

    // For logical components: an operation in the component's own session, and a switch.
    void ask(Operation operation, OperationAsked::Then then) { report(OperationAsked{std::move(operation), std::move(then)}); }
    void switched(std::string from, std::string to, std::string reason) {
        report(MemberSwitched{std::move(from), std::move(to), std::move(reason)});
    }
};

// A component. The engine calls it from one thread at a time, and is not locked meanwhile. A question, which has a ticket, is
// answered through the port: within the call or later, from any thread. The engine waits for an answer for question_deadline.
// The engine enforces the rules that all components share (7.6): bindings, `stop` during `start`, parameter values, frames. It
// calls a component only for operations that are allowed now. If a call throws, the question or command of the call ends with
// ERROR, and the engine reports COMPONENT_INTERNAL_ERROR; other commands are not affected.
class Component {
public:
    virtual ~Component() = default;

    // Called at any time, from any thread.
    virtual ComponentDescription const& description() const = 0;

    // Called once, before all functions below. The port stays valid as long as the component.
    virtual void attach(ComponentPort&) = 0;

    // Asks whether an application may bind the component now; only if the description has `confirms_binding`.
    virtual void bind(Ticket, Binding const&, Instant now);
    // The binding has ended, or was not made after `bind`.
    virtual void released(Instant) {}

    // Asks whether the component can carry out this command with these parameters. The answer is `Begin` or `Refused`, and must
    // not depend on the present situation. For `start` and set_parameter, `parameters` has all parameters that will be stored
    // when the command runs; for other commands, the arguments. Called for each unit of a sequence before any of them runs. The
    // engine halts a running action before it begins `start`. A set_parameter completes like all other commands.
    virtual void prepare(Ticket, std::string_view command_type, ParameterList const& parameters, Instant now) = 0;

    // Ends every running action, function and command at once. The engine reports the commands as completed, `start` with
    // `status_when_stopped`. The engine may call this at any time, also when the component is idle. It starts nothing on the
    // component until the halt is confirmed: ComponentPort::halted. If the component throws, or does not confirm within 0.5 s,
    // the engine calls this again every 0.2 s, with a new ticket (decision 35). Any of the tickets confirms.
    virtual void halt(Ticket, Instant now) = 0;

    // Pauses the running action or function, and continues it. Answered with `Done`.
    virtual void suspend(Ticket, Instant now) = 0;
    virtual void resume(Ticket, Instant now) = 0;

    // The parameters are the defaults again, because a binding began or ended. The component may be running.
    virtual void parameters_changed(ParameterList const& parameters, Instant now);

    // Asks a query of the profile, except component_status and get_parameter. The answer is one row of results for each match,
    // such as one for each stream; none if it cannot answer. The engine answers with the first row that meets the condition.
    virtual void query(Ticket, std::string_view query_type, Instant now) = 0;

    // For logical components. Their session has begun: it has no bindings, commands and subscriptions. Usually called once.
    virtual void session_began(Instant) {}
    // For a logical component: the engine has ended the binding of this member in the component's own session.
    virtual void member_freed(std::string const& /*ref*/) {}
    // The same for the order of its members by the condition of `bind_any`, before each command.
    virtual void members_ordered(std::vector<std::string> const& /*refs*/) {}
    // A notification of the session, which receives what the session of an engine receives (decision 39), but component_changed
    // only for the members. UNINITIALIZED: the member is not there.
    virtual void notified(Notification const&, Instant) {}

    // Called after all calls except queries and questions, and after each advance of a device of its provider.
    virtual void after_call() {}
};

// An object that several components share and that changes with time, such as a simulated world. It belongs to the provider with
// this name, and is advanced by the engine's clock only.
class Device {
public:
    virtual ~Device() = default;
    virtual void advance(Instant now) = 0;
    // Returns whether to advance the device again in the same tick, after the engine has handled the reports of this turn.
    virtual bool goes_on() const { return false; }
};

}  // namespace rois
