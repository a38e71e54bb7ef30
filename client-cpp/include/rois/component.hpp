// A component of an engine, whatever its type: what RoIS_Common gives to all of them (7.6, table 33), and the way to the rest.
#pragma once

#include <functional>
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
    std::string reason{};  // why the status is not OK, as the engine says it; may be empty

    operator CompletedStatus() const { return status; }
};

// "OK", or the status and the reason: "ERROR: no way leads to the target".
std::string to_text(Completion const&);

// A command that was accepted. It completes once, whatever happens: with ABORT when the session ends, or the connection closes. A
// handle: copies are the same command.
class Command {
public:
    Command(std::shared_ptr<detail::Core>, std::shared_ptr<detail::Watch>);

    CommandId const& id() const;
    // Waits as long as it takes: components have time limits of their own. If the command fails, asks the engine for the reason
    // (get_command_result).
    Task<Completion> completed() const;
    // What it resulted in (get_command_result); `status` is among it. Throws Error.
    Task<Results> results() const;

private:
    std::shared_ptr<detail::Core> core_;
    std::shared_ptr<detail::Watch> watch_;
};

// Cheap to copy; it does not own the binding. Functions that await throw Error when the engine refuses; how a command ended is
// its value. The references in it keep the connection's inside alive, not the connection.
class Component {
public:
    Component(std::shared_ptr<detail::Core>, Identifier ref);

    Identifier const& ref() const { return ref_; }

    Task<Completion> start(ParameterList arguments = {}) const { return run("start", std::move(arguments)); }
    Task<Completion> stop() const { return run("stop"); }
    Task<Completion> suspend() const { return run("suspend"); }
    Task<Completion> resume() const { return run("resume"); }

    // One command: until it has completed, or only until it was accepted.
    Task<Completion> run(std::string command_type, ParameterList arguments = {}) const;
    Task<Command> begin(std::string command_type, ParameterList arguments = {}) const;

    // Stored at once, used by the next start (decision 8).
    Task<Completion> set_parameter(ParameterList parameters) const { return run("set_parameter", std::move(parameters)); }
    Task<ParameterList> get_parameter() const;

    // Ours: BUSY means that another session has it bound.
    Task<ComponentStatus> component_status() const;
    // A query of this type to this component.
    Task<Results> query(std::string query_type) const;

    // Its events of this type; the condition may speak of their results. Needs no binding.
    Task<EventStream> subscribe(std::string event_type, QueryExpression condition = {}) const;
    template <class E>
    Task<Events<E>> events(QueryExpression condition = {}) const {
        auto self = *this;
        auto stream = co_await self.subscribe(std::string{E::name}, std::move(condition));
        co_return Events<E>{std::move(stream)};
    }

    Task<> bind() const;
    Task<> release() const;

private:
    std::shared_ptr<detail::Core> core_;
    Identifier ref_;
};

}  // namespace rois
