#include "broken/variants.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <set>
#include <vector>

#include "broken/breaking.hpp"

namespace rois::broken {

namespace {

// The optional and conditional names of tables 34 to 47, of Move and of streams; `robot_ref` is not in the tables of 2011.
std::set<std::string> const optional_names{"grammar",
                                           "rule",
                                           "volume",
                                           "language",
                                           "character",
                                           "SSML_text",
                                           "synthesizable_languages",
                                           "synthesizable_characters",
                                           "time_limit",
                                           "routing_policy",
                                           "reached_target",
                                           "curve",
                                           "time",
                                           "detection_threshold",
                                           "minimum_interval",
                                           "encoding_parameters",
                                           "transport_parameters",
                                           "available_encodings",
                                           "available_transports",
                                           "operable_time",
                                           "robot_ref"};

// Minimum Standard Filter.
std::set<std::string> const filter_elements{"fes:Filter",
                                            "fes:And",
                                            "fes:Or",
                                            "fes:Not",
                                            "fes:PropertyIsEqualTo",
                                            "fes:PropertyIsNotEqualTo",
                                            "fes:PropertyIsLessThan",
                                            "fes:PropertyIsGreaterThan",
                                            "fes:PropertyIsLessThanOrEqualTo",
                                            "fes:PropertyIsGreaterThanOrEqualTo",
                                            "fes:ValueReference",
                                            "fes:Literal"};

bool is_optional(pugi::xml_node node) { return optional_names.contains(node.attribute("rois:name").value()); }

void remove_optional(pugi::xml_node root) {
    for_each_below(root, [](pugi::xml_node node) {
        if (is_optional(node)) node.parent().remove_child(node);
    });
}

// Returns the optional part that the request uses and this gateway lacks; empty if there is none.
std::string optional_part_of(std::string const& request) {
    std::string found;
    edited(request, [&](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            std::string const name = node.name();
            if (is_optional(node)) found = node.attribute("rois:name").value();
            if (name.starts_with("fes:") && !filter_elements.contains(name)) found = name;
        });
    });
    return found;
}

bool asks_for_profiles(Message const& request) { return request.first_line.starts_with("GET /rois/profile"); }

bool asks_for_documents(Message const& request) {
    return asks_for_profiles(request) || request.first_line.starts_with("GET /rois/notifications?");
}

void edit_body(Message& reply, Edit const& edit) {
    if (!reply.body.empty()) reply.body = edited(reply.body, edit);
}

bool has_text(std::string const& document, std::string const& text) { return document.find(text) != std::string::npos; }

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

// Renames whole texts and attributes, and the ids of profiles and engines.
Edit renaming(Names const& names) {
    auto const renamed = [names](std::string const& text) -> std::string {
        for (std::string const begin : {"", "profile.", "engine."}) {
            if (!text.starts_with(begin)) continue;
            if (auto const found = names.find(text.substr(begin.size())); found != names.end()) return begin + found->second;
        }
        return text;
    };
    return [renamed](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (std::string const text = node.value(); !text.empty()) node.set_value(renamed(text).c_str());
            for (auto attribute : node.attributes()) attribute.set_value(renamed(attribute.value()).c_str());
        });
        for (auto attribute : root.attributes()) attribute.set_value(renamed(attribute.value()).c_str());
    };
}

// Maps old names to new ones. The reverse map also has capital letters: conditions may ignore the case.
Names reversed(Names const& names) {
    Names reverse;
    for (auto const& [before, after] : names) {
        reverse[after] = before;
        reverse[upper(after)] = upper(before);
    }
    return reverse;
}

std::regex expression_of(std::string const& pattern) {
    std::string expression;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (pattern[i] == '*') {
            expression += ".*";
        } else if (pattern[i] == '?') {
            expression += '.';
        } else {
            if (pattern[i] == '!') ++i;
            expression += "[" + pattern.substr(i, 1) + "]";
        }
    }
    return std::regex{expression};
}

// Replaces a pattern of new names by the list of matching names.
Edit listing_patterns(Names const& names) {
    return [names](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (std::string_view{node.name()} != "fes:PropertyIsLike") return;
            auto const pattern = expression_of(node.child("fes:Literal").text().get());
            auto either = node.parent().insert_child_before("fes:Or", node);
            auto const add = [&](std::string const& name) {
                auto one = either.append_child("fes:PropertyIsEqualTo");
                one.append_copy(node.child("fes:ValueReference"));
                one.append_child("fes:Literal").text().set(name.c_str());
            };
            for (auto const& [before, after] : names)
                if (std::regex_match(after, pattern)) add(after);
            add("no name");  // Or needs at least two operands
            add("no name");
            node.parent().remove_child(node);
        });
    };
}

void add_engine(pugi::xml_node parent, std::string const& name, std::vector<pugi::xml_node> const& engines) {
    auto engine = parent.insert_child_before("rois:SubProfile", engines.front());
    engine.append_attribute("gml:id") = ("engine." + name).c_str();
    auto identifier = engine.append_child("gml:identifier");
    identifier.append_attribute("codeSpace") = "urn:ietf:rfc:2141";
    identifier.text().set(("urn:x-rois:def:HRIEngine:Other::" + name).c_str());
    engine.append_child("gml:name").text().set(name.c_str());
    for (auto const& one : engines) engine.append_move(one);
}

