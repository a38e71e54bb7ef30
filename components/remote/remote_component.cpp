#include "remote/remote_component.hpp"

#include <utility>

namespace rois::remote {

RemoteComponent::RemoteComponent(ComponentDescription description, std::shared_ptr<ComponentRecord> record,
                                 std::shared_ptr<RemoteEngine> engine)
    : description_{std::move(description)}, record_{std::move(record)}, engine_{std::move(engine)} {}

void RemoteComponent::attach(ComponentPort& port) {
    record_->attach(port);
    engine_->run([record = record_](RemoteEngine& engine) { engine.attach(record); });
}

void RemoteComponent::bind(Ticket ticket, Binding const& binding, Instant) {
    engine_->run([=, record = record_](RemoteEngine& engine) { engine.bind(record, ticket, binding); });
}

void RemoteComponent::released(Instant) {
    engine_->run([record = record_](RemoteEngine& engine) { engine.released(record); });
}

void RemoteComponent::prepare(Ticket ticket, std::string_view command_type, ParameterList const& parameters, Instant) {
    engine_->run([=, record = record_, type = std::string{command_type}](RemoteEngine& engine) {
        engine.prepare(record, ticket, type, parameters);
    });
}

void RemoteComponent::halt(Ticket ticket, Instant) {
    engine_->run([=, record = record_](RemoteEngine& engine) { engine.halt(record, ticket); });
}

void RemoteComponent::suspend(Ticket ticket, Instant) {
    engine_->run([=, record = record_](RemoteEngine& engine) { engine.pause(record, ticket, "suspend"); });
}

void RemoteComponent::resume(Ticket ticket, Instant) {
    engine_->run([=, record = record_](RemoteEngine& engine) { engine.pause(record, ticket, "resume"); });
}

void RemoteComponent::query(Ticket ticket, std::string_view query_type, Instant) {
    engine_->run(
        [=, record = record_, type = std::string{query_type}](RemoteEngine& engine) { engine.query(record, ticket, type); });
}

}  // namespace rois::remote
