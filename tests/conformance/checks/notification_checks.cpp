// Notifications over HTTP: long poll and event stream (docs/clients.md; decisions 22 and 23).
#include "conformance/context.hpp"
#include "kit/http_client.hpp"

namespace rois::conformance {

namespace {

using kit::HttpClient;
using kit::HttpReply;

bool is_completion(pugi::xml_node notification) { return std::string_view{notification.name()} == "completed"; }
unsigned sequence_of(pugi::xml_node notification) { return notification.attribute("sequence").as_uint(); }

// A session with the waiting notifications `completed` of three commands. There may be others, such as profile_changed.
class ThreeCompletions {
public:
    explicit ThreeCompletions(Context& context) : client{context.address()} {
        auto const number = number_parameter_of(context);
        auto const& component = *number.component;
        client.call("connect");
        auto const bound = client.call("bind", kit::component_ref(component.ref)).return_code();
        if (bound == "OUT_OF_RESOURCES") throw Skipped{"another application uses " + component.ref};
        auto const set = kit::component_ref(component.ref) + kit::parameters({with_value(number, 50)});
        for (int i = 0; i < 3; ++i) ids.push_back(client.call("set_parameter", set).text("command_id"));
        for (unsigned last = 0; sequences.size() < ids.size();) {
            context.check_deadline();
            auto const reply = client.notifications(last, 5);
            require(!reply.root().first_child().empty(), "expected `completed` of three commands, got " + reply.body);
            for (auto const notification : reply.root()) {
                last = sequence_of(notification);
                if (is_completion(notification)) sequences.push_back(last);
            }
        }
    }

    HttpClient client;
    std::vector<std::string> ids{};     // of the commands, in order
    std::vector<unsigned> sequences{};  // of their notifications
};

std::vector<std::string> commands_in(HttpReply const& reply) {
    std::vector<std::string> ids;
    for (auto const notification : reply.root())
        if (is_completion(notification)) ids.emplace_back(notification.child("command_id").text().get());
    return ids;
}

void a_long_poll_returns_the_waiting_notifications(Context& context) {
    ThreeCompletions waiting{context};
    auto const reply = waiting.client.notifications(0, 5);
    context.traffic().validate(reply.body);
    require_equal("the document", "notifications", reply.root().name());
    require(commands_in(reply) == waiting.ids, "expected `completed` of three commands in order, got " + reply.body);
    unsigned expected = 0;
    for (auto const notification : reply.root()) {
        ++expected;
        require(sequence_of(notification) == expected, "expected sequence " + std::to_string(expected) + ", got " + reply.body);
    }
}

void a_long_poll_discards_no_notification(Context& context) {
    ThreeCompletions waiting{context};
    auto const first = commands_in(waiting.client.notifications(0, 5));
    require_equal("the same notifications again", list(first), list(commands_in(waiting.client.notifications(0, 5))));
    auto const second = waiting.sequences[1], third = waiting.sequences[2];
    auto const rest = commands_in(waiting.client.notifications(second, 5));
    require(rest == std::vector{waiting.ids[2]},
            "after=" + std::to_string(second) + ": expected only the third notification, got " + list(rest));
    auto const none = waiting.client.notifications(third, 0);
    require(none.status == 200 && commands_in(none).empty(),
            "after=" + std::to_string(third) + ": expected no `completed`, with status 200, got " + none.body);
}

void a_long_poll_refuses_invalid_numbers(Context& context) {
    ThreeCompletions waiting{context};
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
    ThreeCompletions waiting{context};
    HttpClient stream{context.address()}, again{context.address()};
    for (auto* const client : {&stream, &again}) {
        std::size_t next = client == &stream ? 0 : 2;  // of the commands
        auto number = client == &stream ? 0 : waiting.sequences[1];
        client->session = waiting.client.session;
        kit::Headers headers{{"Accept", "text/event-stream"}};
        if (number > 0) headers["Last-Event-ID"] = std::to_string(number);
        auto const reply = client->get("/rois/notifications", headers);
        require_equal("the content type", "text/event-stream", reply.header("Content-Type").substr(0, 17));
        while (next < waiting.ids.size()) {
            auto const [id, data] = next_event(*client);
            context.traffic().validate(data);
            require_equal("the id", std::to_string(++number), id);
            Document const notification{data};
            require_equal("the sequence", id, notification.attribute("sequence"));
            if (is_completion(notification.root()))
                require_equal("the command", waiting.ids[next++], notification.text("command_id"));
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
