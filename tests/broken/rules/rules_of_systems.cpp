// Concurrent sessions, time, engines, and failed components.
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

// Also sends this kind of notification to all other sessions, after their next answer.
std::function<Breaking()> sends_to_all_sessions(std::string const& kind) {
    struct Shared {
        std::mutex mutex;
        std::vector<std::shared_ptr<Documents>> sessions;  // the notifications to send to each
    };
    return [=, shared = std::make_shared<Shared>()] {
        auto const news = std::make_shared<Documents>();
        std::lock_guard const lock{shared->mutex};
        shared->sessions.push_back(news);
        return Breaking{.answer = [=](std::string const&, std::string const& answer, ProxiedConnection&) -> Documents {
                            std::lock_guard const inner_lock{shared->mutex};
                            auto sent = std::exchange(*news, {});
                            sent.insert(sent.begin(), answer);
                            return sent;
                        },
                        .notification = [=](std::string const& notification) -> Documents {
                            std::lock_guard const inner_lock{shared->mutex};
                            if (is(notification, kind))
                                for (auto const& session : shared->sessions)
                                    if (session != news) session->push_back(notification);
                            return {notification};
                        }};
    };
}

// Returns the details of expired events.
Breaking never_expires() {
    auto const reported = std::make_shared<std::map<std::string, std::string>>();
    return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (!is(request, "get_event_detail")) return {answer};
        std::string id;
        edited(request, [&](pugi::xml_node root) { id = root.child("event_id").text().get(); });
        auto const is_ok = answer.find("return_code=\"OK\"") != std::string::npos;
        auto const& known = is_ok ? (*reported)[id] = answer : (*reported)[id];
        if (is_ok || known.empty()) return {answer};
        pugi::xml_document before;
        before.load_buffer(known.data(), known.size());
        return {edited(answer, [&](pugi::xml_node root) {
            root.attribute("return_code").set_value("OK");
            root.remove_child("reason");
            root.append_copy(before.document_element().child("results"));
        })};
    }};
}

Breaking repeats_the_first_timestamp() {
    auto const first = std::make_shared<std::string>();
    return edits_notifications("receive_event", [=](pugi::xml_node root) {
        auto text = root.child("results").find_child_by_attribute("result", "rois:name", "timestamp").child("rois:value").text();
        if (first->empty()) *first = text.get();
        text.set(first->c_str());
    });
}

// Replaces texts that equal `text`.
Edit replaces(std::string const& text, std::string const& instead) {
    return [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (node.value() == text) node.set_value(instead.c_str());
        });
    };
}

Breaking drops_errors() {
    return {.notification = [](std::string const& notification) -> Documents {
        if (is(notification, "receive_error")) return {};
        return {notification};
    }};
}

// `bind` restores the parameters that were set before `release`.
Breaking keeps_parameters() {
    auto const last = std::make_shared<std::string>();
    return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection& link) -> Documents {
        if (is(request, "set_parameter")) *last = request;
        if (is(request, "bind") && !last->empty()) link.send_hidden(*last);
        return {answer};
    }};
}

// The query get_parameter returns the last set values to every session.
std::function<Breaking()> reveals_set_values() {
    struct Last {
        std::mutex mutex;
        pugi::xml_document parameter;
    };
    return [last = std::make_shared<Last>()]() -> Breaking {
        return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
            std::lock_guard const lock{last->mutex};
            if (is(request, "set_parameter"))
                edited(request, [&](pugi::xml_node root) {
                    last->parameter.reset();
                    last->parameter.append_copy(root.child("parameters").first_child());
                });
            if (!is(request, "query") || request.find(">get_parameter<") == std::string::npos || !last->parameter.first_child())
                return {answer};
            return {edited(answer, [&](pugi::xml_node root) {
                auto const set = last->parameter.first_child();
                auto results = root.child("results");
                std::string const name = set.attribute("rois:name").value();
                results.remove_child(results.find_child_by_attribute("result", "rois:name", name.c_str()));
                auto reported = results.prepend_copy(set);
                reported.set_name("result");
            })};
        }};
    };
}

