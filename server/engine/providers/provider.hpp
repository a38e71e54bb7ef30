// Runs the calls of the engine to its components (docs/engine.md).
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/component.hpp"
#include "engine/providers/inbox.hpp"

namespace rois {

class HostedComponent;
class Provider;

// The providers with calls that no thread runs yet. Needs the lock that serializes the calls to the engine.
class ProvidersToRun {
public:
    // Reserves room for this number of providers.
    void expect(std::size_t providers) { providers_.reserve(providers); }
    void add(std::shared_ptr<Provider>) noexcept;
    // Returns the one that was added first, or null.
    std::shared_ptr<Provider> take() noexcept;

private:
    std::vector<std::shared_ptr<Provider>> providers_;
    std::size_t taken_ = 0;  // number of entries of providers_ that are already taken
};

// A provider of components: a device with its components, a driver, or a link to another engine. Its components are called one at
// a time, in the order of the calls. `join`, `part`, `run`, `report`, `is_full` and `close` are thread-safe; all other functions
// need the lock that serializes the calls to the engine.
class Provider : public std::enable_shared_from_this<Provider> {
public:
    // Where the calls run: on the threads that call `run`, or on a thread of the provider.
    enum class Runs : std::uint8_t { on_callers_thread, on_own_thread };

    Provider(Runs runs, std::shared_ptr<Inbox> inbox, ProvidersToRun& to_run)
        : runs_{runs}, inbox_{std::move(inbox)}, to_run_{to_run} {}
    ~Provider() { close(); }
    Provider(Provider const&) = delete;
    Provider& operator=(Provider const&) = delete;

    bool has_own_thread() const { return runs_ == Runs::on_own_thread; }

    // A component joins within its first call.
    void join(std::shared_ptr<HostedComponent> const&);
    void part(HostedComponent const&);

    using Awaited = decltype(CallFailed::awaited);
    struct Call {
        std::shared_ptr<HostedComponent> to;   // null: a device
        std::function<void(Component*)> what;  // null: a query, or a halt
        std::string query_type{};              // of a query
        Awaited awaited{};                     // an exception of the call is reported for this question or command
        Instant now{};                         // of a query or a halt
        bool is_question = false;              // `after_call` is not called after it
        Report report = Report::each;          // of an exception

        bool is_halt() const { return !what && query_type.empty(); }
    };

    void add(Call);
    // A halt needs no memory.
    void add_halt(std::shared_ptr<HostedComponent>, Ticket, Instant now) noexcept;

    // `clock`: the thread that advances the devices.
    enum class Runner : std::uint8_t { client, clock };
    // Runs the waiting calls, unless another thread runs them already. Returns whether calls are left for the clock: the advance
    // of a device, and those behind it.
    bool run(Runner);

    void report(std::shared_ptr<HostedComponent> from, InboxEntry::What);
    Inbox& inbox() { return *inbox_; }
    // Returns whether more reports wait than the engine handles in some milliseconds. Thread-safe.
    bool is_full() const { return inbox_->waiting(entries_) > most_waiting; }

    // The provider's thread ends after its present call.
    void close();

private:
    friend class ProvidersToRun;

    static constexpr std::size_t most_waiting = 1'000;

    bool has_waiting(Runner) const;
    void run_waiting(std::unique_lock<std::mutex>&, Runner);
    void carry_out(Call const&) noexcept;
    void after(std::shared_ptr<HostedComponent> const&) noexcept;
    void report_failure(std::shared_ptr<HostedComponent> const&, Awaited, std::exception_ptr const&, Report) noexcept;
    void work();
    void call_runner() noexcept;

    Runs runs_;
    std::shared_ptr<Inbox> inbox_;
    ProvidersToRun& to_run_;
    bool is_listed_ = false;  // in to_run_
    ProvidersEntries entries_;
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::vector<std::shared_ptr<HostedComponent>> components_;
    std::vector<Call> calls_;
    std::size_t begun_ = 0;  // number of entries of calls_ that have already begun
    bool is_running_ = false;
    bool has_thread_ = false;
    bool closed_ = false;
};

}  // namespace rois
