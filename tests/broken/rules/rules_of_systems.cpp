// Concurrent sessions, time, engines, and failed components.
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

// Sends this kind of notification of one session to all others, too, with the next answer.
std::function<Breaking()> tells_all_sessions(std::string const& kind) {
    struct Gossip {
        std::mutex mutex;
        std::vector<std::shared_ptr<Documents>> sessions;  // the notifications to send to each
    };
    return [=, gossip = std::make_shared<Gossip>()] {
        auto const news = std::make_shared<Documents>();
        std::lock_guard const lock{gossip->mutex};
        gossip->sessions.push_back(news);
        return Breaking{.answer = [=](std::string const&, std::string const& answer, ProxiedConnection&) -> Documents {
                            std::lock_guard const telling{gossip->mutex};
                            auto said = std::exchange(*news, {});
                            said.insert(said.begin(), answer);
                            return said;
                        },
                        .notification = [=](std::string const& notification) -> Documents {
                            std::lock_guard const telling{gossip->mutex};
                            if (is(notification, kind))
                                for (auto const& session : gossip->sessions)
                                    if (session != news) session->push_back(notification);
                            return {notification};
                        }};
    };
}

// Returns earlier details again.
Breaking forgets_to_expire() {
    auto const told = std::make_shared<std::map<std::string, std::string>>();
    return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (!is(request, "get_event_detail")) return {answer};
        std::string id;
        edited(request, [&](pugi::xml_node root) { id = root.child("event_id").text().get(); });
        auto const is_ok = answer.find("return_code=\"OK\"") != std::string::npos;
        auto const& known = is_ok ? (*told)[id] = answer : (*told)[id];
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

Breaking stops_the_clock() {
    auto const first = std::make_shared<std::string>();
    return edits_notifications("receive_event", [=](pugi::xml_node root) {
        auto text = root.child("results").find_child_by_attribute("result", "rois:name", "timestamp").child("rois:value").text();
        if (first->empty()) *first = text.get();
        text.set(first->c_str());
    });
}

// A text.
Edit replaces(std::string const& text, std::string const& instead) {
    return [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (node.value() == text) node.set_value(instead.c_str());
        });
    };
}

Breaking tells_no_errors() {
    return {.notification = [](std::string const& notification) -> Documents {
        if (is(notification, "receive_error")) return {};
        return {notification};
    }};
}

// Restores the parameters of before a release when the component is bound again.
Breaking keeps_parameters() {
    auto const last = std::make_shared<std::string>();
    return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection& link) -> Documents {
        if (is(request, "set_parameter")) *last = request;
        if (is(request, "bind") && !last->empty()) link.ask_aside(*last);
        return {answer};
    }};
}

// The query get_parameter returns the last set values to every session.
std::function<Breaking()> tells_what_was_set() {
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
                auto told = results.prepend_copy(set);
                told.set_name("result");
            })};
        }};
    };
}

Breaking takes_any_codebook() {
    return edits_requests("set_parameter", [](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (std::string_view{node.name()} == "rois:data_type_ref") node.remove_attribute("rois:codebook_ref");
        });
    });
}

bool is_about_the_engine(std::string const& request) { return request.find(">engine<") != std::string::npos; }

// The condition of `operation`, if it refers to the engine.
Breaking ignores_the_engine(std::string const& operation) {
    return {.request = [=](std::string const& request) {
        return is(request, operation) && is_about_the_engine(request) ? edited(request, remove_condition) : request;
    }};
}

Breaking asks_the_first_robot() {
    return {.request = [](std::string const& request) {
        if (!is(request, "query") || !is_about_the_engine(request)) return request;
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
    std::string const agree = "status_and_errors_agree_with_what_happens";
    auto const websocket = Over::websocket;
    auto const unwell = World::unwell, robots = World::two_robots;
    return {
        {"events of other sessions are sent", "what_was_not_subscribed_is_not_received", tells_all_sessions("receive_event")},
        {"completions of other sessions are sent", "answers_come_before_what_they_cause", tells_all_sessions("completed")},
        {"details never expire", "details_expire", forgets_to_expire, websocket, World::short_memory},
        {"all events have the time of the first one", "timestamps_go_on", stops_the_clock},
        {"a component that has failed is READY", agree, [] { return edits_answers("query", replaces("ERROR", "READY")); },
         websocket, unwell},
        {"a component that complains has failed", agree, [] { return edits_answers("query", replaces("WARNING", "ERROR")); },
         websocket, unwell},
        {"a failed start is reported as done", agree, [] { return edits_notifications("completed", replaces("ERROR", "OK")); },
         websocket, unwell},
        {"failures of components are not told", agree, tells_no_errors, websocket, unwell},
        {"silence of a component is reported as its failure", agree,
         [] { return edits_notifications("receive_error", replaces("COMPONENT_NOT_RESPONDING", "COMPONENT_INTERNAL_ERROR")); },
         websocket, unwell},
        {"errors name another component", agree,
         [] {
             return edits_notifications("receive_error", [](pugi::xml_node root) {
                 root.child("component_ref").attribute("rois:code").set_value("navigation");
             });
         },
         websocket, unwell},
        {"parameters outlive their binding", "parameters_end_with_the_binding", keeps_parameters},
        {"get_parameter returns set values to other sessions", "parameters_are_read_without_a_binding_by_query",
         tells_what_was_set()},
        {"codebooks of identifiers are ignored", "identifiers_of_a_foreign_codebook_are_refused", takes_any_codebook},
        {"search ignores the engine", "engine_chooses_components", [] { return ignores_the_engine("search"); }, websocket,
         robots},
        {"get_profile ignores the engine", "engine_chooses_profiles", [] { return ignores_the_engine("get_profile"); },
         Over::http, robots},
        {"each engine's position is that of the first robot", "engine_chooses_the_robot", asks_the_first_robot, websocket,
         robots},
        {"each robot drives for the other one", "each_robot_moves_by_itself", exchanges_robots, websocket, robots}};
}

}  // namespace rois::broken
