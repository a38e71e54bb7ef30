// Profiles, queries and events.
#include <memory>
#include <sstream>

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

Breaking forgets_a_profile() {
    return edits_answers("get_profile", [](pugi::xml_node root) {
        if (std::string_view{root.last_child().name()} == "rois:HRIComponentProfile") root.remove_child(root.last_child());
    });
}

Breaking tells_no_times() {
    return edits_answers("query", [](pugi::xml_node root) {
        auto const result = root.child("results").find_child_by_attribute("result", "rois:name", "timestamp");
        if (result) result.child("rois:value").text().set("yesterday");
    });
}

Breaking tells_no_structure() {
    return edits_answers("query", [](pugi::xml_node root) {
        auto results = root.child("results");
        while (results.remove_child("located")) {
        }
    });
}

// The first number of each `name` within `located` becomes another one.
Breaking locates_elsewhere(char const* name) {
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

Breaking subscribes_anew() {
    auto subscriptions = std::make_shared<int>(0);
    return edits_answers("subscribe", [subscriptions](pugi::xml_node root) {
        auto text = root.child("subscribe_id").text();
        if (text) text.set((std::string{text.get()} + "-" + std::to_string(++*subscriptions)).c_str());
    });
}

Breaking never_inlines() {
    return edits_requests("subscribe", [](pugi::xml_node root) { root.remove_attribute("inline_results"); });
}

// Gives all events one id, whose details are those of the last event.
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

Breaking expired_long_ago() {
    return edits_notifications("receive_event",
                               [](pugi::xml_node root) { root.child("expire").text().set("2000-01-01T00:00:00.000Z"); });
}

// After the first request.
Breaking keeps_inlining() {
    auto is_asked_for = std::make_shared<bool>(false);
    return edits_requests("subscribe", [=](pugi::xml_node root) {
        auto asked = root.attribute("inline_results");
        if (asked.as_bool()) *is_asked_for = true;
        if (*is_asked_for) asked.set_value(true);
    });
}

Breaking tells_a_profile_too_many() {
    return {.answer = [](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (!is(request, "get_profile") || request.find("<condition") == std::string::npos) return {answer};
        return {edited(answer, [](pugi::xml_node root) {
            if (auto const profile = root.child("rois:HRIComponentProfile"))
                root.append_copy(profile).attribute("gml:id").set_value("profile.another");
        })};
    }};
}

// Repeats the last event under another id after each completed command.
Breaking is_never_silent() {
    auto last = std::make_shared<std::string>();
    return {.notification = [last](std::string const& notification) -> Documents {
        if (is(notification, "receive_event"))
            *last = edited(notification, [](pugi::xml_node root) { root.child("event_id").text().set("e-0"); });
        if (!is(notification, "completed") || last->empty()) return {notification};
        return {notification, *last};
    }};
}

Breaking names_another_subscription() {
    return edits_notifications("receive_event", [](pugi::xml_node root) { root.child("subscribe_id").text().set("s-0"); });
}

Breaking tells_local_time() {
    return edits_notifications("receive_event", [](pugi::xml_node root) {
        auto expire = root.child("expire").text();
        std::string const text = expire.get();
        expire.set(text.substr(0, text.size() - 1).c_str());
    });
}

std::string const no_results = "<results/>";
std::string const nobody = "<component_ref rois:code=\"nobody\"/>";

// A value.
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
        {"a paused stream is reported as running", "a_stream_is_suspended_until_it_is_resumed",
         [] { return edits_answers("query", replaces("STREAMING_SUSPENDED", "STREAMING_RUNNING")); }},
        {"the end of a stream is not told", "a_stream_is_connected_until_it_is_disconnected",
         [] { return edits_notifications("receive_event", replaces("STREAMING_NOT_CONNECTED", "STREAMING_NOT_RUNNING")); }},
        {"a profile is missing", "each_component_has_a_profile", forgets_a_profile},
        {"get_profile tells all, whatever is asked for", "get_profile_chooses_by_condition",
         [] { return edits_requests("get_profile", remove_condition); }},
        {"details of unknown errors are returned", "details_of_an_unknown_error_are_refused",
         [] { return says("get_error_detail", "BAD_PARAMETER", "OK", no_results); }},
        {"unknown queries have an empty answer", "an_unknown_query_is_unsupported",
         [] { return says("query", "UNSUPPORTED", "OK", nobody + no_results); }},
        {"any component answers a query", "every_query_of_every_component_is_answered",
         [] { return edits_requests("query", remove_condition); }},
        {"results are not of their type", "every_query_of_every_component_is_answered", tells_no_times},
        {"positions have no structure", "located_results_have_their_structure", tells_no_structure},
        {"positions contradict their texts", "located_elements_say_what_texts_say", [] { return locates_elsewhere("position"); }},
        {"orientations contradict their texts", "located_elements_say_what_texts_say",
         [] { return locates_elsewhere("orientation"); }},
        {"Japanese is reported as jp", "languages_are_iso_639_1", [] { return edits_answers("query", replaces("ja", "jp")); }},
        {"the same subscription has another id", "the_same_subscription_again_changes_nothing", subscribes_anew},
        {"unsubscribe does nothing", "after_unsubscribe_nothing_is_received", [] { return does_nothing_at("unsubscribe"); }},
        {"events come twice", "the_same_subscription_again_changes_nothing", [] { return repeats("receive_event"); }},
        {"results are never inline", "results_come_inline_when_asked_for", never_inlines},
        {"events name another subscription", "events_are_those_that_were_subscribed", names_another_subscription},
        {"details are not chosen", "details_are_chosen_by_condition",
         [] { return edits_requests("get_event_detail", remove_condition); }},
        {"details of unknown events are returned", "details_of_an_unknown_event_are_refused",
         [] { return says("get_event_detail", "BAD_PARAMETER", "OK", no_results); }},
        {"what cannot happen is subscribed", "what_cannot_happen_is_unsupported",
         [] { return says("subscribe", "UNSUPPORTED", "OK", "<subscribe_id>s-0</subscribe_id>"); }},
        {"all events are sent, whatever is asked for", "only_events_that_match_are_received",
         [] { return edits_requests("subscribe", remove_condition); }},
        {"ids of events are used again", "each_event_has_an_id_of_its_own", uses_one_event_id},
        {"events expired long ago", "events_expire_in_the_future", expired_long_ago},
        {"results stay inline", "inline_results_are_taken_back", keeps_inlining},
        {"get_profile tells profiles that were not chosen", "get_profile_chooses_by_condition", tells_a_profile_too_many},
        {"functions are never silent", "what_does_not_run_is_silent", is_never_silent},
        {"times are local", "times_are_utc", tells_local_time}};
}

}  // namespace rois::broken
