#include "net/connection.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <utility>

#include "net/event_stream.hpp"
#include "net/upgrade.hpp"
#include "types/identifier_length.hpp"

namespace rois::net {

namespace {

constexpr unsigned most_in_a_row = 4;              // pipelined requests, until others have their turn
constexpr std::size_t most_to_gather = 64 * 1024;  // bytes of answers to pipelined requests
constexpr std::size_t most_to_keep = 16 * 1024;    // of memory for them, while there are none
constexpr auto longest_linger = std::chrono::seconds{2};
constexpr auto longest_wait_without_memory = std::chrono::milliseconds{100};  // for a request, while the system has no memory

Steady now() { return std::chrono::steady_clock::now(); }

Fault too_slow() { return {FaultCode::too_slow, "the request did not arrive in time", {}, {}}; }

}  // namespace

Connection::Connection(Loop& loop, Socket socket, Admission::Place place)
    : loop_{loop},
      place_{std::move(place)},
      opener_{std::make_shared<Opener>(place_.address(), place_.limits(), 0U)},
      wire_{std::move(socket), loop.shared().settings.write_timeout, loop.shared().telemetry},
      counted_{std::in_place, loop.shared().telemetry, Telemetry::Kind::http} {
    loop.add(*this);
    loop.shared().telemetry.accepted();
}

Connection::~Connection() { loop_.remove(*this); }

Task<> Connection::run() {
    auto then = Then::end;
    if (!loop_.draining()) then = co_await serve();
    if (then == Then::websocket) co_await serve_websocket();
    if (then == Then::linger) {
        co_await flush();
        co_await wire_.linger(now() + longest_linger);
    }
    wire_.cut();
}

void Connection::sweep(Steady at) {
    wire_.sweep(at);
    auto const websocket = websocket_.lock();
    if (websocket) websocket->sweep(at);
    auto const& memory = loop_.shared().gateway.memory();
    if (!memory.tight()) return;
    bool const arriving = websocket || request_due_ != Steady::max();
    auto const unfinished = arriving ? wire_.received().size() + (websocket ? websocket->gathered() : 0) : 0;
    bool const unread = memory.full() && wire_.waits_for_reader();
    bool const only_waits = memory.exhausted() && waits_since(at - longest_wait_without_memory);
    if (unread || only_waits || unfinished > memory.longest_document()) cut_for_memory();
}

// Whether the connection already waited for a request, or for the rest of one, at that time.
bool Connection::waits_since(Steady then) const {
    auto const& settings = loop_.shared().settings;
    bool const idle = idle_due_ != Steady::max() && idle_due_ - settings.idle_timeout <= then;
    return idle || (request_due_ != Steady::max() && request_due_ - settings.request_timeout <= then);
}

void Connection::shut_down() {
    if (auto const websocket = websocket_.lock()) websocket->shut_down();
    if (idle_) wire_.stop_waiting();
}

// Serves one request after the other.
Task<Connection::Then> Connection::serve() {
    auto then = Then::next;
    unsigned in_a_row = 0;
    while (then == Then::next) {
        then = take_request();
        if (then == Then::receive) {
            in_a_row = 0;
            then = co_await receive();
            continue;
        }
        request_due_ = idle_due_ = Steady::max();
        bool const whole = std::exchange(has_head_, false);
        bool const is_request = head().method == "POST" && route_.endpoint == Endpoint::rois;
        if (whole && !is_request) then = co_await serve_other();
        if (whole && is_request) {
            Answer answer;
            if (LongDocuments::is_long(head().content_length))
                answer = co_await operate_apart();
            else
                answer = operate();
            wire_.use(head().content_length);
            if (answer.turn == Answer::Turn::disconnected) {
                co_await flush();
                co_await others_heard(loop_.shared().gateway, session_, loop_.executor(), loop_.wakes());
            }
            then = reply(std::move(answer));
        }
        if (out_.size() > most_to_gather || holds_.size() >= loop_.shared().settings.max_requests_in_flight) co_await flush();
        ++in_a_row;
        if (in_a_row % most_in_a_row == 0) co_await asio::post(loop_.executor(), asio::use_awaitable_t<Executor>{});
    }
    co_return then;
}

// Goes as far as what has been received allows: `next` when a request is there, whole, or has been refused.
Connection::Then Connection::take_request() {
    if (!has_head_) {
        auto const then = take_head();
        if (then != Then::next) return then;
        auto const judged = judge_head();
        if (!has_head_) return judged;
        if (wire_.received().size() < head().content_length && !head().http_1_0 && head().lists("Expect", "100-continue"))
            out_.append("HTTP/1.1 100 Continue\r\n\r\n");
    }
    if (wire_.received().size() >= head().content_length) return Then::next;
    auto& memory = loop_.shared().gateway.memory();
    if (head().content_length <= memory.longest_document()) return Then::receive;
    auto const refused = refuse(no_memory_for_document(memory));
    has_head_ = false;
    return refused;
}

Connection::Then Connection::take_head() {
    auto const& settings = loop_.shared().settings;
    while (wire_.text().starts_with("\r\n")) {  // RFC 9112, 2.2
        wire_.use(2);
        searched_ = 0;
    }
    auto const size = find_head(wire_.text(), searched_);
    if (size == 0 && wire_.received().size() <= settings.max_header) return Then::receive;
    if (size == 0 || size > settings.max_header) return refuse(overlong_head(wire_.text(), settings));
    searched_ = 0;
    if (auto const fault = heads_->read(wire_.text().substr(0, size), settings)) return refuse(*fault);
    wire_.use(size);
    constexpr auto enough = longest_identifier + 1;  // a longer id is unknown, and so is its beginning
    if (!heads_->repeated()) session_.text.assign(head().field("RoIS-Session").value_or("").substr(0, enough));
    return Then::next;
}

// Sends a request away by its head alone, or keeps it. What was kept is kept again, unless its length is another.
Connection::Then Connection::judge_head() {
    auto const& settings = loop_.shared().settings;
    has_head_ = heads_->repeated() && !refused_ && head().content_length <= settings.document.bytes;
    if (has_head_) return Then::next;
    route_ = route_of(head().path);
    auto const refused = refusal(head(), route_, settings);
    refused_ = refused.has_value();
    has_head_ = !refused_;
    if (!refused) return Then::next;
    if (head().content_length > wire_.received().size()) return reply(*refused, Framed::last);
    wire_.use(head().content_length);
    return reply(*refused);
}

// Waits for more of the request, or for a new one: `next` when something has come.
Task<Connection::Then> Connection::receive() {
    auto const& settings = loop_.shared().settings;
    if (!flush_at_once()) co_await flush();
    idle_ = !has_head_ && wire_.received().empty();
    if (idle_ && loop_.draining()) co_return Then::end;
    if (idle_) request_due_ = Steady::max();
    if (idle_) heads_->forget_if_long();
    if (!idle_ && request_due_ == Steady::max()) request_due_ = now() + settings.request_timeout;
    auto const expected = has_head_ ? head().content_length - wire_.received().size() : 0;
    if (idle_ && idle_due_ == Steady::max()) idle_due_ = now() + settings.idle_timeout;
    auto const until = idle_ ? idle_due_ : request_due_;
    auto const before = wire_.received().size();
    auto const outcome = co_await wire_.receive(until, expected);
    if (has_head_) loop_.shared().gateway.memory().took(wire_.received().size() - before);
    bool const silent = std::exchange(idle_, false);
    if (outcome == Wire::Outcome::closed || (outcome == Wire::Outcome::late && silent)) co_return Then::end;
    if (outcome == Wire::Outcome::late) co_return refuse(too_slow());
    co_return Then::next;
}

std::string_view Connection::body() { return wire_.text().substr(0, head().content_length); }

Answer Connection::operate() { return loop_.shared().gateway.answer(loop_.reader(), session_, body(), Via::http, opener_); }

Task<Answer> Connection::operate_apart() {
    co_await flush();  // answers to earlier requests do not wait for it
    auto& shared = loop_.shared();
    co_return co_await shared.long_documents.answer(shared.gateway, session_, body(), Via::http, opener_);
}

Connection::Then Connection::reply(Answer&& answer) {
    HttpAnswer http;
    http.body = std::move(answer.document);
    if (answer.fault) {
        http.status = http_status_of(answer.fault->code);
        if (http.status == 429) http.set("Retry-After", "1");
        log(*answer.fault, request_line());
    }
    if (answer.turn == Answer::Turn::connected) http.set("RoIS-Session", answer.session.text);
    if (answer.session_number != 0) {
        http.set("RoIS-Session-Number", std::to_string(answer.session_number));
        log_joined(answer.session_number, "opened over HTTP", wire_.peer());
    }
    holds_.push_back(std::move(answer.hold));
    return reply(http);
}

Task<Connection::Then> Connection::serve_other() {
    wire_.use(head().content_length);
    if (route_.endpoint == Endpoint::rois) co_return serve_upgrade();
    if (route_.endpoint == Endpoint::stop) co_return reply(stop_everything());
    if (route_.endpoint == Endpoint::clear) co_return reply(clear());
    if (route_.endpoint == Endpoint::notifications) co_return co_await serve_notifications();
    co_return reply(loop_.shared().documents.answer(route_, head()));
}

// Decision 34. Stops first: the log and the answer need memory.
HttpAnswer Connection::stop_everything() {
    auto const state = loop_.shared().gateway.stop_everything();
    spdlog::warn("everything is stopped, as asked by {}", wire_.peer());
    HttpAnswer answer;
    answer.body = xml::encode(state);
    return answer;
}

HttpAnswer Connection::clear() {
    auto const state = loop_.shared().gateway.clear();
    spdlog::warn("commands may start again, as asked by {}", wire_.peer());
    HttpAnswer answer;
    answer.body = xml::encode(state);
    return answer;
}

Connection::Then Connection::serve_upgrade() {
    auto const& shared = loop_.shared();
    if (shared.gateway.shutting_down()) return reply(answer_of(shutting_down()));
    auto const answer = upgrade(head());
    if (answer.status != 101) return reply(answer);
    append(out_, answer, {});
    return Then::websocket;
}

// Of the request nothing is kept: there may be many thousand WebSockets that wait.
Task<> Connection::serve_websocket() {
    co_await flush();
    heads_.reset();
    std::string{}.swap(out_);
    auto& shared = loop_.shared();
    counted_.emplace(shared.telemetry, Telemetry::Kind::websocket);
    auto const websocket =
        std::make_shared<WebSocket>(std::shared_ptr<Wire>{shared_from_this(), &wire_}, shared.gateway, shared.telemetry,
                                    loop_.reader(), shared.long_documents, loop_.wakes(), shared.settings, opener_);
    websocket_ = websocket;
    if (loop_.draining()) websocket->shut_down();
    co_await websocket->run();
}

Task<Connection::Then> Connection::serve_notifications() {
    auto const& shared = loop_.shared();
    auto const read = read_wanted(head());
    if (auto const* fault = std::get_if<Fault>(&read)) co_return reply(answer_of(*fault));
    if (shared.gateway.shutting_down()) co_return reply(answer_of(shutting_down()));
    auto wanted = std::get<NotificationsWanted>(read);
    co_await flush();
    if (wanted.as == NotificationsWanted::As::stream && head().method == "GET") {
        counted_.emplace(shared.telemetry, Telemetry::Kind::stream);
        auto const refused =
            co_await stream(wire_, shared.gateway, shared.telemetry, loop_.wakes(), session_, wanted, shared.settings);
        if (!refused) co_return Then::linger;
        counted_.emplace(shared.telemetry, Telemetry::Kind::http);
        co_return reply(*refused);
    }
    auto const answer = co_await poll(wire_, shared.gateway, shared.telemetry, loop_.wakes(), session_, wanted);
    co_return reply(answer);
}

Connection::Then Connection::reply(HttpAnswer const& answer, Framed framed) {
    if (answer.fault) {
        loop_.shared().telemetry.faulted(answer.fault->code);
        log(*answer.fault, request_line());
    }
    bool const close = framed == Framed::last || !head().keep_alive() || loop_.draining();
    append(out_, answer, {.body = head().method != "HEAD", .close = close});
    return close ? Then::linger : Then::next;
}

// For a request whose end cannot be told: the connection ends with the answer. Unless the head was accepted, it is still among
// the received bytes, and `head()` may be that of an earlier request.
Connection::Then Connection::refuse(Fault const& fault) {
    loop_.shared().telemetry.faulted(fault.code);
    log(fault, has_head_ ? request_line() : wire_.text().substr(0, wire_.text().find_first_of("\r\n")));
    bool const asks_for_head = has_head_ ? head().method == "HEAD" : wire_.text().starts_with("HEAD ");
    auto answer = answer_of(fault);
    if (answer.status == 429) answer.set("Retry-After", "1");
    append(out_, answer, {.body = !asks_for_head, .close = true});
    return Then::linger;
}

void Connection::log(Fault const& fault, std::string_view request) {
    if (is_logged(fault.code)) log_fault(fault, request, wire_.peer());
}

// Of the request whose head was accepted last, without the query.
std::string Connection::request_line() const { return std::string{head().method}.append(" ").append(head().path); }

bool Connection::flush_at_once() {
    out_.erase(0, wire_.send_now(out_));
    if (!out_.empty()) return false;
    forget_out();
    return true;
}

// What the peer does not take at once waits here: not while memory_budget is used up.
Task<> Connection::flush() {
    if (flush_at_once()) co_return;
    auto& memory = loop_.shared().gateway.memory();
    memory.took(out_.size());
    if (memory.full()) cut_for_memory();
    co_await wire_.send(out_);
    out_.clear();
    forget_out();
}

void Connection::forget_out() {
    if (out_.capacity() > most_to_keep) std::string{}.swap(out_);
    holds_.clear();
}

void Connection::cut_for_memory() {
    spdlog::warn("the connection of {} was cut: {}", wire_.peer(),
                 loop_.shared().gateway.memory().refuse("there is no memory for a connection that waits"));
    loop_.shared().telemetry.cut();
    wire_.cut();
}

}  // namespace rois::net
