// A component that moves the robot and needs no memory for that.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "engine/world.hpp"

namespace rois {

// With `confirms_late`, confirms a halt later.
class DrivingComponent final : public LocalComponent {
public:
    explicit DrivingComponent(std::string const& ref, Part const& like) {
        description_.ref = Application::identifier(ref);
        description_.engine = like.engine;
        description_.profile = std::make_shared<ComponentProfile const>(like.profile);
        description_.moves = true;
        description_.provider = "stage";
        description_.returns_at_once = true;
    }

    std::atomic<bool> drives = false;
    std::function<void()> on_start = [] {};  // before it drives
    bool confirms_late = false;

    // Reports of the component.
    void arrive(Results results) { end(CompletedStatus::ok, std::move(results)); }
    void end(CompletedStatus status, Results results = {}) {
        drives = false;
        port().completed(std::exchange(command_, {}), status, std::move(results));
    }
    void pass(std::string const& target) {
        port().event("reached_target", {{text("target", target), value("is_final_target", "bool", {"false"})}, {}});
    }
    void stand_still() {
        if (std::exchange(asked_to_halt_, false)) confirm_halt();
    }

    ComponentDescription const& description() const override { return description_; }
    ComponentStatus status() const override { return drives ? ComponentStatus::busy : ComponentStatus::ready; }
    Prepared prepare(std::string_view command_type, ParameterList const&) override {
        if (command_type == "set_parameter") return [](CommandHandle, Instant) {};
        return [this](CommandHandle command, Instant) { go(command); };
    }
    Halted halt(Instant) override {
        drives = false;
        asked_to_halt_ = confirms_late;
        return confirms_late ? Halted::not_yet : Halted::confirmed;
    }
    void suspend(Instant) override { drives = false; }
    void resume(Instant) override { drives = true; }

private:
    void go(CommandHandle command) {
        on_start();
        drives = true;
        command_ = command;
        port().started(command);
    }

    ComponentDescription description_;
    CommandHandle command_{};
    bool asked_to_halt_ = false;
};

}  // namespace rois
