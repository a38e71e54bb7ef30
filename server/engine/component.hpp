// The interface between the engine and its components: drivers, simulations and other engines implement `Component`.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "types/codes.hpp"
#include "types/instant.hpp"
#include "types/profiles.hpp"
#include "types/values.hpp"

namespace rois {

// Identifies a command between the engine and a component. Unique for the life of the engine; a command_id is not.
enum class CommandHandle : std::uint64_t {};

// The codebooks of one parameter of type RoISIdentifier (decision 31).
struct Codebooks {
    std::string parameter;
    std::vector<std::string> known;  // the first one is the default
};

// The constant properties of a component.
struct ComponentDescription {
    Identifier ref;                                   // code = the instance's name, unique in the engine (decision 25)
    std::string engine;                               // name of the sub engine that it belongs to; empty for the main engine
    std::shared_ptr<ComponentProfile const> profile;  // without the messages of its sub components, which the engine adds

    // The frame of the positions that the component receives; empty: the engine's. Positions that the component reports name
    // their frame themselves (codebook_ref, crs).
    std::string crs;
    // The parameters that hold positions (located data, decision 27). Without a frame, they are in the engine's frame; an unknown
    // frame is rejected. Other parameters count as positions if they name a known frame.
    std::vector<std::string> positions;
    // The codebooks that each identifier parameter accepts; the engine rejects all others. A codebook that the profile declares
    // for the parameter (codebook_ref of data_type_ref) is accepted too, and is the default.
    std::vector<Codebooks> codebooks{};
    // Whether the component moves the robot or a part of it. Such a component acts only while its application gives signs of life
    // (decision 33).
    bool moves = false;
};

// The state of a component after one of its commands has completed.
enum class Afterwards : std::uint8_t {
    as_before,  // a continuous function that was active before the command stays active
    active,     // a continuous function is active until it is stopped (detection, recognition, an open stream, ...)
    idle        // no function is active
};

// The component's answer to `halt`. `confirmed`: the component stands still. `not_yet`: the component will call
// ComponentPort::halted.
enum class Halted : std::uint8_t { confirmed, not_yet };

// How often a repeated failure is reported. `each`: every time. `once`: until the component succeeds or another session binds it.
// Use `once` for failures that any client can cause at any time.
enum class Report : std::uint8_t { each, once };

// The component's way to report to the engine. The engine owns the port; it lives as long as the component. All functions return
// at once: the engine handles the reports at the end of its own step, in order. Call them only from within a call that the engine
// makes to a component or a device, on its thread.
class ComponentPort {
public:
    virtual ~ComponentPort() = default;

    // The command has begun to act. Must be called within the profile's timeout (decision 16). `completed` includes it.
    virtual void started(CommandHandle) = 0;

    // The command has ended. Must be called once for each command. A report for a command that has already ended is counted and
    // ignored. `reason` says, for people, why the status is not OK; it becomes the result `reason` of get_command_result.
    virtual void completed(CommandHandle, CompletedStatus, Results = {}, Afterwards = Afterwards::as_before,
                           std::string reason = {}) = 0;

    // The component stands still. Call this after `halt` returned `not_yet`.
    virtual void halted() = 0;

    // An event of the profile occurred.
    virtual void event(std::string_view event_type, Results) = 0;

    // Reports an error, with or without a command that failed. `text` is for people.
    virtual void error(ErrorType, std::string text, Report = Report::each) = 0;
};

// A component. The engine calls it from one thread at a time. Calls must return quickly and never block. The engine enforces the
// rules that all components share (7.6): bindings, `stop` during `start`, parameter values, frames. It calls a component only for
// operations that are allowed now. If a call throws, the command ends with ERROR and the engine reports COMPONENT_INTERNAL_ERROR;
// other commands are not affected.
class Component {
public:
    virtual ~Component() = default;

    virtual ComponentDescription const& description() const = 0;

    // Called once, before all other functions. The port stays valid as long as the component.
    virtual void attach(ComponentPort&) = 0;

    // Must not return `busy`: the engine knows who has bound the component, and reports it.
    virtual ComponentStatus status() const = 0;

    // Returns why the component can never carry out this command with these parameters, or nullopt. `parameters` has all
    // parameters that will be stored when the command runs. The answer must not depend on the present situation. Called for each
    // unit of a sequence before any of them runs, and for set_parameter.
    virtual std::optional<std::string> refusal(std::string_view command_type, ParameterList const& parameters) const = 0;

    // Called after `arrived` was merged into `stored`. Removes values from `stored` that contradict the new ones, such as the old
    // `line` when a new `curve` arrives. The positions are still in the frames in which the application sent them.
    virtual void reconcile(ParameterList& stored, ParameterList const& arrived) const;

    // Begins to act with these parameters. The engine halts a running action before it calls this.
    virtual void start(CommandHandle, ParameterList const& parameters, Instant now) = 0;

    // Ends every running action, function and command at once. The engine reports the commands as completed, `start` with
    // `status_when_stopped`. The engine may call this at any time, also when the component is idle. It starts nothing on the
    // component until the halt is confirmed. If the component throws, or does not confirm within 0.5 s, the engine calls this
    // again every 0.2 s (decision 35).
    virtual Halted halt(Instant now) = 0;

    // Pauses the running action or function, and continues it.
    virtual void suspend(Instant now) = 0;
    virtual void resume(Instant now) = 0;

    // The stored parameters have changed: by a command, or back to the defaults because a binding ended. The component may be
    // running.
    virtual void parameters_changed(ParameterList const& parameters, Instant now);

    // Runs a command of the component's own profile (not one of the five common types). Completes through the port.
    virtual void perform(CommandHandle, std::string_view command_type, ParameterList const& arguments, Instant now);

    // The status of a `start` that `stop` ends: ABORT, except for Follow (decision 8).
    virtual CompletedStatus status_when_stopped() const { return CompletedStatus::abort; }

    // The present position, or nullopt if it is unknown. `ref` names the robot that the component belongs to.
    virtual std::optional<Located> location() const { return {}; }

    // The read-only parameters of get_parameter (recognizable languages, ...).
    virtual ParameterList readable_parameters() const { return {}; }

    // Answers a query of the profile, except component_status and get_parameter, from data at hand. Returns one row of results
    // for each match, such as one for each stream; none if it cannot answer. The engine answers with the first row that meets the
    // condition.
    virtual std::vector<Results> query(std::string_view query_type, Instant now);
};

// An object that several components share and that changes with time, such as a simulated world.
class Device {
public:
    virtual ~Device() = default;
    virtual void advance(Instant now) = 0;
    // Returns whether to advance the device again in the same tick, after the engine has handled the reports of this turn.
    virtual bool goes_on() const { return false; }
};

}  // namespace rois
