// One HTTP connection: receives requests and answers them in order. It may become a WebSocket or an event stream.
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gateway/access/token_check.hpp"
#include "gateway/gateway.hpp"
#include "net/http/http_answer.hpp"
#include "net/http/http_head.hpp"
#include "net/http/routes.hpp"
#include "net/loop.hpp"
#include "net/websocket/websocket.hpp"
#include "wire/wire.hpp"

namespace rois::net {

// Always held by a shared_ptr. Belongs to the thread of its loop, except for the constructor. The loop must outlive it.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(Loop&, Socket, Admission::Place, Loop::From);
    ~Connection();

    // Runs until the connection ends.
    Task<> run();

    void sweep(Steady now);
    void shut_down();
    void cut() { wire_.cut(); }
    // Cuts the connection. Its place is free at once.
    void give_way() {
        wire_.cut();
        place_.leave();
    }
    // When this connection ends if no request begins; `max` if it is not idle, or an answer is still to come.
    Steady idle_due() const { return idle_ && waiting_.empty() && !place_.is_left() ? idle_due_ : Steady::max(); }
    std::int64_t accepted() const { return accepted_; }  // the loop's number of sweeps then
    // Whether the gateway has tokens, and this connection has a place, comes from this address (null: any), and has shown none.
    bool is_stranger(Address const* from = nullptr) const {
        bool const is_from = from == nullptr || place_.address() == *from;
        bool const is_known = from_ != Loop::From::network || place_.has_token();
        return loop_.shared().gateway.tokens() != nullptr && !is_known && is_from && !place_.is_left();
    }

private:
    friend class Loop;

    // The next step of the connection. `receive`: the request is incomplete. `linger`: close after the last answer.
    enum class Then : std::uint8_t { next, receive, websocket, engine, linger, end };

    Task<Then> secure();
    Task<Then> serve();
    Then take_request();
    Then take_head();
    Then judge_head();
    std::optional<HttpAnswer> identify();
    Task<Then> receive();
    Task<Then> serve_other();
    Then serve_upgrade();
    Task<> serve_websocket();
    Task<> hand_over();
    Task<Then> serve_notifications();

    // These functions queue the answer, and `flush` sends it. `last`: the connection ends behind it.
    enum class Framed : std::uint8_t { as_asked, last };
    Then reply(HttpAnswer, Framed = Framed::as_asked);
    HttpAnswer http_answer(Answer&&);
    Then take(PendingAnswer&&);
    // Queues the ready answers, in the order of the requests. Returns false if an answer still waits for a component.
    bool take_answers();
    void answers_came();
    Task<> await_answers();
    Then refuse(Fault const&);
    void log(Fault const&, std::string_view request);
    std::string request_line() const;
    // Returns false if the socket takes only a part at once. Then `flush` sends the rest.
    bool flush_at_once();
    void forget_out();
    void cut_for_memory();
    Task<> flush();

    Loop& loop_;
    std::size_t index_ = 0;  // index among the loop's connections; only the loop uses it
    Loop::From const from_;
    Admission::Place place_;
    std::shared_ptr<Client> client_;
    TokenCheck token_check_;
    Wire wire_;
    std::optional<Telemetry::Counted> counted_;
    // The current request:
    std::size_t searched_ = 0;  // number of received bytes in which no head ends
    bool has_head_ = false;     // `head_`, `route_` and `session_` are those of the current request
    RequestHead head_;
    Route route_;
    SessionId session_;  // that the request names; empty if it names none
    std::int64_t const accepted_ = loop_.sweeps_;
    Steady request_due_ = Steady::max();
    Steady idle_due_ = Steady::max();  // when the next request must have begun; empty lines do not begin one
    bool idle_ = false;                // no byte of the next request has arrived
    // An answer that waits for its turn.
    struct Waiting {
        std::variant<PendingAnswer, HttpAnswer> answer;
        Framing framing;
    };
    std::shared_ptr<Waker> waker_;             // is woken when an answer has come
    std::shared_ptr<WakeUp> answers_wake_up_;  // raised when an answer has come; null if nothing waits for that
    std::list<Waiting> waiting_;               // in the order of their requests; the first one has not come yet
    std::string out_;                          // answers for the next write
    std::vector<Hold> holds_;                  // keep notifications behind these answers
    std::weak_ptr<WebSocket> websocket_;
    bool has_joined_ = false;  // its bytes are passed on
};

}  // namespace rois::net
