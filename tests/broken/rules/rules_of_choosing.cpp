// Logical components and switching.
#include <memory>

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

void forget_switching(pugi::xml_node root) { root.remove_attribute("switching"); }

Breaking refuses_to_report_switches() {
    return {.answer = [](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (request.find("switches=") == std::string::npos) return {answer};
        return {response(request, "UNSUPPORTED", "<reason>no switches</reason>")};
    }};
}

// Members are visible to those who search for their type.
Breaking shows_members() {
    return edits_answers("search", [](pugi::xml_node root) {
        auto list = root.child("component_ref_list");
        auto const first = list.first_child();
        std::string const ref = first.attribute("rois:code").value();
        if (ref.find('.') != std::string::npos || first.next_sibling()) return;
        list.append_copy(first).attribute("rois:code").set_value(("robot1." + ref).c_str());
    });
}

// While the logical speech acts, all members do.
Breaking lets_all_act() {
    auto const acts = std::make_shared<bool>(false);
    return {.answer = [=](std::string const& request, std::string answer, ProxiedConnection&) -> Documents {
        if (is(request, "execute")) *acts = request.find("\"start\"") != std::string::npos;
        if (*acts && is(request, "query")) replace_all(answer, "READY", "BUSY");
        return {answer};
    }};
}

Breaking drops_switched() {
    return {.notification = [](std::string const& notification) -> Documents {
        if (is(notification, "switched")) return {};
        return {notification};
    }};
}

}  // namespace

std::vector<BrokenRule> rules_of_choosing() {
    std::string const goes_on = "a_command_goes_on_with_another_member", aborts = "a_command_aborts_with_its_member";
    auto const websocket = Over::websocket;
    auto const team = World::team;
    return {
        {"any value of switching is accepted", "bind_accepts_switching", [] { return edits_requests("bind", forget_switching); },
         websocket, team},
        {"switches are refused", "a_session_may_ask_for_all_switches", refuses_to_report_switches, websocket, team},
        {"members are found by their type", "members_are_seen_by_those_who_ask_for_units", shows_members, websocket, team},
        {"all members speak", "at_most_one_member_acts", lets_all_act, websocket, team},
        {"a logical component without free members is bound", "a_logical_component_cannot_be_bound_without_free_members",
         [] { return answers_with("bind", "OUT_OF_RESOURCES", "OK"); }, websocket, team},
        {"the command ends with its member", goes_on, [] { return edits_requests("bind", forget_switching); }, websocket, team},
        {"a switch is not reported", goes_on, drops_switched, websocket, team},
        {"a switch names the member that has failed", goes_on,
         [] {
             return edits_notifications(
                 "switched", [](pugi::xml_node root) { root.child("to").text().set(root.child("from").text().get()); });
         },
         websocket, team},
        {"the command goes on although it should end", aborts,
         [] {
             return edits_requests("bind", [](pugi::xml_node root) {
                 if (auto switching = root.attribute("switching")) switching.set_value("restart");
             });
         },
         websocket, team}};
}

}  // namespace rois::broken
