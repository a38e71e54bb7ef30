// Profiles, queries and events.
#include <memory>
#include <sstream>

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

Breaking omits_a_profile() {
    return edits_answers("get_profile", [](pugi::xml_node root) {
        if (std::string_view{root.last_child().name()} == "rois:HRIComponentProfile") root.remove_child(root.last_child());
    });
}

Breaking reports_invalid_times() {
    return edits_answers("query", [](pugi::xml_node root) {
        auto const result = root.child("results").find_child_by_attribute("result", "rois:name", "timestamp");
        if (result) result.child("rois:value").text().set("yesterday");
    });
}

Breaking omits_located() {
    return edits_answers("query", [](pugi::xml_node root) {
        auto results = root.child("results");
        while (results.remove_child("located")) {
        }
    });
}

// Changes the first and third number of each element `name` in `located`.
Breaking changes_located(char const* name) {
    return edits_answers("query", [=](pugi::xml_node root) {
        for (auto const located : root.child("results").children("located")) {
            std::istringstream written{located.child(name).text().get()};
            double numbers[3] = {};
            for (auto& number : numbers) written >> number;
            std::ostringstream changed;
            changed << numbers[0] + 5'000 << " " << numbers[1] << " " << numbers[2] + 90;
            located.child(name).text().set(changed.str().c_str());
        }
    });
}

Breaking changes_subscribe_ids() {
    auto subscriptions = std::make_shared<int>(0);
    return edits_answers("subscribe", [subscriptions](pugi::xml_node root) {
        auto text = root.child("subscribe_id").text();
        if (text) text.set((std::string{text.get()} + "-" + std::to_string(++*subscriptions)).c_str());
    });
}

Breaking ignores_inline_results() {
    return edits_requests("subscribe", [](pugi::xml_node root) { root.remove_attribute("inline_results"); });
}

// Gives all events the same id, with the details of the last event.
Breaking uses_one_event_id() {
    auto last = std::make_shared<std::string>();
    auto breaking = edits_notifications("receive_event", [last](pugi::xml_node root) {
        auto text = root.child("event_id").text();
        *last = text.get();
        text.set("e-1");
    });
    breaking.request = edits_requests("get_event_detail", [last](pugi::xml_node root) {
                           if (auto text = root.child("event_id").text(); text.get() == std::string_view{"e-1"})
                               text.set(last->c_str());
                       }).request;
    return breaking;
}

Breaking expires_in_the_past() {
    return edits_notifications("receive_event",
                               [](pugi::xml_node root) { root.child("expire").text().set("2000-01-01T00:00:00.000Z"); });
}

// Sends inline results with all subscriptions after the first one with inline_results.
Breaking keeps_inline_results() {
    auto is_inline = std::make_shared<bool>(false);
    return edits_requests("subscribe", [=](pugi::xml_node root) {
        auto asked = root.attribute("inline_results");
        if (asked.as_bool()) *is_inline = true;
        if (*is_inline) asked.set_value(true);
    });
}

Breaking adds_a_profile() {
    return {.answer = [](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (!is(request, "get_profile") || request.find("<condition") == std::string::npos) return {answer};
        return {edited(answer, [](pugi::xml_node root) {
            if (auto const profile = root.child("rois:HRIComponentProfile"))
                root.append_copy(profile).attribute("gml:id").set_value("profile.another");
        })};
    }};
}

// Repeats the last event under another id after each completed command.
Breaking repeats_events_after_commands() {
    auto last = std::make_shared<std::string>();
    return {.notification = [last](std::string const& notification) -> Documents {
        if (is(notification, "receive_event"))
            *last = edited(notification, [](pugi::xml_node root) { root.child("event_id").text().set("e-0"); });
        if (!is(notification, "completed") || last->empty()) return {notification};
        return {notification, *last};
    }};
}

Breaking changes_the_subscription() {
    return edits_notifications("receive_event", [](pugi::xml_node root) { root.child("subscribe_id").text().set("s-0"); });
}

