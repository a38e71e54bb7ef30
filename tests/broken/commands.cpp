#include "broken/commands.hpp"

#include <chrono>
#include <memory>
#include <set>
#include <utility>

namespace rois::broken {

namespace {

using Clock = std::chrono::steady_clock;

bool is_command_of(pugi::xml_node node, std::string const& component) {
    return node.attribute("rois:command_type") &&
           std::string_view{node.child("rois:component_ref").attribute("rois:code").value()}.ends_with(component);
}

Edit in_commands(std::string const& component, Edit const& edit) {
    return [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (is_command_of(node, component)) edit(node);
        });
    };
}

Edit retyped(std::string const& component, std::string const& type, std::string const& instead) {
    return in_commands(component, [=](pugi::xml_node command) {
        auto written = command.attribute("rois:command_type");
        if (written.value() == type) written.set_value(instead.c_str());
    });
}

// Returns the ids of the commands of this type in an answer of execute.
std::set<std::string> ids_in(std::string const& document, std::string const& component, std::string const& type) {
    std::set<std::string> ids;
    edited(document, in_commands(component, [&](pugi::xml_node command) {
               if (command.attribute("rois:command_type").value() == type)
                   ids.insert(command.attribute("rois:command_id").value());
           }));
    return ids;
}

std::string completed(std::string const& id, std::string const& status) {
    return "<completed xmlns=\"urn:x-rois:psm:xml:message:1\" sequence=\"1\"><command_id>" + id + "</command_id><status>" +
           status + "</status></completed>";
}

std::string completed_id(std::string const& notification) {
    if (!is(notification, "completed")) return "";
    std::string id;
    edited(notification, [&](pugi::xml_node root) { id = root.child("command_id").text().get(); });
    return id;
}

}  // namespace

Breaking edits_commands(std::string const& component, Edit const& edit) {
    return edits_requests("execute", in_commands(component, edit));
}

pugi::xml_node argument_of(pugi::xml_node command, std::string const& name) {
    return command.child("rois:arguments").find_child_by_attribute("rois:parameter", "rois:name", name.c_str());
}

Breaking edits_arguments(std::string const& component, std::string const& name, std::function<Values(Values)> const& edit) {
    return edits_commands(component, [=](pugi::xml_node command) {
        auto argument = argument_of(command, name);
        if (!argument) return;
        Values values;
        for (auto const value : argument.children("rois:value")) values.emplace_back(value.text().get());
        while (argument.remove_child("rois:value")) {
        }
        for (auto const& value : edit(values)) argument.append_child("rois:value").text().set(value.c_str());
    });
}

Breaking drops_argument(std::string const& component, std::string const& name) {
    return edits_commands(component, [=](pugi::xml_node command) {
        auto arguments = command.child("rois:arguments");
        arguments.remove_child(argument_of(command, name));
        if (!arguments.first_child()) command.remove_child(arguments);
    });
}

Breaking replaces_command(std::string const& component, std::string const& type, std::string const& instead) {
    return edits_commands(component, [=](pugi::xml_node command) {
        auto written = command.attribute("rois:command_type");
        if (written.value() != type) return;
        written.set_value(instead.c_str());
        if (instead == "stop") command.remove_child("rois:arguments");
    });
}

Breaking pretends_to_suspend(std::string const& component) {
    return edits_requests("execute", [=](pugi::xml_node root) {
        retyped(component, "suspend", "set_parameter")(root);
        retyped(component, "resume", "set_parameter")(root);
    });
}

Breaking pretends_to_stop(std::string const& component) {
    struct State {
        bool stops = false;  // the current request contains a stop
        std::string start;
        std::set<std::string> pretended, over;
    };
    auto const state = std::make_shared<State>();
    auto breaking = edits_requests("execute", [=](pugi::xml_node root) {
        in_commands(component, [=](pugi::xml_node command) {
            if (command.attribute("rois:command_type").value() == std::string_view{"stop"}) state->stops = !state->start.empty();
        })(root);
        if (state->stops) retyped(component, "stop", "set_parameter")(root);
    });
    breaking.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (!is(request, "execute")) return {answer};
        if (std::exchange(state->stops, false)) {
            state->pretended = ids_in(answer, component, "set_parameter");
        } else if (auto const started = ids_in(answer, component, "start"); !started.empty()) {
            state->start = *started.begin();
        }
        return {answer};
    };
    breaking.notification = [=](std::string const& notification) -> Documents {
        auto const id = completed_id(notification);
        if (state->over.contains(id)) return {};
        if (id == state->start) state->start.clear();
        if (!state->pretended.contains(id) || state->start.empty()) return {notification};
        state->over.insert(state->start);
        return {completed(std::exchange(state->start, ""), "ABORT"), notification};
    };
    return breaking;
}

Breaking completes_at_once(std::string const& component) {
    auto const over = std::make_shared<std::set<std::string>>();
    return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
                Documents sent{answer};
                if (!is(request, "execute")) return sent;
                for (auto const& id : ids_in(answer, component, "start"))
                    if (over->insert(id).second) sent.push_back(completed(id, "OK"));
                return sent;
            },
            .notification = [=](std::string const& notification) -> Documents {
                if (over->contains(completed_id(notification))) return {};
                return {notification};
            }};
}

// Holds `completed` back until the next answer after five seconds.
Breaking completes_late(std::string const& component) {
    constexpr std::chrono::seconds late{5};
    struct State {
        std::set<std::string> starts;
        std::string held;
        Clock::time_point deadline;
    };
    auto const state = std::make_shared<State>();
    return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
                if (is(request, "execute")) state->starts.merge(ids_in(answer, component, "start"));
                if (state->held.empty() || Clock::now() < state->deadline) return {answer};
                return {answer, std::exchange(state->held, "")};
            },
            .notification = [=](std::string const& notification) -> Documents {
                if (!state->starts.contains(completed_id(notification))) return {notification};
                state->held = notification;
                state->deadline = Clock::now() + late;
                return {};
            }};
}

}  // namespace rois::broken
