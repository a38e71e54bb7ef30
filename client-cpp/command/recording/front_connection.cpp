#include "command/recording/front_connection.hpp"

#include <boost/asio/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <optional>

#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"

namespace rois::command {

namespace {

constexpr auto longest_idle = std::chrono::seconds{60};
constexpr auto sign_of_life = std::chrono::seconds{20};
constexpr int longest_wait = 30;  // seconds

std::string header(HttpMessage const& message, std::string_view name) {
    auto const value = message[beast::string_view{name.data(), name.size()}];
    return {value.data(), value.size()};
}

// Returns a parameter of the target: 0 if it is missing, nothing if it is not a whole number.
std::optional<std::uint64_t> parameter(std::string_view target, std::string_view name) {
    auto rest = target.substr(std::min(target.size(), target.find('?')));
    while (!rest.empty()) {
        rest.remove_prefix(1);
        auto const one = rest.substr(0, rest.find('&'));
        if (one.starts_with(name) && one.substr(name.size(), 1) == "=")
            return to_number<std::uint64_t>(one.substr(name.size() + 1));
        rest.remove_prefix(one.size());
    }
    return 0;
}

std::string event_of(HostedSession::Numbered const& numbered) {
    std::string text = "id: " + std::to_string(numbered.sequence) + "\n";
    std::string_view rest = numbered.document;
    while (true) {
        auto const end = rest.find('\n');
        text.append("data: ").append(rest.substr(0, end)).append("\n");
        if (end == rest.npos) return text.append("\n");
        rest.remove_prefix(end + 1);
    }
}

// Counts a connection that receives the notifications of a session, while this object lives.
class ConnectionCount {
public:
    explicit ConnectionCount(HostedSession& session) : session_{session} { ++session_.connections; }
    ~ConnectionCount() {
        --session_.connections;
        session_.used = std::chrono::steady_clock::now();
    }
    ConnectionCount(ConnectionCount const&) = delete;
    ConnectionCount& operator=(ConnectionCount const&) = delete;

private:
    HostedSession& session_;
};

}  // namespace

http::status status_of(std::string const& answer) {
    auto const read = xml::AnswerReader{}.read(answer);
    auto const* const fault = read ? std::get_if<Fault>(&*read) : nullptr;
    return fault == nullptr ? http::status::ok : static_cast<http::status>(http_status_of(fault->code));
}

Fault no_such_session(std::string request_id) {
    return {FaultCode::no_session, "there is no such session: connect first", {}, std::move(request_id)};
}

asio::awaitable<void> Front::Connection::run() {
    auto const self = shared_from_this();
    auto then = Then::next;
    while (then == Then::next) {
        http::request_parser<http::string_body> parser;
        parser.body_limit(16u << 20);
        stream_.expires_after(longest_idle);
        Failure failure;
        co_await http::async_read(stream_, buffer_, parser, into(failure));
        if (failure) co_return;
        stream_.expires_never();
        auto message = parser.release();
        if (beast::websocket::is_upgrade(message)) {
            co_await upgrade(std::move(message));
            co_return;
        }
        then = co_await answer(message);
    }
    Failure ignored;
    stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
}

asio::awaitable<Front::Connection::Then> Front::Connection::answer(HttpMessage& message) {
    auto const target = std::string_view{message.target().data(), message.target().size()};
    auto const path = target.substr(0, target.find('?'));
    bool const gets = message.method() == http::verb::get;
    if (path == "/rois" && message.method() == http::verb::post) co_return co_await answer_document(message);
    if (path == "/rois" && gets)
        co_return co_await refuse(message, FaultCode::upgrade_required, "POST a document here, or open a WebSocket");
    if (path == "/rois/notifications" && gets) co_return co_await answer_notifications(message);
    if ((path == "/healthz" || path == "/readyz") && gets)
        co_return co_await write(message, http::status::ok, "ok\n", "text/plain");
    if (path == "/rois" || path == "/rois/notifications" || path == "/healthz" || path == "/readyz")
        co_return co_await refuse(message, FaultCode::method_not_allowed, std::string{path} + " does not allow this method");
    co_return co_await refuse(message, FaultCode::not_found, "only sessions are served here: /rois, /rois/notifications");
}

asio::awaitable<std::string> Front::Connection::answer_of(std::string document, std::shared_ptr<HostedSession>& session,
                                                          bool on_websocket, std::uint64_t& last_sequence) {
    auto const read = reader_.read(document);
    auto const* const request = std::get_if<Request>(&read);
    if (auto const* const connect = request != nullptr ? std::get_if<Connect>(&request->operation) : nullptr) {
        if (!session || session->ended()) session = host_.open(*connect);
        Connect::Reply reply;
        reply.session = session->id();
        co_return xml::encode(Reply{reply}, request->request_id);
    }
    auto const* const resume = request != nullptr ? std::get_if<Resume>(&request->operation) : nullptr;
    if (resume != nullptr && !on_websocket)
        co_return xml::encode(Fault{FaultCode::not_allowed, "resume works only on a WebSocket", {}, request->request_id});
    if (resume != nullptr) {
        auto const found = host_.find(resume->session.text);
        if (!found) co_return xml::encode(no_such_session(request->request_id));
        session = found;
        last_sequence = resume->last_sequence;
        co_return xml::encode(Reply{Resume::Reply{}}, request->request_id);
    }
    if (!session || session->ended()) {
        auto const* const fault = std::get_if<Fault>(&read);
        co_return xml::encode(fault != nullptr ? *fault : no_such_session(request->request_id));
    }
    session->used = std::chrono::steady_clock::now();
    if (request != nullptr && std::holds_alternative<Disconnect>(request->operation)) {
        host_.end(*session);
        co_return xml::encode(Reply{Disconnect::Reply{}}, request->request_id);
    }
    struct Waiting {
        explicit Waiting(asio::io_context& io) : timer{io, asio::steady_timer::time_point::max()} {}
        std::optional<std::string> answer;
        asio::steady_timer timer;
    };
    auto const waiting = std::make_shared<Waiting>(host_.io());
    session->guest->take(document, read, [waiting](std::string answer) {
        waiting->answer = std::move(answer);
        waiting->timer.cancel();
    });
    if (!waiting->answer) {
        Failure cancelled;
        co_await waiting->timer.async_wait(into(cancelled));
    }
    co_return std::move(*waiting->answer);
}

asio::awaitable<Front::Connection::Then> Front::Connection::answer_document(HttpMessage& message) {
    auto session = host_.find(header(message, "RoIS-Session"));
    std::uint64_t unused = 0;
    auto answer = co_await answer_of(std::move(message.body()), session, false, unused);
    auto const status = status_of(answer);
    auto id = session ? session->id().text : std::string{};
    co_return co_await write(message, status, std::move(answer), "application/xml", std::move(id));
}

asio::awaitable<Front::Connection::Then> Front::Connection::answer_notifications(HttpMessage& message) {
    auto const session = host_.find(header(message, "RoIS-Session"));
    if (!session) co_return co_await write(message, no_such_session());
    auto const target = std::string_view{message.target().data(), message.target().size()};
    if (header(message, "Accept").find("text/event-stream") != std::string::npos) {
        auto const last = header(message, "Last-Event-ID");
        auto const after = last.empty() ? std::optional<std::uint64_t>{0} : to_number<std::uint64_t>(last);
        if (!after) co_return co_await refuse(message, FaultCode::not_well_formed, "Last-Event-ID must be a whole number");
        co_await stream(session, *after);
        co_return Then::over;
    }
    auto const after = parameter(target, "after");
    auto const wait = parameter(target, "wait");
    if (!after || !wait || *wait > longest_wait)
        co_return co_await refuse(message, FaultCode::not_well_formed, "after and wait must be whole numbers, wait 30 at most");
    co_return co_await poll(message, session, *after, static_cast<int>(*wait));
}

asio::awaitable<Front::Connection::Then> Front::Connection::poll(HttpMessage& message, std::shared_ptr<HostedSession> session,
                                                                 std::uint64_t after, int wait) {
    ConnectionCount const count{*session};
    asio::steady_timer timer{host_.io(), std::chrono::seconds{wait}};
    if (session->after(after) == nullptr && wait > 0) co_await session->wait(timer);
    auto body = xml::notifications_begin();
    for (auto const* one = session->after(after); one != nullptr; one = session->after(one->sequence)) body += one->document;
    co_return co_await write(message, http::status::ok, body + xml::notifications_end());
}

asio::awaitable<void> Front::Connection::stream(std::shared_ptr<HostedSession> session, std::uint64_t after) {
    ConnectionCount const count{*session};
    std::string out =
        "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n";
    Failure failure;
    while (!failure) {
        for (auto const* one = session->after(after); one != nullptr; one = session->after(after)) {
            out += event_of(*one);
            after = one->sequence;
        }
        if (out.empty() && session->ended()) co_return;
        co_await asio::async_write(stream_, asio::buffer(out), into(failure));
        out.clear();
        if (failure || session->after(after) != nullptr) continue;
        if (session->ended()) co_return;
        asio::steady_timer timer{host_.io(), sign_of_life};
        co_await session->wait(timer);
        if (session->after(after) == nullptr && !session->ended()) out = ":\n\n";
    }
}

asio::awaitable<Front::Connection::Then> Front::Connection::write(HttpMessage const& message, http::status status,
                                                                  std::string body, std::string_view type, std::string session) {
    http::response<http::string_body> response{status, message.version()};
    response.set(http::field::content_type, beast::string_view{type.data(), type.size()});
    if (!session.empty()) response.set("RoIS-Session", session);
    response.body() = std::move(body);
    response.keep_alive(message.keep_alive());
    response.prepare_payload();
    Failure failure;
    co_await http::async_write(stream_, response, into(failure));
    co_return failure || !message.keep_alive() ? Then::over : Then::next;
}

asio::awaitable<Front::Connection::Then> Front::Connection::refuse(HttpMessage const& message, FaultCode code,
                                                                   std::string reason) {
    Fault const fault{code, std::move(reason)};
    co_return co_await write(message, fault);
}

asio::awaitable<Front::Connection::Then> Front::Connection::write(HttpMessage const& message, Fault const& fault) {
    auto body = xml::encode(fault);
    auto const status = status_of(body);
    co_return co_await write(message, status, std::move(body));
}

}  // namespace rois::command
