// The reports of components that wait for the engine (docs/engine.md).
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <variant>

#include "engine/component.hpp"

namespace rois {

class HostedComponent;

// A call to a component threw. `awaited`: the question or command that the call was about, if there is one.
struct CallFailed {
    std::variant<std::monostate, Ticket, CommandHandle> awaited;
    std::string text;
    Report report = Report::each;
};

// `from` is null for a device.
struct InboxEntry {
    using What = std::variant<ComponentReport, CallFailed>;
    std::shared_ptr<HostedComponent> from;
    What report;
};
using InboxEntries = std::list<InboxEntry>;  // a list, so that taking an entry does not move it

// The entries of one provider, in their order. Guarded by the inbox's mutex. Close it before its end.
struct ProvidersEntries {
    ProvidersEntries() : turn{this} {}
    ProvidersEntries(ProvidersEntries const&) = delete;
    ProvidersEntries& operator=(ProvidersEntries const&) = delete;

    InboxEntries entries;
    bool closed = false;                // later entries are dropped
    std::list<ProvidersEntries*> turn;  // its only node; in `next_` of the inbox while there are entries
};

// Takes one entry of each provider in turn: a provider that reports a lot delays only its own reports. Thread-safe.
class Inbox {
public:
    // Sets the function that is called when an entry arrives and no thread is there to handle it. It is called on the reporting
    // thread, and must return at once.
    void on_arrival(std::function<void()> wake);

    void wake();  // calls that function

    void add(ProvidersEntries&, InboxEntries&& one);
    void close(ProvidersEntries&) noexcept;
    // The number of entries that wait.
    std::size_t waiting(ProvidersEntries const&) const;
    // Returns one entry, or none.
    InboxEntries take() noexcept;
    // For an entry whose handling failed: it is taken again first.
    void put_back(InboxEntries&& one) noexcept;
    bool empty() const { return is_empty_.load(std::memory_order_acquire); }

    // Records that a report could not be stored, because memory was short. HostedComponent::take_lost_report names the component.
    void note_lost_report() noexcept;
    bool take_lost_reports() noexcept;

    // While it lives, this thread handles the entries that it adds itself: `on_arrival` is not called for them.
    class Attended {
    public:
        Attended();
        ~Attended();
        Attended(Attended const&) = delete;
        Attended& operator=(Attended const&) = delete;

    private:
        bool before_;
    };

private:
    mutable std::mutex mutex_;
    std::list<ProvidersEntries*> next_;  // the providers with entries, in the order of their turns
    InboxEntries returned_;
    std::atomic<bool> is_empty_ = true;
    bool report_lost_ = false;
    std::function<void()> wake_ = [] {};
};

}  // namespace rois
