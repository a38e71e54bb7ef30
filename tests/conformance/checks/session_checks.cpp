// Sessions: connect, disconnect and resume, and the operations that need a session (7.4.1.1, figure 6; decisions 1 to 3).
#include <sstream>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using Operations = std::vector<std::pair<std::string, kit::Xml>>;

// Returns each operation that needs a session, with valid children.
Operations operations_in_a_session(Context const& context) {
    if (context.catalogue().components.empty()) throw Skipped{"the gateway has no component"};
    auto const ref = kit::component_ref(context.catalogue().components.front().ref);
    return {{"get_profile", ""},
            {"get_error_detail", "<error_id>e</error_id>"},
            {"search", ""},
            {"bind", ref},
            {"bind_any", ""},
            {"release", ref},
            {"get_parameter", ref},
            {"set_parameter", ref + kit::parameters({})},
            {"execute", kit::sequence(kit::pause(0))},
            {"get_command_result", "<command_id>c</command_id>"},
            {"query", "<query_type>component_status</query_type>"},
            {"subscribe", "<event_type>person_detected</event_type>"},
            {"unsubscribe", "<subscribe_id>s</subscribe_id>"},
            {"get_event_detail", "<event_id>e</event_id>"},
            {"disconnect", ""}};
}

void connect_opens_a_session(Context& context) {
    Client client{context, Client::Initially::disconnected};
    auto const answer = require_ok(client.connect());
    require(!answer.text("session").empty(), "connect: expected a session, got " + answer.whole());
    Client other{context};
    require(client.session() != other.session(), "two sessions have the same id " + other.session());
}

void operations_are_refused_before_connect(Context& context) {
    Client client{context, Client::Initially::disconnected};
    for (auto const& [operation, children] : operations_in_a_session(context))
        require_fault(client.ask(operation, children), "no_session");
}

void operations_are_refused_after_disconnect(Context& context) {
    Client client{context};
    require_ok(client.disconnect());
    for (auto const& [operation, children] : operations_in_a_session(context))
        require_fault(client.ask(operation, children), "no_session");
}

void connect_within_a_session_keeps_the_session(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    auto const before = client.session();
    require_equal("the session", before, require_ok(client.connect()).text("session"));
    require_ok(client.get_parameter(component.ref));
}

void connect_after_disconnect_opens_a_new_session(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    auto const before = client.session();
    require_ok(client.disconnect());
    require_ok(client.connect());
    require(client.session() != before, "connect after disconnect: expected a new session, got " + before + " again");
    require_refusal(client.get_parameter(component.ref), "ERROR");
}

void disconnect_releases_components(Context& context) {
    Client first{context}, second{context};
    std::vector<std::string> bound_before, in_use;
    for (auto const& component : context.catalogue().components)
        if (first.bind(component.ref).return_code() == "OK") bound_before.push_back(component.ref);
    if (bound_before.empty()) throw Skipped{"other applications use all components"};
    require_ok(first.disconnect());
    for (auto const& ref : bound_before) {
        auto const answer = second.bind(ref);
        if (answer.return_code() == "OUT_OF_RESOURCES") {
            in_use.push_back(ref);
        } else {
            require_ok(answer);
        }
    }
    // Another application may have bound some of the components in the meantime, but hardly all of them.
    require(in_use.size() < bound_before.size() || bound_before.size() == 1,
            "expected free components after disconnect, but all are still bound: " + list(bound_before));
    if (!in_use.empty()) throw Skipped{"another application uses " + list(in_use)};
}

void disconnect_stops_running_commands(Context& context) {
    auto const& speaker = context.speaker();
    Client first{context}, second{context};
    first.bind_or_skip(speaker);
    first.execute_one(long_speech(speaker, ""));
    require_ok(first.disconnect());
    second.bind_or_skip(speaker);
    require_equal("the status of suspend without a running command", "ERROR", second.run(command(speaker, "suspend")));
}

void no_event_is_received_after_disconnect(Context& context) {
    auto const& detector = context.detector();
    auto const event = detector.detection_event();
    Client disconnected{context}, connected{context};
    require_ok(disconnected.subscribe(event));
    require_ok(connected.subscribe(event));
    require_ok(disconnected.disconnect());
    connected.bind_or_skip(detector);
    connected.execute_one(command(detector, "start"));
    connected.next_event(event);
    require_ok(disconnected.connect());  // notifications sent earlier would arrive before this answer
    auto const& other = context.two_common_components();
    auto const& component = other.first->ref == detector.ref ? *other.second : *other.first;
    disconnected.bind_or_skip(component);
    disconnected.flush_notifications(component);
    require(disconnected.count_events(event) == 0, "received an event of a subscription from an ended session");
}

