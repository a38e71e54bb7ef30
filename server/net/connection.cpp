#include "net/connection.hpp"

#include <utility>

#include "net/event_stream.hpp"
#include "net/upgrade.hpp"

namespace rois::net {

namespace {

constexpr std::size_t most_to_gather = 64 * 1024;  // bytes of answers to pipelined requests
constexpr auto longest_linger = std::chrono::seconds{2};

Steady now() { return std::chrono::steady_clock::now(); }

Fault too_slow() { return {FaultCode::too_slow, "the request did not arrive in time", {}, {}}; }

SessionId session_of(RequestHead const& head) { return {std::string{head.field("RoIS-Session").value_or("")}}; }

}  // namespace

Connection::Connection(Loop& loop, Socket socket)
    : loop_{loop},
      wire_{std::move(socket), loop.shared().settings.write_timeout, loop.shared().telemetry},
      counted_{std::in_place, loop.shared().telemetry, Telemetry::Kind::http} {
    loop.shared().telemetry.accepted();
}

Connection::~Connection() { loop_.connections_.erase(this); }

Task<> Connection::run() {
    loop_.connections_.insert(this);
    auto then = loop_.draining() ? Then::end : Then::next;
    while (then == Then::next) then = co_await serve();
    if (then == Then::websocket) co_await serve_websocket();
    if (then == Then::linger) {
        co_await flush();
        co_await wire_.linger(now() + longest_linger);
    }
    wire_.cut();
}

void Connection::sweep(Steady at) {
    wire_.sweep(at);
    if (auto const websocket = websocket_.lock()) websocket->sweep(at);
}

void Connection::shut_down() {
    if (auto const websocket = websocket_.lock()) websocket->shut_down();
    if (idle_) wire_.stop_waiting();
}

// Serves one request.
Task<Connection::Then> Connection::serve() {
    auto const received = co_await receive_head();
    if (auto const* then = std::get_if<Then>(&received)) co_return *then;
    auto const& head = std::get<RequestHead>(received);
    auto const route = route_of(head.path);
    if (auto const refused = refusal(head, route, loop_.shared().settings)) {
        if (head.content_length > wire_.received().size()) co_return reply(*refused, head, Framed::last);
        wire_.use(head.content_length);
        co_return reply(*refused, head);
    }
    auto then = co_await receive_body(head);
    if (then != Then::next) co_return then;
    then = co_await dispatch(route, head);
    if (out_.size() > most_to_gather || holds_.size() >= loop_.shared().settings.max_requests_in_flight) co_await flush();
    co_return then;
}

Task<std::variant<RequestHead, Connection::Then>> Connection::receive_head() {
    auto const& settings = loop_.shared().settings;
    request_due_ = wire_.received().empty() ? Steady::max() : now() + settings.request_timeout;
    std::size_t searched = 0;
    std::size_t size = 0;
    while (true) {
        while (wire_.text().starts_with("\r\n")) {  // RFC 9112, 2.2
            wire_.use(2);
            searched = 0;
        }
        size = find_head(wire_.text(), searched);
        if (size > 0 || wire_.received().size() > settings.max_header) break;
        co_await flush();
        idle_ = wire_.received().empty();
        if (idle_ && loop_.draining()) co_return Then::end;
        auto const outcome = co_await wire_.receive(idle_ ? now() + settings.idle_timeout : request_due_);
        bool const silent = std::exchange(idle_, false);
        if (outcome == Wire::Outcome::closed || (outcome == Wire::Outcome::late && silent)) co_return Then::end;
        if (outcome == Wire::Outcome::late) co_return refuse(too_slow());
        if (silent) request_due_ = now() + settings.request_timeout;
    }
    if (size == 0 || size > settings.max_header) co_return refuse(overlong_head(wire_.text(), settings));
    head_text_.assign(wire_.text().substr(0, size));
    wire_.use(size);
    auto read = read_head(head_text_, settings);
    if (auto const* fault = std::get_if<Fault>(&read)) co_return refuse(*fault);
    co_return std::get<RequestHead>(std::move(read));
}

// `next` when the body is there, whole.
Task<Connection::Then> Connection::receive_body(RequestHead const& head) {
    if (wire_.received().size() >= head.content_length) co_return Then::next;
    if (!head.http_1_0 && head.lists("Expect", "100-continue")) out_.append("HTTP/1.1 100 Continue\r\n\r\n");
    co_await flush();
    while (wire_.received().size() < head.content_length) {
        auto const outcome = co_await wire_.receive(request_due_, head.content_length - wire_.received().size());
        if (outcome == Wire::Outcome::closed) co_return Then::end;
        if (outcome == Wire::Outcome::late) co_return refuse(too_slow());
    }
    co_return Then::next;
}

Task<Connection::Then> Connection::dispatch(Route const& route, RequestHead const& head) {
    if (head.method == "POST") co_return co_await serve_operation(head);
    wire_.use(head.content_length);
    if (route.endpoint == Endpoint::rois) co_return serve_upgrade(head);
    if (route.endpoint == Endpoint::notifications) co_return co_await serve_notifications(head);
    co_return reply(loop_.shared().documents.answer(route, head), head);
}

Task<Connection::Then> Connection::serve_operation(RequestHead const& head) {
    auto& gateway = loop_.shared().gateway;
    auto const session = session_of(head);
    auto answer = gateway.answer(loop_.reader(), session, wire_.text().substr(0, head.content_length), Via::http);
    wire_.use(head.content_length);
    HttpAnswer http;
    http.body = std::move(answer.document);
    if (answer.fault) http.status = status_of(*answer.fault);
    if (answer.turn == Answer::Turn::connected) http.set("RoIS-Session", answer.session.text);
    if (answer.turn == Answer::Turn::disconnected) {
        co_await flush();
        co_await others_heard(gateway, session, loop_.wakes());
    }
    holds_.push_back(std::move(answer.hold));
    co_return reply(http, head);
}

Connection::Then Connection::serve_upgrade(RequestHead const& head) {
    auto const& shared = loop_.shared();
    if (shared.gateway.shutting_down()) return reply(answer_of(shutting_down()), head);
    auto const answer = upgrade(head, shared.settings);
    if (answer.status != 101) return reply(answer, head);
    append(out_, answer, {});
    return Then::websocket;
}

// Of the request nothing is kept: there may be many thousand WebSockets that wait.
Task<> Connection::serve_websocket() {
    co_await flush();
    std::string{}.swap(head_text_);
    std::string{}.swap(out_);
    auto const& shared = loop_.shared();
    counted_.emplace(shared.telemetry, Telemetry::Kind::websocket);
    auto const websocket = std::make_shared<WebSocket>(std::shared_ptr<Wire>{shared_from_this(), &wire_}, shared.gateway,
                                                       shared.telemetry, loop_.reader(), loop_.wakes(), shared.settings);
    websocket_ = websocket;
    if (loop_.draining()) websocket->shut_down();
    co_await websocket->run();
}

Task<Connection::Then> Connection::serve_notifications(RequestHead const& head) {
    auto const& shared = loop_.shared();
    auto const read = read_wanted(head);
    if (auto const* fault = std::get_if<Fault>(&read)) co_return reply(answer_of(*fault), head);
    if (shared.gateway.shutting_down()) co_return reply(answer_of(shutting_down()), head);
    auto wanted = std::get<NotificationsWanted>(read);
    auto const session = session_of(head);
    co_await flush();
    if (wanted.as == NotificationsWanted::As::stream && head.method == "GET") {
        counted_.emplace(shared.telemetry, Telemetry::Kind::stream);
        auto const refused =
            co_await stream(wire_, shared.gateway, shared.telemetry, loop_.wakes(), session, wanted, shared.settings);
        if (!refused) co_return Then::linger;
        counted_.emplace(shared.telemetry, Telemetry::Kind::http);
        co_return reply(*refused, head);
    }
    auto const answer = co_await poll(wire_, shared.gateway, shared.telemetry, loop_.wakes(), session, wanted);
    co_return reply(answer, head);
}

Connection::Then Connection::reply(HttpAnswer const& answer, RequestHead const& head, Framed framed) {
    if (answer.fault) loop_.shared().telemetry.faulted(*answer.fault);
    bool const close = framed == Framed::last || !head.keep_alive() || loop_.draining();
    append(out_, answer, {.body = head.method != "HEAD", .close = close});
    return close ? Then::linger : Then::next;
}

// For a request whose end cannot be told: the connection ends with the answer.
Connection::Then Connection::refuse(Fault const& fault) {
    loop_.shared().telemetry.faulted(fault.code);
    append(out_, answer_of(fault), {.body = true, .close = true});
    return Then::linger;
}

Task<> Connection::flush() {
    if (out_.empty()) co_return;
    co_await wire_.send(out_);
    out_.clear();
    holds_.clear();
}

}  // namespace rois::net
