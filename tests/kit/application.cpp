#include "kit/application.hpp"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "kit/websocket_client.hpp"

namespace rois::kit {

namespace {

class HttpConnection final : public Connection {
public:
    explicit HttpConnection(Address const& address) : client_{address}, patience_{address.patience} {}

    std::string ask(std::string const& request, std::vector<std::string>&) override { return client_.post(request).body; }

    void wait(std::vector<std::string>& notifications) override { take(poll(), notifications); }

    void fetch(std::vector<std::string>& notifications) override { take(client_.notifications(last_, 0), notifications); }

    void set_session(std::string const& session) override {
        if (client_.session != session) last_ = 0;
        client_.session = session;
    }

private:
    void take(HttpReply const& reply, std::vector<std::string>& notifications) {
        pugi::xml_document as_written;
        as_written.load_buffer(reply.body.data(), reply.body.size());
        for (auto const notification : as_written.document_element().children()) {
            last_ = notification.attribute("sequence").as_uint();
            notifications.push_back(document_of(notification));
        }
    }

    // Repeats the long poll until it returns a notification, or the timeout has passed.
    HttpReply poll() {
        using Clock = std::chrono::steady_clock;
        constexpr std::chrono::seconds longest{30};  // long poll (docs/clients.md)
        constexpr std::chrono::milliseconds tolerance{500};
        auto const patience = std::max(std::chrono::ceil<std::chrono::seconds>(patience_), std::chrono::seconds{1});
        auto const end = Clock::now() + patience;
        std::string empty;
        for (auto left = patience; left.count() > 0; left = std::chrono::round<std::chrono::seconds>(end - Clock::now())) {
            auto const wait = std::min(left, longest);
            auto const deadline = Clock::now() + wait - tolerance;
            auto reply = client_.notifications(last_, static_cast<unsigned>(wait.count()));
            if (reply.root().first_child()) return reply;
            empty = reply.body;
            if (Clock::now() < deadline) throw LineEnded{"a long poll returned early without a notification: " + empty};
        }
        throw LineEnded{"received no notification within " + std::to_string(patience.count()) + " s; last answer: " + empty};
    }

    // Adds the namespaces that the enclosing list declares.
    static std::string document_of(pugi::xml_node notification) {
        for (auto const declared : notification.parent().attributes()) {
            if (!notification.attribute(declared.name())) notification.append_copy(declared);
        }
        std::ostringstream text;
        notification.print(text, "", pugi::format_raw);
        return text.str();
    }

    HttpClient client_;
    std::chrono::milliseconds patience_;
    unsigned last_ = 0;
};

class WebSocketConnection final : public Connection {
public:
    explicit WebSocketConnection(Address const& address) : client_{address} {}

    std::string ask(std::string const& request, std::vector<std::string>& notifications) override {
        client_.send(request);
        while (true) {
            auto text = next_text();
            if (!is_notification(text)) return text;
            notifications.push_back(std::move(text));
        }
    }

    void wait(std::vector<std::string>& notifications) override { notifications.push_back(next_text()); }

    void fetch(std::vector<std::string>&) override {}  // notifications arrive with the answers

    void set_session(std::string const&) override {}  // a WebSocket has one session

private:
    static bool is_notification(std::string const& text) { return !Document{text}.attribute("sequence").empty(); }

    std::string next_text() {
        auto frame = client_.next();
        while (frame.kind == Kind::ping) {
            client_.send(frame.payload, Kind::pong);
            frame = client_.next();
        }
        if (frame.kind != Kind::text)
            throw LineEnded{"expected a text frame; the WebSocket closed with code " + std::to_string(frame.close_code())};
        return frame.payload;
    }

