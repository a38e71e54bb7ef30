// One I/O thread: its io_context, its request reader, and the connections that live on it.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "gateway/gateway.hpp"
#include "gateway/telemetry.hpp"
#include "gateway/troubles.hpp"
#include "gateway/wakes.hpp"
#include "net/admission.hpp"
#include "net/asio.hpp"
#include "net/documents.hpp"
#include "net/long_documents.hpp"
#include "net/settings.hpp"

namespace rois::net {

class Connection;

// What all loops share; outlives them.
struct Shared {
    Settings settings;
    Gateway& gateway;
    Telemetry& telemetry;
    Documents const& documents;
    std::shared_ptr<xml::Schemas const> schemas;
    Troubles& troubles;
    LongDocuments long_documents{schemas, settings.document, settings.validation};
};

class Loop {
public:
    explicit Loop(Shared&);
    ~Loop();
    Loop(Loop const&) = delete;
    Loop& operator=(Loop const&) = delete;

    // A coroutine that is to go on until it returns: when an exception ends it, that is reported, and it is made again. Before
    // `run`.
    void always(Troubles::Where, std::function<Task<>()>);

    // Until the last connection has gone after shut_down. Survives every exception.
    void run();

    // From any thread.
    void shut_down(std::chrono::milliseconds within);

    // On the loop's own thread.
    void serve(Socket, Admission::Place);
    bool draining() const { return last_moment_ != Steady::max(); }
    Shared& shared() const { return shared_; }
    xml::RequestReader& reader() { return reader_; }
    Executor executor() { return io_.get_executor(); }
    Wakes& wakes() { return wakes_; }

private:
    friend class Connection;

    struct Duty {
        Troubles::Where where;
        std::function<Task<>()> make;
        bool goes_on = false;  // or has returned
    };

    Task<> perform(Duty&);
    void look_after();
    Task<> sweep();
    void sweep_now() noexcept;
    void sweep_some(Steady now);
    void add(Connection&);
    void remove(Connection const&);

    Shared& shared_;
    xml::RequestReader reader_;
    std::vector<Connection*> connections_;
    std::size_t sweeps_for_all_;
    std::size_t swept_ = 0;  // where the next sweep goes on
    std::deque<Duty> duties_;
    bool over_ = false;
    Steady last_moment_ = Steady::max();  // set by shut_down: at that time whoever is still there is cut
    asio::io_context io_{1};
    Wakes wakes_;
};

}  // namespace rois::net
