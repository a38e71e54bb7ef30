#include "conformance/catalogue.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <string_view>

namespace rois::conformance {

namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

TypedName typed_name(pugi::xml_node node) {
    TypedName read{node.attribute("rois:name").value(), node.child("rois:data_type_ref").attribute("rois:code").value()};
    if (auto const written = node.attribute("rois:default_value")) read.default_value = written.value();
    return read;
}

std::vector<TypedName> typed_names(pugi::xml_node parent, char const* child) {
    std::vector<TypedName> names;
    for (auto const node : parent.children(child)) names.push_back(typed_name(node));
    return names;
}

void read_profile(Component& component, pugi::xml_node profile) {
    for (auto const message : profile.children("rois:MessageProfile")) {
        Message const read{message.attribute("rois:name").value(), typed_names(message, "rois:Results"),
                           typed_names(message, "rois:Arguments")};
        std::string_view const type = message.attribute("xsi:type").value();
        if (type.ends_with("CommandMessageProfileType")) component.commands.push_back(read);
        if (type.ends_with("QueryMessageProfileType")) component.queries.push_back(read);
        if (type.ends_with("EventMessageProfileType")) component.events.push_back(read);
    }
    component.parameters = typed_names(profile, "rois:ParameterProfile");
    for (auto const sub : profile.children("rois:SubComponentProfile")) {
        if (!lower(sub.text().get()).ends_with("::roiscommon")) continue;
        component.is_common = true;
        if (!component.query("component_status"))
            component.queries.push_back({"component_status", {{"status", "Component_Status", {}}}, {}});
    }
}

struct ReadType {
    std::string item;  // the last part of its URN, in lower case; of a number or a bool the shortest of its names
    bool is_list;
};

// "int", "urn:x-rois:def:DataType:ATR::Integer[]", "Set<Integer>".
ReadType read_type(std::string const& type) {
    static std::regex const list{"\\s*(?:(?:set|list|sequence|seq)\\s*<\\s*(.+?)\\s*>|(.*?)\\s*\\[\\])\\s*"};
    static std::map<std::string, std::string> const shorter{
        {"integer", "int"}, {"unlimitednatural", "int"}, {"real", "double"}, {"float", "double"}, {"boolean", "bool"}};
    auto name = lower(type);
    std::smatch parts;
    bool const is_list = std::regex_match(name, parts, list);
    if (is_list) name = std::string{parts[1].matched ? parts[1] : parts[2]};
    auto item = name.substr(name.find_last_of(":#/") + 1);
    auto const found = shorter.find(item);
    return {found == shorter.end() ? item : found->second, is_list};
}

bool is_item(std::string const& type, std::string const& text) {
    constexpr std::size_t longest = 100;  // of a number or a time; regular expressions recurse
    if (text.size() > longest) return type == "string" || type == "roisidentifier";
    static std::regex const whole_number{"[+-]?[0-9]{1,10}"};
    static std::regex const number{"[+-]?([0-9]+([.][0-9]*)?|[.][0-9]+)([eE][+-]?[0-9]+)?|[+-]?INF|NaN"};
    static std::regex const truth{"true|false|0|1"};
    static std::regex const time{"[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}([.][0-9]+)?Z"};
    static std::regex const status{"UNINITIALIZED|READY|BUSY|WARNING|ERROR"};
    static std::regex const stream_status{"STREAMING_(NOT_RUNNING|NOT_CONNECTED|RUNNING|SUSPENDED|RESUMED)"};
    if (type == "int") return std::regex_match(text, whole_number);
    if (type == "double") return std::regex_match(text, number);
    if (type == "bool") return std::regex_match(text, truth);
    if (type == "datetime") return std::regex_match(text, time);
    if (type == "component_status") return std::regex_match(text, status);
    if (type == "stream_status") return std::regex_match(text, stream_status);
    return type != "roisidentifier" || !text.empty();
}

}  // namespace

std::string Component::basic() const {
    auto const type_name = lower(type);
    auto const mark = type_name.find(":component:omg::");
    return mark == std::string::npos ? "" : type_name.substr(mark + std::string_view{":component:omg::"}.size());
}

Message const* Component::query(std::string const& name) const {
    auto const found = std::ranges::find(queries, name, &Message::name);
    return found == queries.end() ? nullptr : &*found;
}

Message const* Component::event(std::string const& name) const {
    auto const found = std::ranges::find(events, name, &Message::name);
    return found == events.end() ? nullptr : &*found;
}

bool Component::parameter(std::string const& name) const {
    auto const is_named = [&](TypedName const& one) { return lower(one.name) == lower(name); };
    auto const* const read = query("get_parameter");
    return std::ranges::any_of(parameters, is_named) || (read && std::ranges::any_of(read->results, is_named));
}

std::string Component::detection() const {
    auto const kind = basic();
    return kind.substr(0, kind.find("detection")) + "_detected";
}

Catalogue Catalogue::read(client::Document const& answer) {
    Catalogue catalogue;
    auto const root = answer.root();
    catalogue.engine = root.child("rois:HRIEngineProfile").child("gml:name").text().get();
    for (auto const node : root.child("components").children("component")) {
        Component component;
        component.ref = node.attribute("ref").value();
        component.type = node.attribute("type").value();
        component.engine = node.attribute("engine").value();
        auto const id = "profile." + component.ref;
        read_profile(component, root.find_child_by_attribute("rois:HRIComponentProfile", "gml:id", id.c_str()));
        catalogue.components.push_back(std::move(component));
    }
    std::ranges::sort(catalogue.components, {}, &Component::ref);
    return catalogue;
}

Component const* Catalogue::find(std::string const& ref) const {
    auto const found = std::ranges::find(components, ref, &Component::ref);
    return found == components.end() ? nullptr : &*found;
}

bool is_of_type(std::string const& type, std::vector<std::string> const& values) {
    auto const [item, is_list] = read_type(type);
    if (!is_list) return values.size() == 1 && is_item(item, values.front());
    if (item != "int" && item != "double" && item != "bool")
        return std::ranges::all_of(values, [&item = item](auto const& value) { return is_item(item, value); });
    for (auto const& value : values) {
        static std::regex const space{"\\s+"};
        for (std::sregex_token_iterator word{value.begin(), value.end(), space, -1}, end; word != end; ++word)
            if (word->length() > 0 && !is_item(item, *word)) return false;
    }
    return true;
}

}  // namespace rois::conformance
