#include "net/http/connection.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/beast/http/write.hpp>
#include <sstream>
#include <utility>

#include "net/http/event_stream.hpp"
#include "net/websocket/upgrade.hpp"
#include "types/identifier_length.hpp"
#include "wire/credentials.hpp"
#include "wire/relay.hpp"

namespace rois::net {

namespace {

constexpr unsigned most_in_a_row = 4;              // pipelined requests before other connections have their turn
constexpr std::size_t most_to_gather = 64 * 1024;  // bytes of answers to pipelined requests
constexpr std::size_t most_to_keep = 16 * 1024;    // bytes of memory that an empty buffer of answers may keep
constexpr auto longest_linger = std::chrono::seconds{2};
constexpr auto longest_wait_without_memory = std::chrono::milliseconds{100};  // for a request while the system has no memory
constexpr auto longest_wait_of_strangers = std::chrono::seconds{1};           // while memory_budget is nearly used up

}  // namespace

Connection::Connection(Loop& loop, Socket socket, Admission::Place place, Loop::From from)
    : loop_{loop},
      from_{from},
      place_{std::move(place)},
      client_{std::make_shared<Client>(place_.address(), place_.limits())},
      wire_{std::move(socket), loop.shared().settings().write_timeout, loop.shared().telemetry},
      counted_{std::in_place, loop.shared().telemetry, Telemetry::Kind::http} {
    loop.add(*this);
    loop.shared().telemetry.accepted();
}

Connection::~Connection() { loop_.remove(*this); }

Task<> Connection::run() {
    auto then = Then::end;
    if (!loop_.draining()) then = co_await secure();
    if (then == Then::next) then = co_await serve();
    if (then == Then::websocket) co_await serve_websocket();
    if (then == Then::engine) co_await hand_over();
    if (then == Then::linger) {
        co_await await_answers();
        co_await flush();
        co_await wire_.linger(std::chrono::steady_clock::now() + longest_linger);
    }
    wire_.cut();
}

// The WebSocket of an engine that joins goes to the layer that asks this engine. With TLS or a token, only its bytes do: this
// connection cuts it when the token is revoked.
Task<> Connection::hand_over() {
    co_await flush();
    std::ostringstream head;
    head << head_.message << wire_.text();
    auto const& join = loop_.shared().settings().join;
    auto const rights = client_->principal ? client_->principal->rights : nullptr;
    if (!wire_.is_secure() && !rights) co_return join(wire_.release(), head.str(), rights);
    wire_.use(wire_.text().size());
    LocalSocket inside{loop_.executor()}, outside{loop_.executor()};
    asio::local::connect_pair(inside, outside);
    join(UniqueDescriptor{outside.release()}, head.str(), rights);
    has_joined_ = true;
    co_await relay(wire_, inside);
}

void Connection::sweep(Steady at) {
    wire_.sweep(at);
    auto const is_over = [&] { return loop_.draining() && loop_.shared().gateway.not_halted().empty(); };
    if (has_joined_ && ((client_->principal && client_->principal->is_over()) || is_over())) wire_.cut();
    auto const websocket = websocket_.lock();
    if (websocket) websocket->sweep(at);
    auto const& memory = loop_.shared().gateway.memory();
    if (!memory.tight()) return;
    bool const arriving = websocket || request_due_ != Steady::max();
    auto const unfinished = arriving ? wire_.received().size() + (websocket ? websocket->gathered() : 0) : 0;
    bool const unread = memory.full() && wire_.waits_for_reader(at - longest_wait_without_memory);
    auto const& settings = loop_.shared().settings();
    auto const waits_since = std::min(idle_due_ - settings.idle_timeout, request_due_ - settings.request_timeout);
    bool const only_waits = (memory.exhausted() && waits_since <= at - longest_wait_without_memory) ||
                            (is_stranger() && waits_since <= at - longest_wait_of_strangers);
    if (unread || (only_waits && waiting_.empty()) || unfinished > memory.longest_document()) cut_for_memory();
}

void Connection::shut_down() {
    if (auto const websocket = websocket_.lock()) websocket->shut_down();
    if (idle_) wire_.stop_waiting();
}

// Plain HTTP on a port with TLS gets an answer in plain HTTP.
Task<Connection::Then> Connection::secure() {
    auto const& settings = loop_.shared().settings();
    if (!settings.credentials || from_ != Loop::From::network) co_return Then::next;
    idle_ = true;
    idle_due_ = std::chrono::steady_clock::now() + settings.idle_timeout;
    auto const due = std::chrono::steady_clock::now() + settings.handshake_timeout;
    auto const outcome = co_await wire_.secure(settings.credentials->context(), due, loop_.turns());
    idle_ = false;
    if (outcome != Wire::Outcome::done) {
        loop_.shared().telemetry.handshake_failed();
        spdlog::debug("no TLS with {}: {}", wire_.peer(),
                      outcome == Wire::Outcome::late ? "too slow (handshake_timeout)" : "refused");
        co_return Then::end;
    }
    if (wire_.is_secure()) co_return Then::next;
    co_return refuse({FaultCode::not_well_formed, std::string{tls::expects_tls}});
}

Task<Connection::Then> Connection::serve() {
    auto& shared = loop_.shared();
    auto then = Then::next;
    unsigned in_a_row = 0;
    while (then == Then::next) {
        if (is_stranger() && !wire_.received().empty()) {
            auto const is_open = co_await wire_.take_turn(loop_.turns());
            if (!is_open) co_return Then::end;
        }
        then = take_request();
        if (then == Then::receive) {
            then = co_await receive();
            continue;
        }
        request_due_ = idle_due_ = Steady::max();
        bool const whole = std::exchange(has_head_, false);
        bool const is_request = head_.verb() == http::verb::post && route_.endpoint == Endpoint::rois;
        if (whole && !is_request) then = co_await serve_other();
        if (whole && is_request) {
            auto const body = wire_.text().substr(0, head_.content_length);
            if (!waker_)
                waker_ = std::make_shared<Waker>(loop_.wakes(), [of = weak_from_this()] {
                    if (auto const connection = of.lock()) connection->answers_came();
                });
            PendingAnswer answer;
            if (LongDocuments::is_long(body.size())) {
                co_await flush();  // answers to earlier requests do not wait for this one
                answer = co_await shared.long_documents.answer(shared.settings(), shared.gateway, session_, body, Via::http,
                                                               waker_, client_, loop_.wakes());
            } else {
                answer = shared.gateway.answer(loop_.reader(), session_, body, Via::http, waker_, client_);
            }
            wire_.use(head_.content_length);
            if (answer.is_disconnect()) {
                co_await await_answers();
                co_await flush();
                co_await wait_for_other_readers(shared.gateway, session_, loop_.executor(), loop_.wakes());
            }
            then = take(std::move(answer));
        }
        if (waiting_.size() >= shared.settings().max_requests_in_flight) co_await await_answers();
        if (out_.size() > most_to_gather || holds_.size() >= shared.settings().max_requests_in_flight) co_await flush();
        ++in_a_row;
        if (in_a_row % most_in_a_row == 0) co_await asio::post(loop_.executor(), asio::use_awaitable_t<Executor>{});
    }
    co_return then;
}

// Reads from the received bytes. Returns `next` if a request is complete or was refused, and `receive` if bytes are missing.
Connection::Then Connection::take_request() {
    if (has_head_ && wire_.received().size() >= head_.content_length) return judge_head();  // its token may be revoked by now
    if (!has_head_) {
        auto const then = take_head();
        if (then != Then::next) return then;
        auto const judged = judge_head();
        if (!has_head_) return judged;
        if (wire_.received().size() < head_.content_length && !head_.is_http_1_0() && head_.lists("Expect", "100-continue"))
            out_.append("HTTP/1.1 100 Continue\r\n\r\n");
    }
    if (wire_.received().size() >= head_.content_length) return Then::next;
    auto& memory = loop_.shared().gateway.memory();
    if (head_.content_length <= memory.longest_document()) return Then::receive;
    auto const refused = refuse(no_memory_for_document(memory));
    has_head_ = false;
    return refused;
}

Connection::Then Connection::take_head() {
    auto const& settings = loop_.shared().settings();
    while (wire_.text().starts_with("\r\n")) {  // RFC 9112, 2.2
        wire_.use(2);
        searched_ = 0;
    }
    auto const size = find_head(wire_.text(), searched_);
    if (size == 0 && wire_.received().size() <= settings.max_header) return Then::receive;
    if (size == 0 || size > settings.max_header) return refuse(overlong_head(wire_.text(), settings));
    searched_ = 0;
    if (auto const fault = read_head(wire_.text().substr(0, size), settings, head_)) return refuse(*fault);
    wire_.use(size);
    constexpr auto enough = longest_identifier + 1;  // an id that is longer is unknown, also when it is cut
    session_.text.assign(head_.field("RoIS-Session").value_or("").substr(0, enough));
    return Then::next;
}

// Answers a request that its head alone makes invalid. Otherwise sets `has_head_`.
Connection::Then Connection::judge_head() {
    auto const& settings = loop_.shared().settings();
    route_ = route_of(head_.path);
    auto refused = refusal_of_other_sites(head_, settings);
    bool const is_identified = !refused;
    if (!refused) refused = identify();
    if (!refused) refused = refusal(head_, route_, settings);
    if (!refused && from_ == Loop::From::programs && route_.endpoint != Endpoint::engines)
        refused = answer_of({FaultCode::not_allowed, "programs can only join here: expected GET /rois/engines"});
    if (!refused && route_.endpoint == Endpoint::clear && !client_->sees_everything()) refused = answer_of(only_for_all());
    auto const least = least_role_for(route_.endpoint, head_);
    if (!refused && client_->principal && client_->principal->role < least)
        refused = answer_of(not_allowed_for(client_->principal->role, least));
    has_head_ = !refused;
    if (!refused) return Then::next;
    auto const code = refused->fault ? refused->fault->code : FaultCode::invalid;
    bool const concerns_rights = code == FaultCode::unauthorized || code == FaultCode::not_allowed || code == FaultCode::too_many;
    Client const unknown{.address = client_->address};
    if (concerns_rights) loop_.shared().gateway.note_refusal(is_identified ? *client_ : unknown, name_of(route_.endpoint), code);
    if (head_.content_length > wire_.received().size()) return reply(*refused, Framed::last);
    wire_.use(head_.content_length);
    return reply(*refused);
}

// Finds out who sends the request. Returns an answer if a token is needed, and missing or wrong.
std::optional<HttpAnswer> Connection::identify() {
    bool const is_program = from_ == Loop::From::programs;
    bool const needs_none = is_for_everyone(route_.endpoint) && !is_program;
    auto* const tokens = is_program ? loop_.shared().settings().program_tokens : loop_.shared().gateway.tokens();
    if (tokens == nullptr || from_ == Loop::From::this_process) return {};
    auto const refused = token_check_.check(*tokens, head_.token(), *client_);
    if (!refused && !place_.show(client_->name()) && route_.endpoint != Endpoint::stop) {
        token_check_.forget(*client_);
        if (needs_none) return {};
        loop_.shared().telemetry.reached(Telemetry::Limit::connections_per_address);
        return answer_of(place_.of().too_many_of("this token"));
    }
    if (!refused || needs_none) return {};
    if (refused != Tokens::Refused::too_many) return answer_of(unauthorized());
    auto answer = answer_of({FaultCode::too_many, "too many wrong tokens from this address: try again in a minute"});
    answer.fields.set(http::field::retry_after, "60");
    return answer;
}

// Sends the waiting answers, then waits for input. Returns `next` if there is some.
Task<Connection::Then> Connection::receive() {
    auto const& settings = loop_.shared().settings();
    if (!flush_at_once()) co_await flush();
    idle_ = !has_head_ && wire_.received().empty();
    if (idle_ && loop_.draining() && waiting_.empty()) co_return Then::end;
    if (idle_) request_due_ = Steady::max();
    if (idle_) head_ = {};
    if (!idle_ && request_due_ == Steady::max()) request_due_ = std::chrono::steady_clock::now() + settings.request_timeout;
    auto const expected = has_head_ ? head_.content_length - wire_.received().size() : 0;
    if (idle_ && idle_due_ == Steady::max()) idle_due_ = std::chrono::steady_clock::now() + settings.idle_timeout;
    auto const until = idle_ ? idle_due_ : request_due_;
    auto const before = wire_.received().size();
    auto const outcome = co_await wire_.receive(until, expected);
    if (has_head_) loop_.shared().gateway.memory().took(wire_.received().size() - before);
    bool const silent = std::exchange(idle_, false);
    if (outcome == Wire::Outcome::closed) co_return Then::end;
    if (outcome == Wire::Outcome::late && silent) co_return waiting_.empty() ? Then::end : Then::linger;
    if (outcome == Wire::Outcome::late)
        co_return refuse({FaultCode::too_slow, "the request did not arrive within " + in_seconds(settings.request_timeout)});
    co_return Then::next;
}

// An answer that comes later, or after one that comes later, waits for its turn.
Connection::Then Connection::take(PendingAnswer&& answer) {
    if (waiting_.empty() && answer.has_come()) return reply(http_answer(answer.take()));
    bool const close = !head_.keep_alive() || loop_.draining();
    answer.delay();
    waiting_.push_back({std::move(answer), {Framing::Body::sent, close}});
    return close ? Then::linger : Then::next;
}

bool Connection::take_answers() {
    for (; !waiting_.empty(); waiting_.pop_front()) {
        auto& [answer, framing] = waiting_.front();
        auto* pending = std::get_if<PendingAnswer>(&answer);
        if (pending != nullptr && !pending->has_come()) return false;
        append(out_, pending != nullptr ? http_answer(pending->take()) : std::get<HttpAnswer>(answer), framing);
    }
    return true;
}

// Lets a receive that waits go on, if the socket does not take all at once.
void Connection::answers_came() {
    if (wire_.waits_for_reader()) return;  // `flush` goes on with them
    take_answers();
    if (!flush_at_once()) wire_.interrupt();
    if (answers_wake_up_) answers_wake_up_->raise();
}

Task<> Connection::await_answers() {
    while (!take_answers()) {
        answers_wake_up_ = std::make_shared<WakeUp>(loop_.executor(), loop_.wakes());
        co_await answers_wake_up_->wait_until(Steady::max());
        answers_wake_up_.reset();
    }
}

HttpAnswer Connection::http_answer(Answer&& answer) {
    HttpAnswer http{.body = std::move(answer.document)};
    if (answer.fault) {
        set_status(http, answer.fault->code);
        log(*answer.fault, "POST /rois");
    }
    if (answer.turn == Answer::Turn::connected) http.fields.set("RoIS-Session", answer.session.text);
    if (answer.session_number != 0) {
        http.fields.set("RoIS-Session-Number", std::to_string(answer.session_number));
        log_joined(answer.session_number, "opened over HTTP", wire_.peer());
    }
    holds_.push_back(std::move(answer.hold));
    return http;
}

// Serves a request that is not an operation.
Task<Connection::Then> Connection::serve_other() {
    auto& shared = loop_.shared();
    wire_.use(head_.content_length);
    bool const joins = route_.endpoint == Endpoint::engines && head_.message.count("Upgrade") > 0;
    if (route_.endpoint == Endpoint::rois || joins) {
        co_await await_answers();
        co_return serve_upgrade();
    }
    // Decision 34. Stops first: the log and the answer need memory.
    bool const stops = route_.endpoint == Endpoint::stop;
    if (stops || route_.endpoint == Endpoint::clear) {
        auto state = stops ? shared.gateway.stop_everything(client_.get()) : shared.gateway.clear(client_.get());
        state.not_halted = seen_by(client_->principal.get(), std::move(state.not_halted));
        spdlog::warn("{}, as asked by {}", stops ? "everything is stopped" : "commands may start again", wire_.peer());
        co_return reply(HttpAnswer{.body = xml::encode(state)});
    }
    if (route_.endpoint == Endpoint::notifications) co_return co_await serve_notifications();
    co_return reply(shared.documents.answer(route_, head_, client_->principal.get()));
}

Connection::Then Connection::serve_upgrade() {
    auto const& shared = loop_.shared();
    if (shared.gateway.shutting_down()) return reply(answer_of(shutting_down()));
    bool const joins = route_.endpoint == Endpoint::engines;
    bool const is_trusted = client_->principal != nullptr || is_loopback(place_.address());
    if (joins && !(shared.settings().join && is_trusted)) {
        shared.gateway.note_refusal(*client_, name_of(route_.endpoint), FaultCode::not_allowed);
        auto const* const needs = "joining needs the key engines, and a token or a connection from this machine";
        return reply(answer_of({FaultCode::not_allowed, needs}));
    }
    auto const answer = upgrade(head_);
    if (answer.status != http::status::switching_protocols) return reply(answer);
    if (joins) return Then::engine;  // client::accepted_link sends the answer to the handshake
    append(out_, answer, {});
    return Then::websocket;
}

// Frees the memory of the request first: there may be many thousand idle WebSockets.
Task<> Connection::serve_websocket() {
    co_await flush();
    head_ = {};
    std::string{}.swap(out_);
    counted_.emplace(loop_.shared().telemetry, Telemetry::Kind::websocket);
    auto const websocket = std::make_shared<WebSocket>(std::shared_ptr<Wire>{shared_from_this(), &wire_}, loop_, client_);
    websocket_ = websocket;
    if (loop_.draining()) websocket->shut_down();
    co_await websocket->run();
}

Task<Connection::Then> Connection::serve_notifications() {
    auto const& shared = loop_.shared();
    auto const read = read_wanted(head_, shared.settings().max_poll_wait);
    if (auto const* fault = std::get_if<Fault>(&read)) co_return reply(answer_of(*fault));
    if (shared.gateway.shutting_down()) co_return reply(answer_of(shutting_down()));
    auto wanted = std::get<NotificationsWanted>(read);
    co_await await_answers();
    co_await flush();
    if (wanted.as == NotificationsWanted::As::stream && head_.verb() == http::verb::get) {
        counted_.emplace(shared.telemetry, Telemetry::Kind::stream);
        auto const refused = co_await stream(wire_, loop_, session_, client_->rights(), wanted);
        if (!refused) co_return Then::linger;
        counted_.emplace(shared.telemetry, Telemetry::Kind::http);
        co_return reply(*refused);
    }
    auto const answer = co_await poll(wire_, loop_, session_, client_->rights(), wanted);
    co_return reply(answer);
}

Connection::Then Connection::reply(HttpAnswer answer, Framed framed) {
    if (answer.fault) {
        loop_.shared().telemetry.faulted(answer.fault->code);
        log(*answer.fault, request_line());
    }
    bool const close = framed == Framed::last || !head_.keep_alive() || loop_.draining();
    auto const body = head_.verb() == http::verb::head ? Framing::Body::omitted : Framing::Body::sent;
    if (waiting_.empty())
        append(out_, answer, {body, close});
    else
        waiting_.push_back({std::move(answer), {body, close}});
    return close ? Then::linger : Then::next;
}

// Answers a request whose end is unknown, and ends the connection. If no head was accepted, its bytes are still in the input, and
// `head_` is not valid.
Connection::Then Connection::refuse(Fault const& fault) {
    loop_.shared().telemetry.faulted(fault.code);
    log(fault, has_head_ ? request_line() : wire_.text().substr(0, wire_.text().find_first_of("\r\n")));
    bool const asks_for_head = has_head_ ? head_.verb() == http::verb::head : wire_.text().starts_with("HEAD ");
    waiting_.push_back({answer_of(fault), {asks_for_head ? Framing::Body::omitted : Framing::Body::sent, true}});
    take_answers();
    return Then::linger;
}

void Connection::log(Fault const& fault, std::string_view request) {
    if (is_logged(fault.code)) log_fault(fault, request, wire_.peer());
}

// Returns the method and the path of the current request, without its query.
std::string Connection::request_line() const { return std::string{head_.method()}.append(" ").append(head_.path); }

bool Connection::flush_at_once() {
    out_.erase(0, wire_.send_now(out_));
    if (out_.empty()) forget_out();
    return out_.empty();
}

// Waits until the peer has taken all answers. Cuts the connection instead while memory_budget is used up.
Task<> Connection::flush() {
    auto outcome = Wire::Outcome::done;
    while (outcome == Wire::Outcome::done && !flush_at_once()) {
        auto& memory = loop_.shared().gateway.memory();
        memory.took(out_.size());
        if (memory.full() && !wire_.is_secure()) cut_for_memory();
        outcome = co_await wire_.send(out_);
        out_.clear();
        forget_out();
        take_answers();
    }
}

void Connection::forget_out() {
    if (out_.capacity() > most_to_keep) std::string{}.swap(out_);
    holds_.clear();
}

void Connection::cut_for_memory() {
    spdlog::warn("the connection of {} was cut: {}", wire_.peer(),
                 loop_.shared().gateway.memory().refuse("no memory for a waiting connection"));
    loop_.shared().telemetry.cut();
    wire_.cut();
}

}  // namespace rois::net
