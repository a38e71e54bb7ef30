// Notifications over HTTP: long poll and event stream (docs/clients.md; decisions 22 and 23).
#include "conformance/context.hpp"
#include "kit/http_client.hpp"

namespace rois::conformance {

namespace {

using kit::HttpClient;
using kit::HttpReply;

// A session with three waiting notifications.
class ThreeNotifications {
public:
    explicit ThreeNotifications(Context& context) : client{context.address()} {
        auto const number = number_parameter_of(context);
        auto const& component = *number.component;
        client.call("connect");
        auto const bound = client.call("bind", kit::component_ref(component.ref)).return_code();
        if (bound == "OUT_OF_RESOURCES") throw Skipped{"another application uses " + component.ref};
        auto const set = kit::component_ref(component.ref) + kit::parameters({with_value(number, 50)});
        for (int i = 0; i < 3; ++i) ids.push_back(client.call("set_parameter", set).text("command_id"));
        for (int i = 0; i < 3; ++i) client.notifications(i, 5);  // returns after the last command has completed
    }

    HttpClient client;
    std::vector<std::string> ids;  // of the commands, in order
};

std::vector<std::string> commands_in(HttpReply const& reply) {
    std::vector<std::string> ids;
    for (auto const notification : reply.root()) ids.emplace_back(notification.child("command_id").text().get());
    return ids;
}

void a_long_poll_returns_the_waiting_notifications(Context& context) {
    ThreeNotifications waiting{context};
    auto const reply = waiting.client.notifications(0, 5);
    context.traffic().validate(reply.body);
    require_equal("the document", "notifications", reply.root().name());
    require(commands_in(reply) == waiting.ids, "expected `completed` of three commands in order, got " + reply.body);
    unsigned expected = 0;
    for (auto const notification : reply.root()) {
        ++expected;
        require(notification.attribute("sequence").as_uint() == expected,
                "expected sequence " + std::to_string(expected) + ", got " + reply.body);
    }
}

void a_long_poll_discards_no_notification(Context& context) {
    ThreeNotifications waiting{context};
    auto const first = waiting.client.notifications(0, 5);
    require_equal("the same notifications again", first.body, waiting.client.notifications(0, 5).body);
    auto const rest = commands_in(waiting.client.notifications(2, 5));
    require(rest == std::vector{waiting.ids[2]}, "after=2: expected only the third notification, got " + list(rest));
    auto const none = waiting.client.notifications(3, 0);
    require(none.status == 200 && !none.root().first_child(),
            "after=3: expected an empty list with status 200, got " + none.body);
}

void a_long_poll_refuses_invalid_numbers(Context& context) {
    ThreeNotifications waiting{context};
    for (auto const* const query : {"after=x", "after=-1", "wait=soon", "wait=31"}) {
        auto const reply = waiting.client.get(std::string{"/rois/notifications?"} + query);
        require(reply.status == 400, std::string{query} + ": expected status 400, got " + std::to_string(reply.status));
    }
}

void notifications_need_a_session(Context& context) {
    HttpClient client{context.address()};
    auto const reply = client.get("/rois/notifications");
    require(reply.status == 403, "expected status 403, got " + std::to_string(reply.status));
    require_equal("the fault", "no_session", reply.fault());
}

// Reads the `id` and the document of one event of the stream.
std::pair<std::string, std::string> next_event(HttpClient& stream) {
    std::string id, data;
    while (true) {
        auto text = stream.next_line();
        while (text.ends_with('\n') || text.ends_with('\r')) text.pop_back();
        if (text.empty() && !data.empty()) break;
        auto const colon = text.find(':');
        if (colon == text.npos) continue;
        auto const value = text.substr(text.find_first_not_of(' ', colon + 1) == colon + 2 ? colon + 2 : colon + 1);
        if (text.starts_with("id:")) id = value;
        if (text.starts_with("data:")) data += value + "\n";
    }
    return {id, data};
}

void an_event_stream_sends_the_same_notifications(Context& context) {
    ThreeNotifications waiting{context};
    HttpClient stream{context.address()}, again{context.address()};
    for (auto* const client : {&stream, &again}) {
        bool const is_first = client == &stream;
        client->session = waiting.client.session;
        kit::Headers headers{{"Accept", "text/event-stream"}};
        if (!is_first) headers["Last-Event-ID"] = "2";
        auto const reply = client->get("/rois/notifications", headers);
        require_equal("the content type", "text/event-stream", reply.header("Content-Type").substr(0, 17));
        for (std::size_t number = is_first ? 1 : 3; number <= 3; ++number) {
            auto const [id, data] = next_event(*client);
            context.traffic().validate(data);
            require_equal("the id", std::to_string(number), id);
            Document const notification{data};
            require_equal("the sequence", id, notification.attribute("sequence"));
            require_equal("the command", waiting.ids[number - 1], notification.text("command_id"));
        }
        client->session.clear();
    }
}

}  // namespace

Clause notification_clause() {
    return {"7.4.2.2 Service application base: notifications over HTTP",
            {{"a_long_poll_returns_the_waiting_notifications", "table 6; decision 22; docs/clients.md",
              a_long_poll_returns_the_waiting_notifications, Transport::http},
             {"a_long_poll_discards_no_notification", "decision 23", a_long_poll_discards_no_notification, Transport::http},
             {"a_long_poll_refuses_invalid_numbers", "docs/clients.md", a_long_poll_refuses_invalid_numbers, Transport::http},
             {"notifications_need_a_session", "figure 6; decision 1", notifications_need_a_session, Transport::http},
             {"an_event_stream_sends_the_same_notifications", "docs/clients.md", an_event_stream_sends_the_same_notifications,
              Transport::http}}};
}

}  // namespace rois::conformance
