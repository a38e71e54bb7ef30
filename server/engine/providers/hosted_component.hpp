// A component and its provider: how the engine calls it, and how it reports.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "engine/component.hpp"
#include "engine/providers/provider.hpp"

namespace rois {

class RegisteredComponent;

// The component's port. Reports may come from any thread; all other functions need the lock that serializes the calls to the
// engine. The calls return at once: the provider carries them out later.
class HostedComponent final : public ComponentPort, public std::enable_shared_from_this<HostedComponent> {
public:
    HostedComponent(std::unique_ptr<Component>, std::shared_ptr<Provider>);

    void attach();
    void bind(Ticket, Binding, Instant now);
    void released(Instant now);
    void prepare(Ticket, std::string command_type, ParameterList parameters, Instant now);
    void begin(CommandHandle, Begin, Instant now);
    void halt(Ticket, Instant now) noexcept;
    void suspend(Ticket, Instant now);
    void resume(Ticket, Instant now);
    void parameters_changed(ParameterList, Instant now);
    void query(Ticket, std::string query_type, Instant now);
    void call(std::function<void(Component&)>);

    // Destroys the component, which has left the engine. Its later reports are ignored.
    void depart();

    Provider& provider() const { return *provider_; }
    RegisteredComponent* registered = nullptr;  // null once it has left the engine

    // Returns whether a report was lost, because memory was short, since the last call.
    bool take_lost_report() { return lost_report_.exchange(false); }

    // A report, or a call, was lost because memory was short.
    void lose_report() noexcept;

    void report(ComponentReport&&) override;
    bool is_full() const override { return provider_->is_full(); }

private:
    friend class Provider;
    void carry_out(Provider::Call const&);
    void after_call();
    void add(Provider::Awaited, std::function<void(Component*)> what, bool is_question = false);

    std::shared_ptr<Provider> provider_;
    std::atomic<bool> lost_report_ = false;
    bool is_attached_ = false;              // only the provider uses it, and the next member
    std::unique_ptr<Component> component_;  // ends first: until then it may report
};

}  // namespace rois
