// Sessions, binding, and the rules for all messages.
#include <memory>
#include <utility>

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

Breaking opens_a_session_for_each_connect() {
    auto connects = std::make_shared<int>(0);
    return edits_answers("connect", [connects](pugi::xml_node root) {
        auto text = root.child("session").text();
        if (++*connects > 1) text.set((std::string{text.get()} + "-" + std::to_string(*connects)).c_str());
    });
}

Breaking notifies_after_disconnect() {
    return {.answer = [](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (!is(request, "disconnect")) return {answer};
        return {answer, "<profile_changed xmlns=\"urn:x-rois:psm:xml:message:1\" sequence=\"1000\"/>"};
    }};
}

Breaking skips_the_first_notification() {
    return edits_requests("resume", [](pugi::xml_node root) { root.attribute("last_sequence").set_value(1); });
}

Breaking omits_one_component() {
    return edits_answers("search", [](pugi::xml_node root) {
        auto list = root.child("component_ref_list");
        if (list.first_child().next_sibling()) list.remove_child(list.last_child());
    });
}

Breaking reports_busy_as_ready() {
    return edits_answers("query", [](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (std::string_view{node.value()} == "BUSY") node.set_value("READY");
        });
    });
}

Breaking omits_the_request_id() {
    return edits_answers("search", [](pugi::xml_node root) { root.remove_attribute("request_id"); });
}

Breaking omits_the_reason() {
    return edits_answers("", [](pugi::xml_node root) {
        if (auto reason = root.child("reason")) reason.text().set("");
    });
}

Breaking doubles_sequences() {
    return edits_notifications("completed", [](pugi::xml_node root) {
        auto sequence = root.attribute("sequence");
        sequence.set_value(sequence.as_int() * 2);
    });
}

Breaking adds_an_unknown_attribute() {
    return edits_answers("bind", [](pugi::xml_node root) { root.append_attribute("colour") = "red"; });
}

// Sends the notifications that set_parameter causes before its answer.
Breaking notifies_before_the_answer() {
    auto held = std::make_shared<std::string>();
    return {.answer = [held](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
                if (!is(request, "set_parameter") || answer.find("\"OK\"") == std::string::npos) return {answer};
                *held = answer;
                return {};
            },
            .notification = [held](std::string const& notification) -> Documents {
                if (held->empty()) return {notification};
                return {notification, std::exchange(*held, "")};
            }};
}

}  // namespace

std::vector<BrokenRule> rules_of_sessions() {
    std::string const empty_list = "<component_ref_list/>";
    return {
        {"search is answered without a session", "operations_are_refused_before_connect",
         [=] { return answers_with("search", "no_session", "OK", empty_list); }},
        {"disconnect does nothing", "operations_are_refused_after_disconnect", [] { return ignores_operation("disconnect"); }},
        {"connect opens a session within a session", "connect_within_a_session_keeps_the_session",
         opens_a_session_for_each_connect},
        {"a notification is sent after disconnect", "no_notification_is_sent_without_a_session", notifies_after_disconnect},
        {"an unknown session is resumed", "an_unknown_session_cannot_be_resumed",
         [] { return answers_with("resume", "no_session", "OK"); }},
        {"resume loses notifications that were not received", "a_session_can_be_resumed", skips_the_first_notification},
        {"search misses one component", "search_without_a_condition_returns_all_components", omits_one_component},
        {"search accepts unknown references", "a_condition_with_an_unknown_reference_is_refused",
         [=] { return answers_with("search", "BAD_PARAMETER", "OK", empty_list); }},
        {"a component is bound twice", "a_binding_is_exclusive", [] { return answers_with("bind", "OUT_OF_RESOURCES", "OK"); }},
        {"an unknown component is bound", "bind_of_an_unknown_component_is_refused",
         [] { return answers_with("bind", "BAD_PARAMETER", "OK"); }},
        {"bind_any does not distinguish bound from unknown components", "bind_any_distinguishes_bound_from_unknown_components",
         [] { return answers_with("bind_any", "UNSUPPORTED", "OUT_OF_RESOURCES", "<reason>no free component</reason>"); }},
        {"set_parameter needs no binding", "commands_need_a_binding",
         [] { return answers_with("set_parameter", "ERROR", "OK", "<command_id>c-0</command_id>"); }},
        {"release does nothing", "commands_are_refused_after_release", [] { return ignores_operation("release"); }},
        {"no component is ever BUSY", "a_bound_component_is_busy_for_others", reports_busy_as_ready},
        {"request_id is not echoed", "answers_match_their_requests", omits_the_request_id},
        {"refusals have no reason", "refusals_have_a_reason", omits_the_reason},
        {"the sequence has gaps", "notification_sequences_have_no_gaps", doubles_sequences},
        {"answers are not valid", "documents_are_valid", adds_an_unknown_attribute},
        {"notifications of an operation precede its answer", "an_answer_precedes_its_notifications", notifies_before_the_answer}};
}

}  // namespace rois::broken
