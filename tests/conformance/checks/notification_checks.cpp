// How notifications reach an application over HTTP (docs/clients.md; decisions 22 and 23).
#include "conformance/stage.hpp"
#include "kit/http_client.hpp"

namespace rois::conformance {

namespace {

using kit::HttpClient;
using kit::HttpReply;

// A session for which three notifications wait.
class Inbox {
public:
    explicit Inbox(Stage& stage) : client{stage.address()} {
        auto const dial = dial_of(stage);
        auto const& component = *dial.component;
        client.call("connect");
        auto const bound = client.call("bind", kit::component_ref(component.ref)).return_code();
        if (bound == "OUT_OF_RESOURCES") throw NotPlayed{"another application uses " + component.ref};
        auto const set = kit::component_ref(component.ref) + kit::parameters({turned(dial, 50)});
        for (int i = 0; i < 3; ++i) ids.push_back(client.call("set_parameter", set).text("command_id"));
        for (int i = 0; i < 3; ++i) client.notifications(i, 5);  // until the last one has completed
    }

    HttpClient client;
    std::vector<std::string> ids;  // of the commands, in order
};

std::vector<std::string> commands_in(HttpReply const& reply) {
    std::vector<std::string> ids;
    for (auto const notification : reply.root()) ids.emplace_back(notification.child("command_id").text().get());
    return ids;
}

void a_long_poll_gives_what_is_there(Stage& stage) {
    Inbox inbox{stage};
    auto const reply = inbox.client.notifications(0, 5);
    stage.traffic().validate(reply.body);
    same("the document", "notifications", reply.root().name());
    require(commands_in(reply) == inbox.ids, "three commands should have completed in order: " + reply.body);
    unsigned sequence = 0;
    for (auto const notification : reply.root())
        require(notification.attribute("sequence").as_uint() == ++sequence, "the sequence has a gap: " + reply.body);
}

void reading_discards_nothing(Stage& stage) {
    Inbox inbox{stage};
    auto const first = inbox.client.notifications(0, 5);
    same("the same notifications again", first.body, inbox.client.notifications(0, 5).body);
    auto const rest = commands_in(inbox.client.notifications(2, 5));
    require(rest == std::vector{inbox.ids[2]}, "after=2 should give the third: " + list(rest));
    auto const none = inbox.client.notifications(3, 0);
    require(none.status == 200 && !none.root().first_child(), "after=3 should give an empty list: " + none.body);
}

void a_long_poll_takes_numbers_only(Stage& stage) {
    Inbox inbox{stage};
    for (auto const* const query : {"after=x", "after=-1", "wait=soon", "wait=31"}) {
        auto const reply = inbox.client.get(std::string{"/rois/notifications?"} + query);
        require(reply.status == 400,
                std::string{query} + " should be answered with 400, and is with " + std::to_string(reply.status));
    }
}

void notifications_need_a_session(Stage& stage) {
    HttpClient client{stage.address()};
    auto const reply = client.get("/rois/notifications");
    require(reply.status == 403, "the status should be 403, and is " + std::to_string(reply.status));
    same("the fault", "no_session", reply.fault());
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

void an_event_stream_gives_the_same(Stage& stage) {
    Inbox inbox{stage};
    HttpClient stream{stage.address()}, again{stage.address()};
    for (auto* const client : {&stream, &again}) {
        bool const is_first = client == &stream;
        client->session = inbox.client.session;
        kit::Headers headers{{"Accept", "text/event-stream"}};
        if (!is_first) headers["Last-Event-ID"] = "2";
        auto const reply = client->get("/rois/notifications", headers);
        same("the content type", "text/event-stream", reply.header("Content-Type").substr(0, 17));
        for (std::size_t number = is_first ? 1 : 3; number <= 3; ++number) {
            auto const [id, data] = next_event(*client);
            stage.traffic().validate(data);
            same("the id", std::to_string(number), id);
            Document const notification{data};
            same("the sequence", id, notification.attribute("sequence"));
            same("the command", inbox.ids[number - 1], notification.text("command_id"));
        }
        client->session.clear();
    }
}

}  // namespace

Clause notification_clause() {
    return {
        "7.4.2.2 Service application base: notifications over HTTP",
        {{"a_long_poll_gives_what_is_there", "table 6; decision 22; docs/clients.md", a_long_poll_gives_what_is_there, Way::http},
         {"reading_discards_nothing", "decision 23", reading_discards_nothing, Way::http},
         {"a_long_poll_takes_numbers_only", "docs/clients.md", a_long_poll_takes_numbers_only, Way::http},
         {"notifications_need_a_session", "figure 6; decision 1", notifications_need_a_session, Way::http},
         {"an_event_stream_gives_the_same", "docs/clients.md", an_event_stream_gives_the_same, Way::http}}};
}

}  // namespace rois::conformance
