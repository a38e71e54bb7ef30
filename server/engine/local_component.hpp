// Base class of components in this process: the engine's questions are plain functions that return the answer.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/component.hpp"

namespace rois {

// The component's answer to `halt`. `confirmed`: the component stands still. `not_yet`: the component will call `halted`.
enum class Halted : std::uint8_t { confirmed, not_yet };

using Prepared = std::variant<Begin, Refused>;

class LocalComponent : public Component {
public:
    // Called once, before the functions below. Override it to begin observing a device.
    void attach(ComponentPort&) override;

    virtual ComponentStatus status() const = 0;
    virtual std::optional<Located> location() const { return {}; }
    virtual ParameterList readable_parameters() const { return {}; }

    // As Component::prepare. A set_parameter completes when its Begin returns.
    virtual Prepared prepare(std::string_view command_type, ParameterList const& parameters) = 0;
    virtual Halted halt(Instant now) = 0;
    virtual void suspend(Instant now) = 0;
    virtual void resume(Instant now) = 0;
    virtual std::vector<Results> query(std::string_view query_type, Instant now);

    // The component stands still, after `halt` has returned `not_yet`. Call this within a call of the engine or a device.
    void confirm_halt();

protected:
    // For reports within a call that the engine makes to the component or to a device of its provider, on its thread. The engine
    // receives them after the call, behind a change of the state.
    ComponentPort& port() { return collected_; }
    bool is_attached() const { return port_ != nullptr; }

private:
    class Collected final : public ComponentPort {
    public:
        void report(ComponentReport&& report) override { reports.push_back(std::move(report)); }
        std::vector<ComponentReport> reports;
    };

    void prepare(Ticket, std::string_view command_type, ParameterList const& parameters, Instant now) final;
    void halt(Ticket, Instant now) final;
    void suspend(Ticket, Instant now) final;
    void resume(Ticket, Instant now) final;
    void query(Ticket, std::string_view query_type, Instant now) final;
    void after_call() final;

    ComponentPort* port_ = nullptr;
    Collected collected_;
    Ticket halt_{};
    std::optional<ComponentState> reported_;
};

}  // namespace rois