void an_unknown_session_is_refused(Context& context) {
    kit::HttpClient client{context.address()};
    client.session = unknown_name;
    auto const reply = client.call("search");
    require_equal("the fault", "no_session", reply.fault());
    require(reply.status == 403, "expected status 403, got " + std::to_string(reply.status));
    client.session.clear();
    require_equal("the reason without a session", reply.reason(), client.call("search").reason());
}

void connect_with_an_unknown_session_opens_a_new_session(Context& context) {
    kit::HttpClient client{context.address()};
    client.session = unknown_name;
    auto const reply = client.call("connect");
    require_equal("the return code", "OK", reply.return_code());
    require(client.session != unknown_name, "connect with an unknown session: expected another id");
    require_equal("the header RoIS-Session", client.session, reply.header("RoIS-Session"));
}

// Returns the attributes of `resume` for all notifications of this session.
kit::Attributes resuming(std::string const& session) { return {{"session", session}, {"last_sequence", "0"}}; }

void resume_over_http_is_refused(Context& context) {
    kit::HttpClient client{context.address()};
    client.call("connect");
    auto const reply = client.call("resume", {}, resuming(client.session));
    require_equal("the fault", "not_allowed", reply.fault());
}

void require_ok_of(std::string const& operation, pugi::xml_node answer) {
    std::ostringstream text;
    answer.print(text, "", pugi::format_raw);
    require(answer.name() == operation + "_response" && answer.attribute("return_code").value() == std::string{"OK"},
            operation + ": expected an answer with return_code OK, got " + text.str());
}

// After the connection has ended, the session keeps its bindings and the unreceived notifications.
void a_session_can_be_resumed(Context& context) {
    auto const number = number_parameter_of(context);
    WebSocket first{context}, second{context};
    first.call("connect");
    auto const session = first.session();
    auto const bound =
        std::string{first.call("bind", kit::component_ref(number.component->ref)).attribute("return_code").value()};
    if (bound != "OK") throw Skipped{"another application uses " + number.component->ref};
    auto const set = kit::component_ref(number.component->ref) + kit::parameters({with_value(number, 50)});
    first.call("set_parameter", set);
    first.next_document();
    first.keep_session();
    require_ok_of("resume", second.call("resume", {}, resuming(session)));
    auto const require_completed = [&](unsigned sequence) {
        auto const notification = second.next_document();
        require_equal("the notification", "completed", notification.name());
        require_equal("the sequence", std::to_string(sequence + second.skipped()), notification.attribute("sequence").value());
    };
    require_completed(1);
    require_ok_of("set_parameter", second.call("set_parameter", set));  // the component is still bound
    require_completed(2);
    require_ok_of("disconnect", second.call("disconnect"));
}

void an_unknown_session_cannot_be_resumed(Context& context) {
    WebSocket client{context};
    auto const answer = client.call("resume", {}, resuming(unknown_name));
    require_equal("the fault", "no_session", answer.attribute("code").value());
}

}  // namespace

Clause session_clause() {
    return {
        "7.4.1.1 System interface: connection and disconnection",
        {{"connect_opens_a_session", "figure 6; table 2", connect_opens_a_session},
         {"operations_are_refused_before_connect", "figure 6; decision 1", operations_are_refused_before_connect},
         {"operations_are_refused_after_disconnect", "figure 6; decision 1", operations_are_refused_after_disconnect},
         {"connect_within_a_session_keeps_the_session", "figure 6; decision 1", connect_within_a_session_keeps_the_session},
         {"connect_after_disconnect_opens_a_new_session", "figure 6; decision 3", connect_after_disconnect_opens_a_new_session},
         {"disconnect_releases_components", "figure 6; decision 3", disconnect_releases_components},
         {"disconnect_stops_running_commands", "figure 6; decision 3", disconnect_stops_running_commands},
         {"no_event_is_received_after_disconnect", "figure 6; decision 3", no_event_is_received_after_disconnect},
         {"an_unknown_session_is_refused", "decision 1; docs/clients.md", an_unknown_session_is_refused, Transport::http},
         {"connect_with_an_unknown_session_opens_a_new_session", "decision 3",
          connect_with_an_unknown_session_opens_a_new_session, Transport::http},
         {"resume_over_http_is_refused", "docs/clients.md", resume_over_http_is_refused, Transport::http},
         {"a_session_can_be_resumed", "decision 2", a_session_can_be_resumed, Transport::websocket},
         {"an_unknown_session_cannot_be_resumed", "decision 2", an_unknown_session_cannot_be_resumed, Transport::websocket}}};
}

}  // namespace rois::conformance
