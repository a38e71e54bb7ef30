// Sessions, binding, and what all messages have in common.
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

Breaking speaks_after_disconnect() {
    return {.answer = [](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (!is(request, "disconnect")) return {answer};
        return {answer, "<profile_changed xmlns=\"urn:x-rois:psm:xml:message:1\" sequence=\"1000\"/>"};
    }};
}

Breaking resumes_after_the_first() {
    return edits_requests("resume", [](pugi::xml_node root) { root.attribute("last_sequence").set_value(1); });
}

Breaking forgets_one_component() {
    return edits_answers("search", [](pugi::xml_node root) {
        auto list = root.child("component_ref_list");
        if (list.first_child().next_sibling()) list.remove_child(list.last_child());
    });
}

Breaking calls_busy_ready() {
    return edits_answers("query", [](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (std::string_view{node.value()} == "BUSY") node.set_value("READY");
        });
    });
}

Breaking echoes_no_request_id() {
    return edits_answers("search", [](pugi::xml_node root) { root.remove_attribute("request_id"); });
}

Breaking gives_no_reason() {
    return edits_answers("", [](pugi::xml_node root) {
        if (auto reason = root.child("reason")) reason.text().set("");
    });
}

Breaking counts_by_twos() {
    return edits_notifications("completed", [](pugi::xml_node root) {
        auto sequence = root.attribute("sequence");
        sequence.set_value(sequence.as_int() * 2);
    });
}

Breaking answers_with_a_strange_attribute() {
    return edits_answers("bind", [](pugi::xml_node root) { root.append_attribute("colour") = "red"; });
}

// Sends the notifications that set_parameter causes before its answer.
Breaking notifies_first() {
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
    return {{"search is answered without a session", "nothing_is_allowed_before_connect",
             [=] { return says("search", "no_session", "OK", empty_list); }},
            {"disconnect does nothing", "nothing_is_allowed_after_disconnect", [] { return does_nothing_at("disconnect"); }},
            {"connect opens a session within a session", "connect_within_a_session_changes_nothing",
             opens_a_session_for_each_connect},
            {"it speaks after disconnect", "nothing_is_sent_outside_of_a_session", speaks_after_disconnect},
            {"an unknown session is resumed", "an_unknown_session_cannot_be_resumed",
             [] { return says("resume", "no_session", "OK"); }},
            {"resume loses notifications that were not received", "a_session_can_be_resumed", resumes_after_the_first},
            {"search misses one component", "search_finds_all", forgets_one_component},
            {"search takes conditions that it does not know", "a_condition_that_cannot_be_read_is_refused",
             [=] { return says("search", "BAD_PARAMETER", "OK", empty_list); }},
            {"a component is bound twice", "a_binding_is_exclusive", [] { return says("bind", "OUT_OF_RESOURCES", "OK"); }},
            {"an unknown component is bound", "bind_of_an_unknown_component_is_refused",
             [] { return says("bind", "BAD_PARAMETER", "OK"); }},
            {"bind_any tells taken and impossible apart no more", "bind_any_says_why_not",
             [] { return says("bind_any", "UNSUPPORTED", "OUT_OF_RESOURCES", "<reason>none</reason>"); }},
            {"set_parameter needs no binding", "commands_need_the_binding",
             [] { return says("set_parameter", "ERROR", "OK", "<command_id>c-0</command_id>"); }},
            {"release does nothing", "after_release_nothing_is_allowed", [] { return does_nothing_at("release"); }},
            {"nothing is ever BUSY", "a_bound_component_is_busy_for_others", calls_busy_ready},
            {"request_id is not echoed", "answers_belong_to_their_requests", echoes_no_request_id},
            {"refusals have no reason", "refusals_give_a_reason", gives_no_reason},
            {"the sequence has gaps", "notifications_are_counted_without_gaps", counts_by_twos},
            {"answers are not valid", "documents_are_valid", answers_with_a_strange_attribute},
            {"notifications of an operation come before its answer", "answers_come_before_what_they_cause", notifies_first}};
}

}  // namespace rois::broken
