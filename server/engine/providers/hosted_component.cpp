#include "engine/providers/hosted_component.hpp"

#include <utility>

namespace rois {

HostedComponent::HostedComponent(std::unique_ptr<Component> component, std::shared_ptr<Provider> provider)
    : provider_{std::move(provider)}, component_{std::move(component)} {}

void HostedComponent::add(Provider::Awaited awaited, std::function<void(Component*)> what, bool is_question) {
    provider_->add({.to = shared_from_this(), .what = std::move(what), .awaited = awaited, .is_question = is_question});
}

// The first call attaches the component.
void HostedComponent::attach() {
    add({}, [](Component*) {});
}

void HostedComponent::bind(Ticket ticket, Binding binding, Instant now) {
    add(
        ticket, [=, binding = std::move(binding)](Component* component) { component->bind(ticket, binding, now); }, true);
}

void HostedComponent::released(Instant now) {
    add({}, [=](Component* component) { component->released(now); });
}

void HostedComponent::prepare(Ticket ticket, std::string command_type, ParameterList parameters, Instant now) {
    add(
        ticket,
        [=, type = std::move(command_type), list = std::move(parameters)](Component* component) {
            component->prepare(ticket, type, list, now);
        },
        true);
}

void HostedComponent::begin(CommandHandle command, Begin begin, Instant now) {
    add(command, [=, begin = std::move(begin)](Component*) { begin(command, now); });
}

void HostedComponent::halt(Ticket ticket, Instant now) noexcept { provider_->add_halt(shared_from_this(), ticket, now); }

void HostedComponent::suspend(Ticket ticket, Instant now) {
    add(ticket, [=](Component* component) { component->suspend(ticket, now); });
}

void HostedComponent::resume(Ticket ticket, Instant now) {
    add(ticket, [=](Component* component) { component->resume(ticket, now); });
}

void HostedComponent::parameters_changed(ParameterList parameters, Instant now) {
    add({}, [=, list = std::move(parameters)](Component* component) { component->parameters_changed(list, now); });
}

// Any client may ask, so a failure is reported once.
void HostedComponent::query(Ticket ticket, std::string query_type, Instant now) {
    provider_->add({.to = shared_from_this(),
                    .what = {},
                    .query_type = std::move(query_type),
                    .awaited = ticket,
                    .now = now,
                    .is_question = true,
                    .report = Report::once});
}

void HostedComponent::call(std::function<void(Component&)> what) {
    add({}, [what = std::move(what)](Component* component) { what(*component); });
}

void HostedComponent::depart() {
    registered = nullptr;
    add({}, [this](Component*) {
        component_.reset();
        provider_->part(*this);  // not earlier: the first call, which joins, may still be waiting
    });
}

// Drops what a thread of the component reports while the engine is being destroyed.
void HostedComponent::report(ComponentReport&& report) {
    auto self = weak_from_this().lock();
    if (!self) return;
    try {
        provider_->report(std::move(self), std::move(report));
    } catch (...) {
        lose_report();
        throw;
    }
}

void HostedComponent::lose_report() noexcept {
    lost_report_ = true;
    provider_->inbox().note_lost_report();
}

void HostedComponent::carry_out(Provider::Call const& call) {
    if (!component_) return;
    if (!is_attached_) {
        provider_->join(shared_from_this());
        component_->attach(*this);
        is_attached_ = true;
    }
    if (call.what) return call.what(component_.get());
    auto const ticket = std::get<Ticket>(call.awaited);
    if (!call.query_type.empty()) return component_->query(ticket, call.query_type, call.now);
    component_->halt(ticket, call.now);
}

void HostedComponent::after_call() {
    if (component_ && is_attached_) component_->after_call();
}

}  // namespace rois
