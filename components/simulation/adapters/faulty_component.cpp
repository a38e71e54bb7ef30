#include "simulation/adapters/robots.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rois::simulation {

namespace {

// A proxy between the engine and a component. While a fault is active, it does not pass on new commands and queries. A silent
// component continues its running commands; a failed component ends them.
class FaultyComponent final : public Component, private ComponentPort, private Observer {
public:
    FaultyComponent(std::unique_ptr<Component> component, std::shared_ptr<Simulation> simulation, std::vector<Fault> faults)
        : simulation_{std::move(simulation)}, faults_{std::move(faults)}, component_{std::move(component)} {}

    ~FaultyComponent() override {
        if (port_ != nullptr) simulation_->part(*this);
    }
    FaultyComponent(FaultyComponent const&) = delete;
    FaultyComponent& operator=(FaultyComponent const&) = delete;

    ComponentDescription const& description() const override { return component_->description(); }

    void attach(ComponentPort& port) override {
        port_ = &port;
        component_->attach(*this);
        simulation_->join(*this);
    }

    void prepare(Ticket ticket, std::string_view command_type, ParameterList const& parameters, Instant now) override {
        asked_ = command_type;
        component_->prepare(ticket, command_type, parameters, now);
    }

    void halt(Ticket ticket, Instant now) override {
        if (is(Fault::Kind::unstoppable)) return;
        running_.reset();
        halting_ = ticket;
        component_->halt(ticket, now);
    }

    void suspend(Ticket ticket, Instant now) override {
        fail_when_failed();
        component_->suspend(ticket, now);
    }

    void resume(Ticket ticket, Instant now) override {
        fail_when_failed();
        component_->resume(ticket, now);
    }

    void parameters_changed(ParameterList const& parameters, Instant now) override {
        fail_when_failed();
        component_->parameters_changed(parameters, now);
    }

    void query(Ticket ticket, std::string_view query_type, Instant now) override {
        fail_when_failed();
        if (is(Fault::Kind::silent)) return;
        asked_ = query_type;
        component_->query(ticket, query_type, now);
    }

    void after_call() override {
        component_->after_call();
        report_state();
    }

private:
    // Of the component: some reports are changed by the faults.
    void report(ComponentReport&& report) override {
        if (auto const* state = std::get_if<StateChanged>(&report)) {
            state_ = **state;
            return report_state();
        }
        if (auto const* confirmed = std::get_if<HaltConfirmed>(&report)) {
            if (confirmed->ticket == own_halt) return;
            halting_.reset();
        }
        if (auto const* ended = std::get_if<CommandEnded>(&report); ended && running_ == ended->command) running_.reset();
        if (auto* answered = std::get_if<Answered>(&report)) change(answered->answer);
        port_->report(std::move(report));
    }

    // A command has the faults of the moment when it begins.
    void change(ComponentAnswer& answer) {
        if (auto* rows = std::get_if<std::vector<Results>>(&answer)) *rows = with_status(std::move(*rows));
        auto* begin = std::get_if<Begin>(&answer);
        if (begin == nullptr) return;
        answer = [this, begin = std::move(*begin), starts = asked_ == "start"](CommandHandle command, Instant now) {
            fail_when_failed();
            if (is(Fault::Kind::silent)) return;
            if (starts) running_ = command;
            begin(command, now);
        };
    }

    void report_state() {
        auto now = state_;
        if (is(Fault::Kind::failed)) now.status = ComponentStatus::error;
        if (now.status == ComponentStatus::ready && is(Fault::Kind::complaining)) now.status = ComponentStatus::warning;
        if (reported_ == now) return;
        port_->changed(now);
        reported_ = std::move(now);
    }

    void observe(Instant when) override {
        if (!std::exchange(had_complained_, is(Fault::Kind::complaining)) && had_complained_)
            port_->error(ErrorType::user_defined_error, "the component complains: a fault of the scenario");
        if (std::exchange(had_failed_, is(Fault::Kind::failed)) || !had_failed_) return;
        component_->after_call();  // a command that has ended in this step does not fail
        component_->halt(halting_.value_or(own_halt), when);
        if (auto const command = std::exchange(running_, {}))
            port_->completed(*command, CompletedStatus::error, {}, Afterwards::as_before, reason);
        port_->error(ErrorType::component_internal_error, reason);
    }

    bool is(Fault::Kind kind) const {
        auto const now = in_seconds(simulation_->hall().now());
        return std::ranges::any_of(faults_, [&](Fault const& fault) {
            return fault.kind == kind && fault.from <= now && (!fault.until || now < *fault.until);
        });
    }

    // Replaces the status in an answer of engine_status by the status with faults.
    std::vector<Results> with_status(std::vector<Results> rows) const {
        if (asked_ != "engine_status" || !reported_) return rows;
        for (auto& row : rows)
            for (auto& parameter : row.parameters)
                if (parameter.name == "status") parameter = status_of("status", reported_->status);
        return rows;
    }

    void fail_when_failed() const {
        if (is(Fault::Kind::failed)) throw std::runtime_error{reason};
    }

    static constexpr auto reason = "the component has failed: a fault of the scenario";
    static constexpr Ticket own_halt{};  // of a halt that the engine has not asked for

    std::shared_ptr<Simulation> simulation_;
    std::vector<Fault> faults_;
    ComponentPort* port_ = nullptr;
    std::string asked_;  // the last command or query: the component answers at once
    std::optional<CommandHandle> running_;
    std::optional<Ticket> halting_;  // the engine waits for the confirmation
    ComponentState state_;           // without faults
    std::optional<ComponentState> reported_;
    bool had_failed_ = false;
    bool had_complained_ = false;
    std::unique_ptr<Component> component_;
};

}  // namespace

std::unique_ptr<Component> with_faults(std::unique_ptr<Component> component, std::shared_ptr<Simulation> const& simulation) {
    auto const& ref = component->description().ref.code;
    std::vector<Fault> faults;
    std::ranges::copy_if(simulation->faults(), std::back_inserter(faults), [&](auto const& f) { return f.component == ref; });
    if (faults.empty()) return component;
    return std::make_unique<FaultyComponent>(std::move(component), simulation, std::move(faults));
}

}  // namespace rois::simulation