    WebSocketClient client_;
};

}  // namespace

std::unique_ptr<Connection> connection_over(Address const& address, Transport transport) {
    if (transport == Transport::http) return std::make_unique<HttpConnection>(address);
    return std::make_unique<WebSocketConnection>(address);
}

std::ostream& operator<<(std::ostream& out, Transport transport) {
    return out << (transport == Transport::http ? "Http" : "WebSocket");
}

void Application::disconnect_if_connected() {
    if (connected_) disconnect();
}

Document Application::ask(std::string const& operation, Xml const& children, Attributes const& attributes) {
    auto const request_id = "request-" + std::to_string(++requests_);
    auto with_id = attributes;
    with_id.emplace_back("request_id", request_id);
    std::vector<std::string> notifications;
    Document const answer{connection_->ask(request(operation, children, with_id), notifications)};
    take(notifications);
    check_answer(answer, operation, request_id);
    return answer;
}

Document Application::connect() {
    auto answer = ask("connect");
    if (answer.return_code() != "OK") return answer;
    if (!connected_) last_sequence_ = 0;
    connected_ = true;
    session_ = answer.text("session");
    connection_->set_session(session_);
    return answer;
}

Document Application::disconnect() {
    auto answer = ask("disconnect");
    connected_ = false;
    return answer;
}

Document Application::bind(std::string const& ref) { return ask("bind", component_ref(ref)); }

Document Application::release(std::string const& ref) { return ask("release", component_ref(ref)); }

Document Application::get_parameter(std::string const& ref) { return ask("get_parameter", component_ref(ref)); }

Document Application::set_parameter(std::string const& ref, std::vector<Argument> const& arguments) {
    return ask("set_parameter", component_ref(ref) + parameters(arguments));
}

Document Application::execute(Xml const& units) { return ask("execute", sequence(units)); }

Document Application::get_command_result(std::string const& id, Xml const& condition) {
    return ask("get_command_result", text_element("command_id", id) + condition);
}

Document Application::query(std::string const& type, Xml const& condition) {
    return ask("query", text_element("query_type", type) + condition);
}

Document Application::subscribe(std::string const& event, Xml const& condition, bool inline_results) {
    return ask("subscribe", text_element("event_type", event) + condition,
               inline_results ? Attributes{{"inline_results", "true"}} : Attributes{});
}

Document Application::unsubscribe(std::string const& id) { return ask("unsubscribe", text_element("subscribe_id", id)); }

Document Application::get_event_detail(std::string const& id, Xml const& condition) {
    return ask("get_event_detail", text_element("event_id", id) + condition);
}

std::vector<std::string> Application::search(Xml const& condition) {
    auto const answer = ask("search", condition);
    if (answer.return_code() != "OK") return {""};
    std::vector<std::string> refs;
    for (auto const ref : answer.root().child("component_ref_list").children("component_ref"))
        refs.emplace_back(ref.attribute("rois:code").value());
    return refs;
}

Document Application::receive() {
    if (waiting_.empty()) {
        std::vector<std::string> notifications;
        connection_->wait(notifications);
        take(notifications);
    }
    history_.push_back(waiting_.front());
    waiting_.erase(waiting_.begin());
    return history_.back();
}

std::optional<Document> Application::receive_now() {
    if (waiting_.empty()) {
        std::vector<std::string> notifications;
        connection_->fetch(notifications);
        take(notifications);
    }
    if (waiting_.empty()) return {};
    return receive();
}

Document Application::next_event(std::string const& type) {
    while (true) {
        auto received = receive();
        if (received.text("event_type") == type) return received;
    }
}

std::string Application::status_of(std::string const& command_id) {
    while (true) {
        auto const received = receive();
        if (received.name() == "completed" && received.text("command_id") == command_id) return received.text("status");
    }
}

void Application::take(std::vector<std::string> const& notifications) {
    for (auto const& text : notifications) {
        Document notification{text};
        check_notification(notification, ++last_sequence_);
        waiting_.push_back(std::move(notification));
    }
}

std::vector<std::string> lines(std::vector<Document> const& notifications) {
    std::vector<std::string> lines;
    for (auto const& one : notifications) {
        if (one.name() == "completed") {
            lines.push_back("completed " + one.text("command_id") + " " + one.text("status"));
        } else {
            lines.push_back(one.name() == "receive_event" ? one.text("event_type") : one.name());
        }
    }
    return lines;
}

}  // namespace rois::kit
