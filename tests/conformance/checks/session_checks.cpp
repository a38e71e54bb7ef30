// Sessions: who may ask, when, and what an end leaves behind (7.4.1.1, figure 6; decisions 1 to 3).
#include "conformance/stage.hpp"
#include "kit/websocket_client.hpp"

namespace rois::conformance {

namespace {

using Operations = std::vector<std::pair<std::string, kit::Xml>>;

// Each operation that needs a session, with children that are valid.
Operations operations_in_a_session(Stage const& stage) {
    if (stage.catalogue().components.empty()) throw NotPlayed{"there is no component"};
    auto const ref = kit::component_ref(stage.catalogue().components.front().ref);
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

void connect_opens_a_session(Stage& stage) {
    Guest guest{stage, Guest::Comes::as_a_stranger};
    auto const answer = ok(guest.connect());
    require(!answer.text("session").empty(), "the answer should have a session: " + answer.whole());
    Guest other{stage};
    require(guest.session() != other.session(), "two sessions have the same id");
}

void nothing_is_allowed_before_connect(Stage& stage) {
    Guest stranger{stage, Guest::Comes::as_a_stranger};
    for (auto const& [operation, children] : operations_in_a_session(stage))
        fault(stranger.ask(operation, children), "no_session");
}

void nothing_is_allowed_after_disconnect(Stage& stage) {
    Guest guest{stage};
    ok(guest.disconnect());
    for (auto const& [operation, children] : operations_in_a_session(stage)) fault(guest.ask(operation, children), "no_session");
}

void connect_within_a_session_changes_nothing(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    auto const before = guest.session();
    same("the session", before, ok(guest.connect()).text("session"));
    ok(guest.get_parameter(component.ref));
}

void connect_after_disconnect_opens_another_session(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    auto const before = guest.session();
    ok(guest.disconnect());
    ok(guest.connect());
    require(guest.session() != before, "the session " + before + " has come back");
    refused(guest.get_parameter(component.ref), "ERROR");
}

void disconnect_releases_components(Stage& stage) {
    Guest first{stage}, second{stage};
    std::vector<std::string> had, taken;
    for (auto const& component : stage.catalogue().components)
        if (first.bind(component.ref).return_code() == "OK") had.push_back(component.ref);
    if (had.empty()) throw NotPlayed{"other applications use all components"};
    ok(first.disconnect());
    for (auto const& ref : had) {
        auto const answer = second.bind(ref);
        if (answer.return_code() == "OUT_OF_RESOURCES") {
            taken.push_back(ref);
        } else {
            ok(answer);
        }
    }
    // Another application may have been quicker, though hardly with all of them.
    require(taken.size() < had.size() || had.size() == 1, "none of what it had is free after disconnect: " + list(had));
    if (!taken.empty()) throw NotPlayed{"another application uses " + list(taken)};
}

void disconnect_stops_what_runs(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest first{stage}, second{stage};
    first.take(speaker);
    first.order(long_speech(speaker, ""));
    ok(first.disconnect());
    second.take(speaker);
    same("the status of a suspended component without a running command", "ERROR", second.ending(command(speaker, "suspend")));
}

void nothing_is_received_after_disconnect(Stage& stage) {
    auto const& detector = stage.detector();
    auto const event = detector.detection();
    Guest gone{stage}, here{stage};
    ok(gone.subscribe(event));
    ok(here.subscribe(event));
    ok(gone.disconnect());
    here.take(detector);
    here.order(command(detector, "start"));
    here.hear_event(event);
    ok(gone.connect());  // a sent notification would have been received before the answer
    auto const& other = stage.two_common();
    auto const& component = other.first->ref == detector.ref ? *other.second : *other.first;
    gone.take(component);
    gone.settle(component);
    require(gone.heard_events(event) == 0, "a subscription outlived its session");
}

void an_unknown_session_is_refused(Stage& stage) {
    kit::HttpClient client{stage.address()};
    client.session = nobody;
    auto const reply = client.call("search");
    same("the fault", "no_session", reply.fault());
    require(reply.status == 403, "the HTTP status should be 403, and is " + std::to_string(reply.status));
    client.session.clear();
    same("the reason without a session", reply.reason(), client.call("search").reason());
}

void connect_with_an_unknown_session_opens_a_new_one(Stage& stage) {
    kit::HttpClient client{stage.address()};
    client.session = nobody;
    auto const reply = client.call("connect");
    same("the return code", "OK", reply.return_code());
    require(client.session != nobody, "the session should have an id of its own");
    same("the header RoIS-Session", client.session, reply.header("RoIS-Session"));
}

// What `resume` asks for: all of this session.
kit::Attributes resuming(std::string const& session) { return {{"session", session}, {"last_sequence", "0"}}; }

void resume_is_for_websockets(Stage& stage) {
    kit::HttpClient client{stage.address()};
    client.call("connect");
    auto const reply = client.call("resume", {}, resuming(client.session));
    same("the fault", "not_allowed", reply.fault());
}

// The connection ends, the session stays, with its bindings and the notifications that were not received.
void a_session_can_be_resumed(Stage& stage) {
    auto const dial = dial_of(stage);
    kit::WebSocketClient first{stage.address()}, second{stage.address()};
    first.call("connect");
    auto const session = first.session();
    auto const bound = std::string{first.call("bind", kit::component_ref(dial.component->ref)).attribute("return_code").value()};
    auto const resume = [&] { return second.call("resume", {}, resuming(session)); };
    if (bound != "OK") throw NotPlayed{"another application uses " + dial.component->ref};
    auto const set = kit::component_ref(dial.component->ref) + kit::parameters({turned(dial, 50)});
    first.call("set_parameter", set);
    first.next_document();
    first.vanish();
    same("the answer of resume", "OK", resume().attribute("return_code").value());
    auto const notification = second.next_document();
    same("the received notifications", "completed", notification.name());
    same("its sequence", "1", notification.attribute("sequence").value());
    same("set_parameter of a component that is still bound", "OK",
         second.call("set_parameter", set).attribute("return_code").value());
    same("the next sequence", "2", second.next_document().attribute("sequence").value());
    same("disconnect", "OK", second.call("disconnect").attribute("return_code").value());
}

void an_unknown_session_cannot_be_resumed(Stage& stage) {
    kit::WebSocketClient client{stage.address()};
    auto const answer = client.call("resume", {}, resuming(nobody));
    same("the fault", "no_session", answer.attribute("code").value());
}

}  // namespace

Clause session_clause() {
    return {"7.4.1.1 System interface: connection and disconnection",
            {{"connect_opens_a_session", "figure 6; table 2", connect_opens_a_session},
             {"nothing_is_allowed_before_connect", "figure 6; decision 1", nothing_is_allowed_before_connect},
             {"nothing_is_allowed_after_disconnect", "figure 6; decision 1", nothing_is_allowed_after_disconnect},
             {"connect_within_a_session_changes_nothing", "figure 6; decision 1", connect_within_a_session_changes_nothing},
             {"connect_after_disconnect_opens_another_session", "figure 6; decision 3",
              connect_after_disconnect_opens_another_session},
             {"disconnect_releases_components", "figure 6; decision 3", disconnect_releases_components},
             {"disconnect_stops_what_runs", "figure 6; decision 3", disconnect_stops_what_runs},
             {"nothing_is_received_after_disconnect", "figure 6; decision 3", nothing_is_received_after_disconnect},
             {"an_unknown_session_is_refused", "decision 1; docs/clients.md", an_unknown_session_is_refused, Way::http},
             {"connect_with_an_unknown_session_opens_a_new_one", "decision 3", connect_with_an_unknown_session_opens_a_new_one,
              Way::http},
             {"resume_is_for_websockets", "docs/clients.md", resume_is_for_websockets, Way::http},
             {"a_session_can_be_resumed", "decision 2", a_session_can_be_resumed, Way::websocket},
             {"an_unknown_session_cannot_be_resumed", "decision 2", an_unknown_session_cannot_be_resumed, Way::websocket}}};
}

}  // namespace rois::conformance
