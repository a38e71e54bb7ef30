// A component of any type: the functions of RoIS_Common (7.6, table 33), and general commands, queries and events.
//
// Threads: any thread may call the functions, also of the same handle at the same time. Coroutines continue on the client's
// thread (connection.hpp).
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rois/condition.hpp"
#include "rois/connection.hpp"
#include "rois/events.hpp"

namespace rois {

namespace detail {
class Watch;
}

// How a command ended. Converts to its status: `completion == CompletedStatus::ok`.
struct Completion {
    CompletedStatus status = CompletedStatus::ok;
    std::string reason{};  // why the status is not OK, in the engine's words; may be empty

    operator CompletedStatus() const { return status; }
};

// "OK", or the status and the reason: "ERROR: no way leads to the target".
std::string to_text(Completion const&);

// A handle of an accepted command; copies refer to the same command. A command completes exactly once: with ABORT if the session
// ends or the connection closes first.
class Command {
public:
    Command(std::shared_ptr<detail::Core>, std::shared_ptr<detail::Watch>);

    CommandId const& id() const;
    // Waits without a timeout: components have time limits of their own. If the command fails, asks the engine for the reason
    // (get_command_result).
    Task<Completion> completed() const;
    // Returns the results of the command, among them `status` (get_command_result). Throws Error.
    Task<Results> results() const;

private:
    std::shared_ptr<detail::Core> core_;
    std::shared_ptr<detail::Watch> watch_;
};

// A handle of a component; cheap to copy. It does not own the binding, and it does not keep the connection open. The functions
// throw Error if the engine refuses the operation. Functions that run a command return how it ended.
class Component {
public:
    Component(std::shared_ptr<detail::Core>, Identifier ref);

    Identifier const& ref() const { return ref_; }

    Task<Completion> start(ParameterList arguments = {}) const { return run("start", std::move(arguments)); }
    Task<Completion> stop() const { return run("stop"); }
    Task<Completion> suspend() const { return run("suspend"); }
    Task<Completion> resume() const { return run("resume"); }

    // Sends one command. `run` waits until it has completed, `begin` until the engine has accepted it.
    Task<Completion> run(std::string command_type, ParameterList arguments = {}) const;
    Task<Command> begin(std::string command_type, ParameterList arguments = {}) const;

    // The engine stores the parameters at once; the next `start` uses them (decision 8).
    Task<Completion> set_parameter(ParameterList parameters) const { return run("set_parameter", std::move(parameters)); }
    Task<ParameterList> get_parameter() const;

    // BUSY means that another session has bound the component.
    Task<ComponentStatus> component_status() const;
    // Sends a query of this type to this component.
    Task<Results> query(std::string query_type) const;

    // Subscribes to events of this type; the condition may refer to their results. Needs no binding.
    Task<EventStream> subscribe(std::string event_type, QueryExpression condition = {}) const;
    template <class E>
    Task<Events<E>> events(QueryExpression condition = {}) const {
        auto self = *this;
        auto stream = co_await self.subscribe(std::string{E::name}, std::move(condition));
        co_return Events<E>{std::move(stream)};
    }

    Task<> bind(Switching switching = Switching::none) const;
    Task<> release() const;

private:
    std::shared_ptr<detail::Core> core_;
    Identifier ref_;
};

}  // namespace rois
