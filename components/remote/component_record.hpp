// What a RemoteEngine knows of one component of its sub engine. The record outlives the RemoteComponent.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/component.hpp"
#include "types/messages.hpp"

namespace rois::remote {

// Used on the thread of the links, except `report`, `is_full`, `attach` and `detach`.
class ComponentRecord {
public:
    ComponentRecord(ComponentEntry entry_there, std::string ref_here) : entry{std::move(entry_there)}, ref{std::move(ref_here)} {}

    ComponentEntry const entry;  // as the sub engine lists it
    std::string const ref;       // in this engine
    bool const can_be_stopped = find_message(*entry.profile, MessageKind::command, "stop") != nullptr;

    // The binding in the sub engine. `is_wanted`: an application of this engine has bound the component, or asks for that.
    bool is_wanted = false;
    bool is_held = false;  // the sub engine has accepted `bind`
    int binds_asked = 0;   // `bind` requests that are not answered yet
    Switching switching = Switching::none;

    ParameterList stored;  // in the sub engine, for the application that has bound the component

    // Whether the component may act for this engine: from the beginning of a command until the sub engine says that nothing is
    // active, or that it has stopped or released the component, or has ended the session.
    bool may_act = false;
    int running = 0;                  // commands that have not completed
    std::optional<Ticket> halt;       // the newest halt that is not confirmed yet
    std::deque<std::string> stops{};  // ids of the newest `stop` commands whose end confirms that the component stands still
    Steady stopped_at{};              // when the newest was sent

    int begins_asked = 0;                             // `execute` requests that are not answered yet
    std::vector<std::function<void()>> after_begins;  // `suspend` or `resume`: sent once these are answered, to keep the order

    // Stores those of the parameters that `set_parameter` takes.
    void store(ParameterList const& parameters) {
        auto const* command = find_message(*entry.profile, MessageKind::command, "set_parameter");
        auto const is_settable = [&](std::string const& name) {
            return (command != nullptr && find_parameter(command->arguments, name) != nullptr) ||
                   find_parameter(entry.profile->parameters, name) != nullptr;
        };
        stored.clear();
        for (auto const& each : parameters)
            if (is_settable(each.name)) stored.push_back(each);
    }

    void forget_questions() {
        binds_asked = begins_asked = 0;
        stops.clear();
        after_begins.clear();
    }

    void fail_halt() {
        if (halt) report(HaltFailed{*halt});
    }
    void confirm_halt() {
        if (auto const ticket = std::exchange(halt, {})) report(HaltConfirmed{*ticket});
    }
    void end_activity() {
        may_act = false;
        stops.clear();
        confirm_halt();
    }

    // Thread-safe. Reports are dropped unless there is a port.
    void attach(ComponentPort& port) {
        std::lock_guard const lock{mutex_};
        port_ = &port;
    }
    void detach() {
        std::lock_guard const lock{mutex_};
        port_ = nullptr;
    }
    void report(ComponentReport&& report) {
        std::lock_guard const lock{mutex_};
        if (port_ != nullptr) port_->report(std::move(report));
    }
    bool is_full() {
        std::lock_guard const lock{mutex_};
        return port_ != nullptr && port_->is_full();
    }
    void answer(Ticket ticket, ComponentAnswer answer) { report(Answered{ticket, std::move(answer)}); }

private:
    std::mutex mutex_;
    ComponentPort* port_ = nullptr;
};

}  // namespace rois::remote