Breaking reports_local_time() {
    return edits_notifications("receive_event", [](pugi::xml_node root) {
        auto expire = root.child("expire").text();
        std::string const text = expire.get();
        expire.set(text.substr(0, text.size() - 1).c_str());
    });
}

std::string const no_results = "<results/>";
std::string const unknown_component = "<component_ref rois:code=\"unknown\"/>";

// Replaces the text of elements with this text.
Edit replaces(std::string const& value, std::string const& instead) {
    return [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (node.text().get() == value) node.text().set(instead.c_str());
        });
    };
}

}  // namespace

std::vector<BrokenRule> rules_of_information() {
    return {
        {"a paused stream is reported as running", "a_stream_is_suspended_until_resume",
         [] { return edits_answers("query", replaces("STREAMING_SUSPENDED", "STREAMING_RUNNING")); }},
        {"the end of a stream is not reported", "a_stream_is_connected_until_disconnect",
         [] { return edits_notifications("receive_event", replaces("STREAMING_NOT_CONNECTED", "STREAMING_NOT_RUNNING")); }},
        {"a profile is missing", "each_component_has_a_profile", omits_a_profile},
        {"get_profile ignores the condition", "a_condition_selects_profiles",
         [] { return edits_requests("get_profile", remove_condition); }},
        {"details of unknown errors are returned", "details_of_an_unknown_error_are_refused",
         [] { return answers_with("get_error_detail", "BAD_PARAMETER", "OK", no_results); }},
        {"unknown queries have an empty answer", "an_unknown_query_is_unsupported",
         [] { return answers_with("query", "UNSUPPORTED", "OK", unknown_component + no_results); }},
        {"any component answers a query", "every_query_of_every_component_is_answered",
         [] { return edits_requests("query", remove_condition); }},
        {"results are not of their type", "every_query_of_every_component_is_answered", reports_invalid_times},
        {"positions have no structure", "positions_have_located_elements", omits_located},
        {"positions contradict their texts", "located_elements_match_their_texts", [] { return changes_located("position"); }},
        {"orientations contradict their texts", "located_elements_match_their_texts",
         [] { return changes_located("orientation"); }},
        {"Japanese is reported as jp", "languages_are_iso_639_1_codes",
         [] { return edits_answers("query", replaces("ja", "jp")); }},
        {"the same subscription has another id", "a_repeated_subscription_keeps_its_id", changes_subscribe_ids},
        {"unsubscribe does nothing", "no_event_is_received_after_unsubscribe", [] { return ignores_operation("unsubscribe"); }},
        {"events are sent twice", "a_repeated_subscription_keeps_its_id", [] { return repeats("receive_event"); }},
        {"results are never inline", "results_are_inline_if_requested", ignores_inline_results},
        {"events name another subscription", "events_match_their_subscriptions", changes_the_subscription},
        {"the condition on details is ignored", "a_condition_selects_details_of_an_event",
         [] { return edits_requests("get_event_detail", remove_condition); }},
        {"details of unknown events are returned", "details_of_an_unknown_event_are_refused",
         [] { return answers_with("get_event_detail", "BAD_PARAMETER", "OK", no_results); }},
        {"subscriptions to unknown events are accepted", "a_subscription_to_an_unknown_event_is_refused",
         [] { return answers_with("subscribe", "UNSUPPORTED", "OK", "<subscribe_id>s-0</subscribe_id>"); }},
        {"the condition of a subscription is ignored", "only_matching_events_are_received",
         [] { return edits_requests("subscribe", remove_condition); }},
        {"all events have the same id", "each_event_has_a_unique_id", uses_one_event_id},
        {"events expired long ago", "events_expire_in_the_future", expires_in_the_past},
        {"results stay inline", "inline_results_can_be_switched_off", keeps_inline_results},
        {"get_profile returns profiles that do not match", "a_condition_selects_profiles", adds_a_profile},
        {"inactive functions send events", "an_inactive_component_sends_no_events", repeats_events_after_commands},
        {"times are local", "times_are_utc", reports_local_time}};
}

}  // namespace rois::broken