Breaking ignores_codebooks() {
    return edits_requests("set_parameter", [](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (std::string_view{node.name()} == "rois:data_type_ref") node.remove_attribute("rois:codebook_ref");
        });
    });
}

bool has_engine_reference(std::string const& request) { return request.find(">engine<") != std::string::npos; }

// Removes the condition of `operation` if it refers to the engine.
Breaking ignores_the_engine(std::string const& operation) {
    return {.request = [=](std::string const& request) {
        return is(request, operation) && has_engine_reference(request) ? edited(request, remove_condition) : request;
    }};
}

Breaking queries_the_first_robot() {
    return {.request = [](std::string const& request) {
        if (!is(request, "query") || !has_engine_reference(request)) return request;
        return edited(request, replaces("robot2", "robot1"));
    }};
}

// Exchanges the navigation of the two robots, but not their positions.
Breaking exchanges_robots() {
    return {.request = [](std::string const& request) {
        if (is(request, "query")) return request;
        return edited(request, [](pugi::xml_node root) {
            for_each_below(root, [](pugi::xml_node node) {
                auto code = node.attribute("rois:code");
                std::string const ref = code.value();
                if (ref == "navigation") code.set_value("robot2.navigation");
                if (ref == "robot2.navigation") code.set_value("navigation");
            });
        });
    }};
}

}  // namespace

std::vector<BrokenRule> rules_of_systems() {
    std::string const agree = "status_and_errors_match_the_result_of_start";
    auto const websocket = Over::websocket;
    auto const failed_functions = World::failed_functions, robots = World::two_robots;
    return {
        {"events of other sessions are sent", "events_without_a_subscription_are_not_received",
         sends_to_all_sessions("receive_event")},
        {"completions of other sessions are sent", "an_answer_precedes_its_notifications", sends_to_all_sessions("completed")},
        {"details never expire", "details_of_an_event_expire", never_expires, websocket, World::short_expiry},
        {"all events have the time of the first one", "timestamps_increase", repeats_the_first_timestamp},
        {"a component that has failed is READY", agree, [] { return edits_answers("query", replaces("ERROR", "READY")); },
         websocket, failed_functions},
        {"a component with a WARNING is reported as failed", agree,
         [] { return edits_answers("query", replaces("WARNING", "ERROR")); }, websocket, failed_functions},
        {"a failed start is reported as done", agree, [] { return edits_notifications("completed", replaces("ERROR", "OK")); },
         websocket, failed_functions},
        {"failures of components are not reported", agree, drops_errors, websocket, failed_functions},
        {"an unresponsive component is reported as an internal error", agree,
         [] { return edits_notifications("receive_error", replaces("COMPONENT_NOT_RESPONDING", "COMPONENT_INTERNAL_ERROR")); },
         websocket, failed_functions},
        {"errors name another component", agree,
         [] {
             return edits_notifications("receive_error", [](pugi::xml_node root) {
                 root.child("component_ref").attribute("rois:code").set_value("navigation");
             });
         },
         websocket, failed_functions},
        {"parameters outlive their binding", "release_discards_set_parameters", keeps_parameters},
        {"get_parameter returns set values to other sessions", "the_query_get_parameter_hides_set_values", reveals_set_values()},
        {"codebooks of identifiers are ignored", "identifiers_of_an_unknown_codebook_are_refused", ignores_codebooks},
        {"search ignores the engine", "engine_selects_components", [] { return ignores_the_engine("search"); }, websocket,
         robots},
        {"get_profile ignores the engine", "engine_selects_profiles", [] { return ignores_the_engine("get_profile"); },
         Over::http, robots},
        {"each engine's position is that of the first robot", "engine_selects_the_robot", queries_the_first_robot, websocket,
         robots},
        {"commands move the robot of the other engine", "robots_move_independently", exchanges_robots, websocket, robots}};
}

}  // namespace rois::broken
