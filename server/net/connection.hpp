// One HTTP connection: receives requests, has them answered in order, and becomes a WebSocket or a stream when asked to.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "net/gateway.hpp"
#include "net/http_answer.hpp"
#include "net/http_head.hpp"
#include "net/loop.hpp"
#include "net/routes.hpp"
#include "net/websocket.hpp"
#include "net/wire.hpp"

namespace rois::net {

// Always held by a shared_ptr. All but the constructor belongs to the loop's thread; the loop must outlive it.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(Loop&, Socket);
    ~Connection();

    // Until the connection is over.
    Task<> run();

    void sweep(Steady now);
    void shut_down();
    void cut() { wire_.cut(); }

private:
    // What becomes of the connection after a request.
    enum class Then : std::uint8_t { next, websocket, linger, end };

    Task<Then> serve();
    Task<std::variant<RequestHead, Then>> receive_head();
    Task<Then> receive_body(RequestHead const&);
    Task<Then> dispatch(Route const&, RequestHead const&);
    Task<Then> serve_operation(RequestHead const&);
    Then serve_upgrade(RequestHead const&);
    Task<> serve_websocket();
    Task<Then> serve_notifications(RequestHead const&);

    // Both only queue the answer; flush sends what is queued.
    enum class Framed : std::uint8_t { as_asked, last };
    Then reply(HttpAnswer const&, RequestHead const&, Framed = Framed::as_asked);
    Then refuse(Fault const&);
    Task<> flush();

    Loop& loop_;
    Wire wire_;
    std::optional<Telemetry::Counted> counted_;
    std::string head_text_;  // of the request that is being served
    Steady request_due_ = Steady::max();
    bool idle_ = false;        // no byte of the next request has come
    std::string out_;          // answers that wait for the next write
    std::vector<Hold> holds_;  // and the notifications that wait for them
    std::weak_ptr<WebSocket> websocket_;
};

}  // namespace rois::net
