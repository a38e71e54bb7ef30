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

    ~FaultyComponent() override { simulation_->part(*this); }
    FaultyComponent(FaultyComponent const&) = delete;
    FaultyComponent& operator=(FaultyComponent const&) = delete;

    ComponentDescription const& description() const override { return component_->description(); }

    void attach(ComponentPort& port) override {
        port_ = &port;
        component_->attach(*this);
        simulation_->join(*this);
    }

    ComponentStatus status() const override {
        if (is(Fault::Kind::failed)) return ComponentStatus::error;
        auto const status = component_->status();
        bool const warns = status == ComponentStatus::ready && is(Fault::Kind::complaining);
        return warns ? ComponentStatus::warning : status;
    }

    std::optional<std::string> refusal(std::string_view command_type, ParameterList const& parameters) const override {
        return component_->refusal(command_type, parameters);
    }

    void reconcile(ParameterList& stored, ParameterList const& arrived) const override { component_->reconcile(stored, arrived); }

    void start(CommandHandle command, ParameterList const& parameters, Instant now) override {
        fail_when_failed();
        if (is(Fault::Kind::silent)) return;
        running_ = command;
        component_->start(command, parameters, now);
    }

    Halted halt(Instant now) override {
        if (is(Fault::Kind::unstoppable)) return Halted::not_yet;
        running_.reset();
        auto const answer = component_->halt(now);
        halting_ = answer == Halted::not_yet;
        return answer;
    }

    void suspend(Instant now) override {
        fail_when_failed();
        component_->suspend(now);
    }

    void resume(Instant now) override {
        fail_when_failed();
        component_->resume(now);
    }

    void parameters_changed(ParameterList const& parameters, Instant now) override {
        fail_when_failed();
        component_->parameters_changed(parameters, now);
    }

    void perform(CommandHandle command, std::string_view command_type, ParameterList const& arguments, Instant now) override {
        fail_when_failed();
        if (!is(Fault::Kind::silent)) component_->perform(command, command_type, arguments, now);
    }

    std::optional<Located> location() const override { return component_->location(); }
    CompletedStatus status_when_stopped() const override { return component_->status_when_stopped(); }

    ParameterList readable_parameters() const override {
        fail_when_failed();
        return component_->readable_parameters();
    }

    std::vector<Results> query(std::string_view query_type, Instant now) override {
        fail_when_failed();
        if (!is(Fault::Kind::silent)) return with_status(query_type, component_->query(query_type, now));
        port_->error(ErrorType::component_not_responding, "the component does not answer queries: a fault of the scenario",
                     Report::once);
        return {};
    }

private:
    void started(CommandHandle command) override { port_->started(command); }

    void completed(CommandHandle command, CompletedStatus status, Results results, Afterwards afterwards,
                   std::string text) override {
        if (running_ == command) running_.reset();
        port_->completed(command, status, std::move(results), afterwards, std::move(text));
    }

    void halted() override {
        if (std::exchange(halting_, false)) port_->halted();
    }
    void event(std::string_view event_type, Results results) override { port_->event(event_type, std::move(results)); }
    void error(ErrorType type, std::string text, Report report) override { port_->error(type, std::move(text), report); }

    void observe(Instant when) override {
        if (!std::exchange(had_complained_, is(Fault::Kind::complaining)) && had_complained_)
            port_->error(ErrorType::user_defined_error, "the component complains: a fault of the scenario");
        if (std::exchange(had_failed_, is(Fault::Kind::failed)) || !had_failed_) return;
        component_->halt(when);
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
    std::vector<Results> with_status(std::string_view query_type, std::vector<Results> rows) const {
        if (query_type != "engine_status") return rows;
        for (auto& row : rows)
            for (auto& parameter : row.parameters)
                if (parameter.name == "status") parameter = status_of("status", status());
        return rows;
    }

    void fail_when_failed() const {
        if (is(Fault::Kind::failed)) throw std::runtime_error{reason};
    }

    static constexpr auto reason = "the component has failed: a fault of the scenario";

    std::shared_ptr<Simulation> simulation_;
    std::vector<Fault> faults_;
    ComponentPort* port_ = nullptr;
    std::optional<CommandHandle> running_;
    bool halting_ = false;  // the engine waits for halted()
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
