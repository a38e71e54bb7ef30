// The engine's door to what fulfils its components: a driver, a simulation, another engine.
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

// Names a command between the engine and a component: unique for the engine's life, unlike a command_id.
enum class CommandHandle : std::uint64_t {};

// The codebooks of one parameter of type RoISIdentifier (decision 31).
struct Codebooks {
    std::string parameter;
    std::vector<std::string> known;  // the first one is the default
};

// What the engine knows of a component from the beginning.
struct ComponentDescription {
    Identifier ref;                                   // code = the instance's name, unique in the engine (decision 25)
    std::string engine;                               // name of the sub engine that it belongs to; empty for the main engine
    std::shared_ptr<ComponentProfile const> profile;  // as its document says; the engine adds the messages of the sub components

    // The frame in which it takes positions; empty: the engine's own. What it tells says its frame by itself (codebook_ref, crs).
    std::string crs;
    // Which of its parameters are positions (located data, decision 27): in the engine's frame when they do not say another, and
    // refused when they say one that nobody knows. Others are positions when they say a known frame.
    std::vector<std::string> positions;
    // From which codebooks its parameters take identifiers. The engine rejects all others. A codebook that the profile declares
    // for the parameter (codebook_ref of data_type_ref) is known, too, and comes first.
    std::vector<Codebooks> codebooks{};
    // Whether it moves the robot or a part of it. If so, it acts only while its application gives signs of life (decision 33).
    bool moves = false;
};

// What becomes of a component when a command of it has completed.
enum class Afterwards : std::uint8_t {
    as_before,  // the command's own action is over; a continuous function that worked before it still does
    active,     // a continuous function now works until it is stopped (detection, recognition, an open stream, ...)
    idle        // no function works any more
};

// The answer of a component to `halt`: it stands still already, or it will call ComponentPort::halted later.
enum class Halted : std::uint8_t { confirmed, not_yet };

// How often a failure that may come again and again is told: each time, or `once`, until something of the component succeeds or
// somebody else binds it. `once` is for what anybody may cause at any time.
enum class Report : std::uint8_t { each, once };

// What a component tells the engine. The engine owns it; it lives as long as the component. Every call returns at once: the
// engine takes what was said when its own turn is over, in the order in which it was said. Call it from the engine's thread
// only, that is from within a call that the engine makes to a component or a device.
class ComponentPort {
public:
    virtual ~ComponentPort() = default;

    // The command has begun to act. Due within its profile's timeout (decision 16); `completed` implies it.
    virtual void started(CommandHandle) = 0;

    // The command has ended; once for each. Answers to commands that have ended otherwise are counted and dropped. `reason` says,
    // for people, why it did not end with OK; it becomes the result `reason` of get_command_result.
    virtual void completed(CommandHandle, CompletedStatus, Results = {}, Afterwards = Afterwards::as_before,
                           std::string reason = {}) = 0;

    // The component stands still. To be called after its `halt` returned `not_yet`.
    virtual void halted() = 0;

    // An event of the profile occurred.
    virtual void event(std::string_view event_type, Results) = 0;

    // Something is wrong, and perhaps no command to tell it by. `text` says what, for people.
    virtual void error(ErrorType, std::string text, Report = Report::each) = 0;
};

// A component of the engine. The engine calls it from one thread at a time; it must answer quickly and never block. It keeps the
// rules of 7.6 that are the same for all (who has it bound, what `stop` does to a running `start`, which values a parameter
// takes, in which frame positions are) away from here: a component is only asked for what can be done now. An exception that
// leaves a call ends the command with ERROR and is reported as COMPONENT_INTERNAL_ERROR; others are not touched by it.
class Component {
public:
    virtual ~Component() = default;

    virtual ComponentDescription const& description() const = 0;

    // Called once, before anything else is asked; the port stays valid as long as the component.
    virtual void attach(ComponentPort&) = 0;

    // Never `busy`: that is the engine's to say.
    virtual ComponentStatus status() const = 0;

    // Why this command cannot be carried out with these parameters (all that will be stored by then), or nothing. Asked for
    // every unit of a sequence before any of it runs, and for set_parameter; says nothing of the moment's circumstances.
    virtual std::optional<std::string> refusal(std::string_view command_type, ParameterList const& parameters) const = 0;

    // `arrived` was just merged into `stored`: drop from `stored` what the new values replace (the alternative of a pair).
    // Positions are as the application told them, in whatever frame.
    virtual void reconcile(ParameterList& stored, ParameterList const& arrived) const;

    // Begin to act with these parameters. Never called while an earlier start still runs: the engine halts that first.
    virtual void start(CommandHandle, ParameterList const& parameters, Instant now) = 0;

    // End every running action, function and command of the profile at once. The engine completes the commands, `start` with
    // `status_when_stopped`. The engine may call this at any time, also when the component is idle. Until the halt is confirmed,
    // the engine starts nothing on the component. If the component throws, or does not confirm within 0.5 s, the engine calls
    // this again every 0.2 s (decision 35).
    virtual Halted halt(Instant now) = 0;

    // Hold the running action or function, and go on with it.
    virtual void suspend(Instant now) = 0;
    virtual void resume(Instant now) = 0;

    // Parameters have been stored, or are the defaults again because a binding ended; the component may be running.
    virtual void parameters_changed(ParameterList const& parameters, Instant now);

    // A command of the component's own profile (none of the five common types). Completes through the port.
    virtual void perform(CommandHandle, std::string_view command_type, ParameterList const& arguments, Instant now);

    // How a `start` that is ended by `stop` completes: ABORT, but for Follow (decision 8).
    virtual CompletedStatus status_when_stopped() const { return CompletedStatus::abort; }

    // Where it is now: `ref` names the robot that it belongs to. Nothing when that is not known.
    virtual std::optional<Located> location() const { return {}; }

    // What get_parameter answers beside the stored parameters: those that can only be read (recognizable languages, ...).
    virtual ParameterList readable_parameters() const { return {}; }

    // Answers a query of the profile other than component_status and get_parameter, from what is known now: a row of results for
    // each thing that there is to tell of, of which the query's condition chooses one; the first is told when it does not. None
    // when it cannot be answered.
    virtual std::vector<Results> query(std::string_view query_type, Instant now);
};

// What components stand on and time moves: advanced to the present before the engine looks at its components.
class Device {
public:
    virtual ~Device() = default;
    virtual void advance(Instant now) = 0;
    // Whether it is to be advanced once more in the same tick, when the engine has taken in what came of the last time.
    virtual bool goes_on() const { return false; }
};

}  // namespace rois
