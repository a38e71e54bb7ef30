// One HTTP connection: receives requests, has them answered in order, and becomes a WebSocket or a stream when asked to.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/gateway.hpp"
#include "net/http_answer.hpp"
#include "net/http_head.hpp"
#include "net/loop.hpp"
#include "net/routes.hpp"
#include "net/websocket.hpp"
#include "net/wire.hpp"

namespace rois::net {

// Always held by a shared_ptr. All but the constructor belongs to the loop's thread; the loop must outlive it.
// A coroutine is only what may have to wait: a request whose bytes are there is read and answered without one.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(Loop&, Socket, Admission::Place);
    ~Connection();

    // Until the connection is over.
    Task<> run();

    void sweep(Steady now);
    void shut_down();
    void cut() { wire_.cut(); }

private:
    friend class Loop;

    // What becomes of the connection after a request; `receive`: it has not arrived whole.
    enum class Then : std::uint8_t { next, receive, websocket, linger, end };

    RequestHead const& head() const { return heads_->last(); }
    Task<Then> serve();
    Then take_request();
    std::string_view body();
    Answer operate();
    Task<Answer> operate_apart();
    Then take_head();
    Then judge_head();
    Task<Then> receive();
    Then reply(Answer&&);
    Task<Then> serve_other();
    HttpAnswer stop_everything();
    HttpAnswer clear();
    Then serve_upgrade();
    Task<> serve_websocket();
    Task<Then> serve_notifications();

    // They only queue the answer; flush sends what is queued.
    enum class Framed : std::uint8_t { as_asked, last };
    Then reply(HttpAnswer const&, Framed = Framed::as_asked);
    Then refuse(Fault const&);
    void log(Fault const&, std::string_view request);
    std::string request_line() const;
    // False when the socket takes only a part at once: then `flush` goes on.
    bool flush_at_once();
    void forget_out();
    bool waits_since(Steady) const;
    void cut_for_memory();
    Task<> flush();

    Loop& loop_;
    std::size_t seat_ = 0;  // among the loop's connections: the loop's own
    Admission::Place place_;
    std::shared_ptr<Opener> opener_;
    Wire wire_;
    std::optional<Telemetry::Counted> counted_;
    // The request that is being received or served.
    std::size_t searched_ = 0;                        // bytes in which no head ends
    bool has_head_ = false;                           // of these four
    std::optional<HeadReader> heads_{std::in_place};  // none behind a WebSocket
    bool refused_ = false;                            // by its head
    Route route_;
    SessionId session_;  // that it names; empty when it names none
    Steady request_due_ = Steady::max();
    Steady idle_due_ = Steady::max();  // when the next request must have begun; empty lines are none
    bool idle_ = false;                // no byte of it has come
    std::string out_;                  // answers that wait for the next write
    std::vector<Hold> holds_;          // and the notifications that wait for them
    std::weak_ptr<WebSocket> websocket_;
};

}  // namespace rois::net
