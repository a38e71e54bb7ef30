#include "broken/proxy.hpp"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <mutex>

#include "broken/frame.hpp"

namespace rois::broken {

namespace {

constexpr std::string_view length_field = "Content-Length: ";

std::optional<Message> read_message(kit::Socket& from) {
    auto const head = from.take_until("\r\n\r\n");
    if (!head) return {};
    Message message;
    std::vector<std::string> lengths;
    for (std::size_t begin = 0; begin + 2 < head->size();) {
        auto const end = head->find("\r\n", begin) + 2;
        auto const line = head->substr(begin, end - begin);
        begin = end;
        if (message.first_line.empty()) {
            message.first_line = line;
            continue;
        }
        if (line.starts_with(length_field)) lengths.push_back(line.substr(length_field.size()));
        message.headers.push_back(line);
    }
    bool const is_not_modified = message.first_line.find(" 304 ") != std::string::npos;
    message.has_length = lengths.size() == 1 && lengths.front().find_first_not_of("0123456789\r\n") == std::string::npos;
    if (!message.has_length || is_not_modified) return message;
    if (auto body = from.take(std::strtoul(lengths.front().c_str(), nullptr, 10))) message.body = std::move(*body);
    return message;
}

void write_message(kit::Socket& to, Message const& message) {
    auto text = message.first_line;
    for (auto const& line : message.headers)
        text += message.has_length && line.starts_with(length_field)
                    ? std::string{length_field} + std::to_string(message.body.size()) + "\r\n"
                    : line;
    to.send(text + "\r\n" + message.body);
}

bool is_status(Message const& reply, std::string const& status) {
    return reply.first_line.find(" " + status + " ") != std::string::npos;
}

bool has_header(Message const& message, std::string_view text) {
    return std::ranges::any_of(message.headers, [&](auto const& line) { return line.find(text) != line.npos; });
}

// Both directions of a WebSocket, each in its own thread.
class Conversation final : public ProxiedConnection {
public:
    Conversation(kit::Socket& application, kit::Socket& gateway, Breaking& breaking)
        : application_{application}, gateway_{gateway}, breaking_{breaking} {}

    void run() {
        std::thread requests{[this] { forward_requests(); }};
        forward_answers();
        application_.end();
        requests.join();
    }

    void send_hidden(std::string const& request) override { ask({request, true}); }

private:
    struct Request {
        std::string document;
        bool is_hidden;
    };

    void ask(Request request) {
        auto const text = whole_frame(kit::Kind::text, request.document, kit::Masked::yes);
        std::lock_guard const lock{asked_mutex_};
        asked_.push_back(std::move(request));
        gateway_.send(text);
    }

    void send_to_application(std::string const& document) {
        application_.send(whole_frame(kit::Kind::text, document, kit::Masked::no));
    }

    // Sends documents that the proxy has added or changed. Notifications among them get the next sequence number.
    void send_more(Documents const& documents) {
        for (auto const& document : documents) {
            if (sequence_of(document) == 0) {
                send_to_application(document);
            } else {
                ++shift_;
                send_to_application(with_sequence(document, ++last_sequence_));
            }
        }
    }

    void forward_requests() {
        while (auto const frame = read_frame(application_)) {
            if (!frame->is_text() || !frame->is_masked()) {  // forwards invalid frames: the gateway must refuse them
                gateway_.send(frame->bytes);
                continue;
            }
            std::lock_guard const lock{breaking_mutex_};
            auto const instead = breaking_.instead ? breaking_.instead(frame->payload) : Documents{};
            send_more(instead);
            if (!instead.empty()) continue;
            ask({breaking_.request ? breaking_.request(frame->payload) : frame->payload, false});
        }
        gateway_.end();
    }

    void forward_answers() {
        while (auto const frame = read_frame(gateway_)) {
            std::lock_guard const lock{breaking_mutex_};
            if (!frame->is_text()) {
                application_.send(frame->bytes);
            } else if (sequence_of(frame->payload) > 0) {
                notify(frame->payload);
            } else {
                answer(frame->payload);
            }
        }
    }

    void notify(std::string const& notification) {
        auto documents = breaking_.notification ? breaking_.notification(notification) : Documents{notification};
        auto sequence = sequence_of(notification) + shift_;
        if (documents.size() != 1 || shift_ != 0) {
            for (auto& document : documents)
                if (sequence_of(document) > 0) document = with_sequence(document, sequence++);
            shift_ = sequence - sequence_of(notification) - 1;
        }
        last_sequence_ = sequence_of(notification) + shift_;
        for (auto const& document : documents) send_to_application(document);
    }

