// What a sub engine knows of one of its components. It outlives the component.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "engine/component.hpp"
#include "types/messages.hpp"

namespace rois::remote {

// Used on the thread of the links, except `report`, `is_full`, `attach` and `detach`.
class Part {
public:
    Part(ComponentEntry entry_there, std::string ref_here) : entry{std::move(entry_there)}, ref{std::move(ref_here)} {}

    ComponentEntry const entry;  // as the sub engine lists it
    std::string const ref;       // here

    // The binding there. `is_wanted`: an application here has bound the component, or asks for that.
    bool is_wanted = false;
    bool is_held = false;
    int binds_asked = 0;  // not answered yet

    std::vector<Ticket> halts;                        // that wait for the end of one `stop`
    int begins_asked = 0;                             // commands that its engine has not accepted yet
    std::vector<std::function<void()>> after_begins;  // a suspend or resume, which would overtake them

    void forget_questions() {
        binds_asked = begins_asked = 0;
        halts.clear();
        after_begins.clear();
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
