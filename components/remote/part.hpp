// What a sub engine knows of one of its components. It outlives the component.
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/component.hpp"
#include "types/messages.hpp"

namespace rois::remote {

// Used on the thread of the links, except `report`, `attach` and `detach`.
class Part {
public:
    Part(ComponentEntry entry_there, std::string ref_here) : entry{std::move(entry_there)}, ref{std::move(ref_here)} {}

    ComponentEntry const entry;  // as the sub engine lists it
    std::string const ref;       // here

    enum class Binding : std::uint8_t { none, asked, held } binding = Binding::none;
    bool is_released = false;  // while the binding is asked for

    bool is_wanted = false;  // an application here has bound it, so it is bound again in a new session
    std::set<CommandHandle> running;
    std::vector<Ticket> halts;  // that wait for the end of one `stop`

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
    void answer(Ticket ticket, ComponentAnswer answer) { report(Answered{ticket, std::move(answer)}); }

private:
    std::mutex mutex_;
    ComponentPort* port_ = nullptr;
};

}  // namespace rois::remote