    void answer(std::string const& document) {
        Request request{"", false};
        {
            std::lock_guard const lock{asked_mutex_};
            if (!asked_.empty()) {
                request = std::move(asked_.front());
                asked_.pop_front();
            }
        }
        if (request.is_hidden) return;
        if (document.starts_with("<connect_response")) shift_ = last_sequence_ = 0;
        send_more(breaking_.answer ? breaking_.answer(request.document, document, *this) : Documents{document});
    }

    kit::Socket& application_;
    kit::Socket& gateway_;
    std::mutex breaking_mutex_;
    Breaking& breaking_;
    long shift_ = 0;          // offset of the sequence after added and dropped notifications
    long last_sequence_ = 0;  // sent to the application
    std::mutex asked_mutex_;
    std::deque<Request> asked_;
};

// Serves HTTP until the connection becomes a WebSocket or an event stream.
class Connection final : public ProxiedConnection {
public:
    Connection(int application, std::uint16_t gateway, Breaking breaking)
        : application_{application}, port_{gateway}, gateway_{kit::connect_to(gateway)}, breaking_{std::move(breaking)} {}

    void run() {
        while (auto request = read_message(application_)) {
            if (!request->body.empty() && breaking_.instead) {
                auto const instead = breaking_.instead(request->body);
                if (!instead.empty()) {
                    write_message(application_, {"HTTP/1.1 200 OK\r\n",
                                                 {"Content-Type: application/xml\r\n", std::string{length_field} + "\r\n"},
                                                 instead.front()});
                    continue;
                }
            }
            auto const asked = request->body;
            session_ = header(*request, "RoIS-Session: ");
            if (!asked.empty() && breaking_.request) request->body = breaking_.request(asked);
            if (breaking_.http_request) breaking_.http_request(*request);
            write_message(gateway_, *request);
            if (!pass_on(*request, asked)) return;
        }
    }

    void send_hidden(std::string const& request) override {
        kit::Socket aside{kit::connect_to(port_)};
        write_message(aside, {"POST /rois HTTP/1.1\r\n",
                              {"Host: localhost\r\n", "Content-Type: text/xml\r\n", session_, std::string{length_field} + "\r\n"},
                              request});
        read_message(aside);
    }

private:
    static std::string header(Message const& message, std::string_view name) {
        auto const found = std::ranges::find_if(message.headers, [&](auto const& line) { return line.starts_with(name); });
        return found == message.headers.end() ? "" : *found;
    }

    // Returns whether the connection is still HTTP.
    bool pass_on(Message const& request, std::string const& asked) {
        auto reply = read_message(gateway_);
        if (!reply) return false;
        if (is_status(*reply, "101")) {
            write_message(application_, *reply);
            Conversation{application_, gateway_, breaking_}.run();
            return false;
        }
        if (!asked.empty() && breaking_.answer) {
            auto const documents = breaking_.answer(asked, reply->body, *this);
            if (!documents.empty() && documents.front() != reply->body) {
                reply->body = documents.front();
                bool const is_fault =
                    reply->body.find("<fault") != std::string::npos || reply->body.find(":fault ") != std::string::npos;
                if (!is_fault) reply->first_line = "HTTP/1.1 200 OK\r\n";
            }
        }
        if (breaking_.http_reply) breaking_.http_reply(request, *reply);
        write_message(application_, *reply);
        if (!has_header(*reply, "text/event-stream"))
            return !has_header(*reply, "Connection: close") && !has_header(request, "Connection: close");
        std::thread leaving{[this] {
            while (application_.take_some()) {
            }
            gateway_.end();
        }};
        while (auto const some = gateway_.take_some()) application_.send(*some);
        application_.end();
        leaving.join();
        return false;
    }

    kit::Socket application_;
    std::uint16_t port_;
    kit::Socket gateway_;
    Breaking breaking_;
    std::string session_;  // the header line RoIS-Session
};

}  // namespace

Proxy::Proxy(std::uint16_t gateway, std::function<Breaking()> breaking)
    : gateway_{gateway}, breaking_{std::move(breaking)}, accepting_{[this] { accept(); }} {}

Proxy::~Proxy() {
    ending_ = true;
    listener_.end();
    accepting_.join();
    for (auto& connection : connections_) connection.join();
}

void Proxy::accept() {
    while (auto const application = listener_.accept())
        connections_.emplace_back([this, application = *application] {
            try {
                Connection{application, gateway_, breaking_()}.run();
            } catch (std::runtime_error const&) {
                // The gateway has closed the connection.
            }
        });
}

}  // namespace rois::broken
