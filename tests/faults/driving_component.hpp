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
class DrivingComponent final : public Component {
public:
    explicit DrivingComponent(std::string const& ref, Part const& like) {
        description_.ref = Application::identifier(ref);
        description_.profile = std::make_shared<ComponentProfile const>(like.profile);
        description_.moves = true;
    }

    std::atomic<bool> drives = false;
    std::function<void()> on_start = [] {};  // before it drives
    bool confirms_late = false;

    // Reports of the component.
    void arrive(Results results) {
        drives = false;
        port_->completed(std::exchange(command_, {}), CompletedStatus::ok, std::move(results));
    }
    void pass(std::string const& target) {
        port_->event("reached_target", {{text("target", target), value("is_final_target", "bool", {"false"})}, {}});
    }
    void stand_still() {
        if (std::exchange(asked_to_halt_, false)) port_->halted();
    }

    ComponentDescription const& description() const override { return description_; }
    void attach(ComponentPort& port) override { port_ = &port; }
    ComponentStatus status() const override { return drives ? ComponentStatus::busy : ComponentStatus::ready; }
    std::optional<std::string> refusal(std::string_view, ParameterList const&) const override { return {}; }
    void start(CommandHandle command, ParameterList const&, Instant) override { go(command); }
    void perform(CommandHandle command, std::string_view, ParameterList const&, Instant) override { go(command); }
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
        port_->started(command);
    }

    ComponentDescription description_;
    ComponentPort* port_ = nullptr;
    CommandHandle command_{};
    bool asked_to_halt_ = false;
};

}  // namespace rois
