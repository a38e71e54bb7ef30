#include "engine/local_component.hpp"

#include <utility>

namespace rois {

void LocalComponent::attach(ComponentPort& port) { port_ = &port; }

std::vector<Results> LocalComponent::query(std::string_view, Instant) { return {}; }

void LocalComponent::prepare(Ticket ticket, std::string_view command_type, ParameterList const& parameters, Instant) {
    auto prepared = prepare(command_type, parameters);
    if (auto* refused = std::get_if<Refused>(&prepared)) return port_->answered(ticket, std::move(*refused));
    auto& begin = std::get<Begin>(prepared);
    if (command_type != "set_parameter") return port_->answered(ticket, std::move(begin));
    port_->answered(ticket, [this, begin = std::move(begin)](CommandHandle command, Instant now) {
        begin(command, now);
        port().completed(command, CompletedStatus::ok);
    });
}

void LocalComponent::halt(Ticket ticket, Instant now) {
    halt_ = ticket;
    if (halt(now) == Halted::confirmed) confirm_halt();
}

void LocalComponent::confirm_halt() { port().halted(halt_); }

void LocalComponent::suspend(Ticket ticket, Instant now) {
    suspend(now);
    port().answered(ticket, Done{});
}

void LocalComponent::resume(Ticket ticket, Instant now) {
    resume(now);
    port().answered(ticket, Done{});
}

void LocalComponent::query(Ticket ticket, std::string_view query_type, Instant now) {
    port_->answered(ticket, query(query_type, now));
}

// Reports the state first: what the other reports cause may read it.
void LocalComponent::after_call() {
    ComponentState state{status(), location(), readable_parameters()};
    if (reported_ != state) {
        port_->changed(state);
        reported_ = std::move(state);
    }
    for (auto& report : std::exchange(collected_.reports, {})) port_->report(std::move(report));
}

}  // namespace rois
