#include "remote/remote_component.hpp"

#include <utility>

namespace rois::remote {

RemoteComponent::RemoteComponent(ComponentDescription description, std::shared_ptr<Part> part,
                                 std::shared_ptr<RemoteEngine> engine)
    : description_{std::move(description)}, part_{std::move(part)}, engine_{std::move(engine)} {}

void RemoteComponent::attach(ComponentPort& port) {
    part_->attach(port);
    engine_->run([part = part_](RemoteEngine& engine) { engine.attach(part); });
}

void RemoteComponent::bind(Ticket ticket, Instant) {
    engine_->run([=, part = part_](RemoteEngine& engine) { engine.bind(part, ticket); });
}

void RemoteComponent::released(Instant) {
    engine_->run([part = part_](RemoteEngine& engine) { engine.released(part); });
}

void RemoteComponent::prepare(Ticket ticket, std::string_view command_type, ParameterList const& parameters, Instant) {
    engine_->run([=, part = part_, type = std::string{command_type}](RemoteEngine& engine) {
        engine.prepare(part, ticket, type, parameters);
    });
}

void RemoteComponent::halt(Ticket ticket, Instant) {
    engine_->run([=, part = part_](RemoteEngine& engine) { engine.halt(part, ticket); });
}

void RemoteComponent::suspend(Ticket ticket, Instant) {
    engine_->run([=, part = part_](RemoteEngine& engine) { engine.pause(part, ticket, "suspend"); });
}

void RemoteComponent::resume(Ticket ticket, Instant) {
    engine_->run([=, part = part_](RemoteEngine& engine) { engine.pause(part, ticket, "resume"); });
}

void RemoteComponent::query(Ticket ticket, std::string_view query_type, Instant) {
    engine_->run([=, part = part_, type = std::string{query_type}](RemoteEngine& engine) { engine.query(part, ticket, type); });
}

}  // namespace rois::remote
