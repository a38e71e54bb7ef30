// A component of a sub engine, as a component of this engine.
#pragma once

#include <memory>

#include "engine/component.hpp"
#include "remote/remote_engine.hpp"

namespace rois::remote {

class RemoteComponent final : public Component {
public:
    RemoteComponent(ComponentDescription, std::shared_ptr<ComponentRecord>, std::shared_ptr<RemoteEngine>);
    ~RemoteComponent() override { record_->detach(); }

    ComponentDescription const& description() const override { return description_; }
    void attach(ComponentPort&) override;
    void bind(Ticket, Binding const&, Instant now) override;
    void released(Instant now) override;
    void prepare(Ticket, std::string_view command_type, ParameterList const&, Instant now) override;
    void halt(Ticket, Instant now) override;
    void suspend(Ticket, Instant now) override;
    void resume(Ticket, Instant now) override;
    void query(Ticket, std::string_view query_type, Instant now) override;

private:
    ComponentDescription description_;
    std::shared_ptr<ComponentRecord> record_;
    std::shared_ptr<RemoteEngine> engine_;
};

}  // namespace rois::remote