void nest_engines(pugi::xml_node root) {
    auto const main = std::string_view{root.name()} == "rois:HRIEngineProfile" ? root : root.child("rois:HRIEngineProfile");
    std::vector<pugi::xml_node> robots;
    for (auto const robot : main.children("rois:SubProfile")) robots.push_back(robot);
    if (robots.size() < 2) return;
    add_engine(main, "building", robots);
    auto const building = main.child("rois:SubProfile");
    add_engine(building, "ground_floor", {building.child("rois:SubProfile")});
}

// Edits all answers, notifications, profiles and lists of notifications.
Breaking edits_all_documents(Edit const& edit) {
    return {.answer = [=](std::string const&, std::string const& answer, ProxiedConnection&) -> Documents {
                return {edited(answer, edit)};
            },
            .notification = [=](std::string const& notification) -> Documents { return {edited(notification, edit)}; },
            .http_reply =
                [=](Message const& request, Message& reply) {
                    if (asks_for_documents(request)) edit_body(reply, edit);
                }};
}

// Sorts the refs in an answer of search by their new names.
void sort(pugi::xml_node search_response, bool falling) {
    auto refs = search_response.child("component_ref_list");
    std::map<std::string, pugi::xml_node> by_name;
    for (auto const ref : refs.children()) by_name[ref.attribute("rois:code").value()] = ref;
    for (auto const& [name, ref] : by_name) falling ? refs.prepend_move(ref) : refs.append_move(ref);
}

Breaking has_names(Names const& names, Edit const& edit) {
    auto breaking = edits_all_documents(edit);
    auto const reverse = reversed(names);
    breaking.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        return {edited(answer, [&](pugi::xml_node root) {
            edit(root);
            if (is(request, "search") && has_text(request, "<fes:SortBy>")) sort(root, has_text(request, ">DESC<"));
        })};
    };
    // A request without any of the names is not changed, even if it is not valid XML.
    breaking.request = [=](std::string const& request) {
        bool const has_name = std::ranges::any_of(reverse, [&](auto const& name) { return has_text(request, name.first); });
        if (!has_name && !has_text(request, "PropertyIsLike")) return request;
        return edited(request, [&](pugi::xml_node root) {
            listing_patterns(names)(root);
            renaming(reverse)(root);
        });
    };
    breaking.http_request = [=](Message& request) {
        std::smatch parts;
        static std::regex const profile{"(GET /rois/profile/)([^ ]+)( .*\r\n)"};
        if (!std::regex_match(request.first_line, parts, profile)) return;
        auto const found = reverse.find(parts[2]);
        if (found != reverse.end()) request.first_line = parts[1].str() + found->second + parts[3].str();
    };
    return breaking;
}

}  // namespace

Breaking has_mandatory_parts_only() {
    auto breaking = edits_all_documents(remove_optional);
    breaking.instead = [](std::string const& request) -> Documents {
        if (is(request, "subscribe") && request.find(">reached_target<") != std::string::npos)
            return {response(request, "UNSUPPORTED", "<reason>no component has the event reached_target</reason>")};
        auto const part = optional_part_of(request);
        if (part.empty()) return {};
        return {response(request, "BAD_PARAMETER", "<reason>'" + part + "' is not supported</reason>")};
    };
    return breaking;
}

Names component_names(std::string const& prefix, std::string const& new_prefix) {
    Names names;
    for (auto const& [name, other] : other_component_names()) names[prefix + name] = new_prefix + name;
    return names;
}

Names other_component_names() {
    return {{"audio_streaming", "audible"},
            {"face_detection", "camera-1"},
            {"face_localization", "camera-2"},
            {"follow", "companion"},
            {"gesture_recognition", "deixis"},
            {"move", "dolly"},
            {"navigation", "drive_unit"},
            {"person_detection", "entry.counter"},
            {"person_identification", "friend.finder"},
            {"person_localization", "guest.tracker"},
            {"reaction", "manners"},
            {"sound_detection", "microphone1"},
            {"sound_localization", "microphone2"},
            {"speech_recognition", "microphone3"},
            {"speech_synthesis", "mouth"},
            {"system_information", "pilot_light"},
            {"video_streaming", "retina"}};
}

Breaking has_names(Names const& names) { return has_names(names, renaming(names)); }
Breaking has_other_ids() {
    static std::string const strange = "&amp;&lt;";
    static std::array<std::string, 4> const ids{"s-", "e-", "x-", "c-"};
    auto const renamed = [](std::string document) {
        for (auto const& id : ids)
            for (std::string const before : {">", "\""}) replace_all(document, before + id, before + strange + id);
        return document;
    };
    return {.request =
                [](std::string request) {
                    for (auto const& id : ids) replace_all(request, strange + id, id);
                    return request;
                },
            .answer = [=](std::string const&, std::string const& answer, ProxiedConnection&) -> Documents {
                return {renamed(answer)};
            },
            .notification = [=](std::string const& notification) -> Documents { return {renamed(notification)}; }};
}

Breaking has_nested_engines(Names const& names) {
    return has_names(names, [rename = renaming(names)](pugi::xml_node root) {
        nest_engines(root);
        rename(root);
    });
}

}  // namespace rois::broken
