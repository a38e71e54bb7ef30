// One I/O thread: its io_context, its request reader and its connections.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <utility>
#include <vector>

#include "gateway/access/admission.hpp"
#include "gateway/access/first_of.hpp"
#include "gateway/gateway.hpp"
#include "gateway/process/telemetry.hpp"
#include "gateway/process/troubles.hpp"
#include "gateway/wakes.hpp"
#include "net/http/documents.hpp"
#include "net/long_documents.hpp"
#include "net/settings.hpp"
#include "wire/turns.hpp"

namespace rois::net {

class Connection;

// Shared by all loops; must outlive them.
class Shared {
public:
    Shared(Settings settings, Gateway& of, Telemetry& counts, Documents const& served, std::shared_ptr<xml::Schemas const> all,
           Troubles& reported)
        : gateway{of},
          telemetry{counts},
          documents{served},
          schemas{std::move(all)},
          troubles{reported},
          long_documents{schemas} {
        use(std::move(settings));
    }

    // Thread-safe. The reference stays valid, also when there are other settings.
    Settings const& settings() const { return *settings_.load(std::memory_order_acquire); }
    // Call it on one thread.
    void use(Settings settings) { settings_.store(&versions_.emplace_back(std::move(settings)), std::memory_order_release); }

    Gateway& gateway;
    Telemetry& telemetry;
    Documents const& documents;
    std::shared_ptr<xml::Schemas const> schemas;
    Troubles& troubles;
    LongDocuments long_documents;
    // Each thread soon cuts a stranger, or the connection that has been idle for longest. Returns whether there is a stranger;
    // that is known when all threads have looked, and the caller is the only holder of the value.
    std::function<std::shared_ptr<std::atomic<bool> const>(bool among_strangers)> make_room;

private:
    std::list<Settings> versions_;  // after each SIGHUP one more
    std::atomic<Settings const*> settings_ = nullptr;
};

class Loop {
public:
    explicit Loop(Shared&);

    // Adds a coroutine that runs until it returns. After an exception, which is reported, `make` is called again. Call this
    // before `run`.
    void run_forever(Troubles::Where, std::function<Task<>()>);

    // Runs until `shut_down` was called and the last connection of all loops has ended. Survives every exception.
    void run();

    // Thread-safe. Cuts the remaining connections after `within`.
    void shut_down(std::chrono::milliseconds within);

    // The loop's own thread calls the functions below.
    // Where connections come from. `programs`: those that this gateway starts, on a port of their own (Server::url_for_programs).
    enum class From : std::uint8_t { network, programs, this_process };
    void serve(Socket, Admission::Place, From);
    // Cuts the connection that has been idle for longest. Returns false if none has been for 0.1 s.
    bool cut_longest_idle();
    // With tokens, cuts the oldest connection of this address (null: of any, if it is 0.1 s old) that has shown none.
    enum class Stranger : std::uint8_t { none, stays, cut };
    Stranger cut_stranger(Address const* from);
    bool draining() const { return last_moment_ != Steady::max(); }
    Shared& shared() const { return shared_; }
    xml::RequestReader& reader() { return reader_.use(shared_.settings().document, shared_.settings().validation); }
    Executor executor() { return io_.get_executor(); }
    Wakes& wakes() { return wakes_; }
    Turns& turns() { return turns_; }  // of strangers

private:
    friend class Connection;

    struct Background {
        Troubles::Where where;
        std::function<Task<>()> make;
        bool is_started = false;  // false: not yet, or an exception has ended it
    };

    Task<> run(Background&);
    void start_background();
    Task<> sweep();
    void sweep_some(Steady now);
    void add(Connection&);
    void remove(Connection const&);

    Shared& shared_;
    xml::RequestReader reader_;
    std::vector<Connection*> connections_;
    FirstOf<Connection> idlest_, oldest_stranger_;
    std::size_t swept_ = 0;    // index of the next connection to check
    std::int64_t sweeps_ = 0;  // none while this loop stands still
    std::deque<Background> background_;
    bool over_ = false;
    Steady last_moment_ = Steady::max();  // set by shut_down: the remaining connections are cut then
    asio::io_context io_{1};
    Turns turns_{io_.get_executor()};
    Wakes wakes_;
};

}  // namespace rois::net
