#include "conformance/catalogue.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>
#include <sstream>
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

std::vector<std::string> const common_commands{"start", "stop", "suspend", "resume"};

// Returns whether this is a common command that the profile redefines with mandatory arguments: no check can execute it.
bool needs_arguments(Message const& command) {
    return std::ranges::find(common_commands, command.name) != common_commands.end() &&
           std::ranges::any_of(command.arguments, [](TypedName const& argument) { return !argument.default_value; });
}

// Decodes "_x3A_" at the beginning of a text. Returns nothing if the text begins with another character.
std::optional<char> escaped_byte(std::string_view text) {
    static constexpr std::string_view digits = "0123456789ABCDEF";
    if (text.size() < 5 || !text.starts_with("_x") || text[4] != '_') return {};
    auto const high = digits.find(text[2]), low = digits.find(text[3]);
    if (high == digits.npos || low == digits.npos) return {};
    return static_cast<char>(high << 4 | low);
}

template <typename Named>
Named const* find_named(std::vector<Named> const& all, std::string const& name) {
    auto const found = std::ranges::find_if(all, [&](Named const& one) { return lower(one.name) == lower(name); });
    return found == all.end() ? nullptr : &*found;
}

// Adds the entries with new names.
template <typename Named>
void add(std::vector<Named>& all, std::vector<Named> const& more) {
    for (auto const& one : more)
        if (!find_named(all, one.name)) all.push_back(one);
}

// Adds the messages and parameters of the profile and of the profiles in `answer` that it includes (SubComponentProfile).
void read_profile(Component& component, pugi::xml_node profile, pugi::xml_node answer, std::set<std::string>& read_urns) {
    for (auto const message : profile.children("rois:MessageProfile")) {
        Message const read{message.attribute("rois:name").value(), typed_names(message, "rois:Results"),
                           typed_names(message, "rois:Arguments")};
        std::string_view const type = message.attribute("xsi:type").value();
        if (type.ends_with("CommandMessageProfileType")) add(component.commands, {read});
        if (type.ends_with("QueryMessageProfileType")) add(component.queries, {read});
        if (type.ends_with("EventMessageProfileType")) add(component.events, {read});
    }
    add(component.parameters, typed_names(profile, "rois:ParameterProfile"));
    for (auto const sub : profile.children("rois:SubComponentProfile")) {
        auto const urn = lower(sub.text().get());
        if (!read_urns.insert(urn).second) continue;
        if (urn.ends_with("::roiscommon")) {
            component.has_common = true;
            add(component.queries, {{"component_status", {{"status", "Component_Status", {}}}, {}}});
        }
        for (auto const other : answer.children("rois:HRIComponentProfile")) {
            if (lower(other.child("gml:identifier").text().get()) != urn) continue;
            read_profile(component, other, answer, read_urns);
            break;
        }
    }
}

void read_profile(Component& component, pugi::xml_node answer) {
    std::set<std::string> read_urns{lower(component.type)};
    read_profile(component, profile_of(answer, component.ref), answer, read_urns);
    component.has_common = component.has_common ||
                           (component.query("component_status") && std::ranges::all_of(common_commands, [&](auto const& name) {
                                return find_named(component.commands, name) != nullptr;
                            }));
    component.is_common = component.has_common && std::ranges::none_of(component.commands, needs_arguments);
    // A component with a ParameterProfile has the query get_parameter, even if the profile does not list it.
    if (!component.parameters.empty() && !component.query("get_parameter"))
        component.queries.push_back({"get_parameter", component.parameters, {}});
    if (auto const* const set = find_named(component.commands, "set_parameter")) add(component.parameters, set->arguments);
}

// gml:name is optional: without it, the gml:id is "engine." and the name.
std::string name_of_engine(pugi::xml_node engine) {
    static constexpr std::string_view begin = "engine.";
    if (auto const name = engine.child("gml:name")) return name.text().get();
    auto const id = named_by(engine.attribute("gml:id").value());
    return id.starts_with(begin) ? id.substr(begin.size()) : id;
}

// Returns the refs of the components of this engine and of its sub engines.
std::set<std::string> read_engine(std::map<std::string, std::set<std::string>>& refs_by_engine, pugi::xml_node engine) {
    std::set<std::string> refs;
    for (auto const component : engine.children("rois:HRIComponent")) refs.insert(component.text().get());
    for (auto const sub : engine.children("rois:SubProfile")) refs.merge(read_engine(refs_by_engine, sub));
    refs_by_engine[name_of_engine(engine)].insert(refs.begin(), refs.end());
    return refs;
}

struct ReadType {
    std::string item;  // the last part of the URN in lower case; for numbers and bools the shortest synonym
    bool is_list;
};

// Reads a type such as "int", "urn:x-rois:def:DataType:ATR::Integer[]" or "Set<Integer>".
ReadType read_type(std::string const& type) {
    static std::regex const list{"\\s*(?:(?:set|list|sequence|seq)\\s*<\\s*(.+?)\\s*>|(.*?)\\s*\\[\\])\\s*"};
    static std::map<std::string, std::string> const shorter{
        {"integer", "int"}, {"unlimitednatural", "int"}, {"rois_identifier", "roisidentifier"},
        {"real", "double"}, {"float", "double"},         {"boolean", "bool"}};
    auto name = lower(type);
    std::smatch parts;
    bool const is_list = std::regex_match(name, parts, list);
    if (is_list) name = std::string{parts[1].matched ? parts[1] : parts[2]};
    auto item = name.substr(name.find_last_of(":#/") + 1);
    auto const found = shorter.find(item);
    return {found == shorter.end() ? item : found->second, is_list};
}

// Removes white space around a value. White space is significant in texts only (XML Schema, part 2: whiteSpace).
std::string_view collapsed(std::string_view text) {
    constexpr std::string_view space = " \t\r\n";
    auto const begin = text.find_first_not_of(space);
    return begin == text.npos ? std::string_view{} : text.substr(begin, text.find_last_not_of(space) + 1 - begin);
}

// Accepts an optional sign and any number of digits, in the range of 32 bits.
bool is_whole_number(std::string_view text) {
    constexpr std::size_t most = 10;  // digits of 32 bits
    bool const negative = text.starts_with('-');
    if (!text.empty() && (negative || text.front() == '+')) text.remove_prefix(1);
    if (text.empty() || text.find_first_not_of("0123456789") != text.npos) return false;
    text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
    if (text.size() > most) return false;
    auto const number = text.empty() ? 0 : std::stoll(std::string{text});
    return number <= 2'147'483'647LL + (negative ? 1 : 0);
}

bool is_item(std::string const& type, std::string const& written) {
    if (type == "roisidentifier") return !collapsed(written).empty();
    constexpr std::size_t longest = 100;  // of a number or a time: a long text would exhaust the stack of std::regex
    std::string const text{collapsed(written)};
    if (type == "int") return is_whole_number(text);
    static std::map<std::string, std::regex> const forms{
        {"double", std::regex{"[+-]?([0-9]+([.][0-9]*)?|[.][0-9]+)([eE][+-]?[0-9]+)?|[+-]?INF|NaN"}},
        {"bool", std::regex{"true|false|0|1"}},
        {"datetime", std::regex{"[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}([.][0-9]+)?Z"}},
        {"component_status", std::regex{"UNINITIALIZED|READY|BUSY|WARNING|ERROR"}},
        {"stream_status", std::regex{"STREAMING_(NOT_RUNNING|NOT_CONNECTED|RUNNING|SUSPENDED|RESUMED)"}}};
    auto const form = forms.find(type);
    if (form == forms.end()) return true;
    return text.size() > longest ? type == "double" : std::regex_match(text, form->second);
}

}  // namespace

std::string Component::basic() const {
    auto const type_name = lower(type);
    auto const mark = type_name.find(":component:omg::");
    return mark == std::string::npos ? "" : type_name.substr(mark + std::string_view{":component:omg::"}.size());
}

bool Component::is_function() const {
    auto const kind = basic();
    return kind.ends_with("detection") || kind.ends_with("localization") || kind == "personidentification" ||
           kind == "speechrecognition" || kind == "gesturerecognition";
}

Message const* Component::query(std::string const& name) const {
    auto const found = std::ranges::find(queries, name, &Message::name);
    return found == queries.end() ? nullptr : &*found;
}

Message const* Component::event(std::string const& name) const {
    auto const found = std::ranges::find(events, name, &Message::name);
    return found == events.end() ? nullptr : &*found;
}

TypedName const* Component::parameter_named(std::string const& name) const { return find_named(parameters, name); }

bool Component::parameter(std::string const& name) const {
    auto const* const read = query("get_parameter");
    return parameter_named(name) || (read && find_named(read->results, name));
}

bool Component::can_set(TypedName const& parameter) const {
    if (auto const* const set = find_named(commands, "set_parameter"); set && find_named(set->arguments, parameter.name))
        return true;
    static std::array<std::string, 3> const abilities{"available_", "recognizable_", "synthesizable_"};
    return std::ranges::none_of(abilities, [&](auto const& begin) { return lower(parameter.name).starts_with(begin); });
}

std::string Component::detection_event() const {
    auto const kind = basic();
    return kind.substr(0, kind.find("detection")) + "_detected";
}

std::string named_by(std::string_view gml_id) {
    std::string name;
    while (!gml_id.empty()) {
        auto const byte = escaped_byte(gml_id);
        name += byte.value_or(gml_id.front());
        gml_id.remove_prefix(byte ? 5 : 1);
    }
    return name;
}

pugi::xml_node profile_of(pugi::xml_node answer, std::string const& ref) {
    for (auto const profile : answer.children("rois:HRIComponentProfile"))
        if (named_by(profile.attribute("gml:id").value()) == "profile." + ref) return profile;
    return {};
}

Catalogue Catalogue::read(kit::Document const& answer) {
    Catalogue catalogue;
    auto const root = answer.root();
    catalogue.engine = name_of_engine(root.child("rois:HRIEngineProfile"));
    read_engine(catalogue.refs_by_engine, root.child("rois:HRIEngineProfile"));
    for (auto const node : root.child("components").children("component")) {
        Component component;
        component.ref = node.attribute("ref").value();
        component.type = node.attribute("type").value();
        component.engine = node.attribute("engine").value();
        read_profile(component, root);
        catalogue.components.push_back(std::move(component));
    }
    std::ranges::sort(catalogue.components, {}, &Component::ref);
    return catalogue;
}

Component const* Catalogue::find(std::string const& ref) const {
    auto const found = std::ranges::find(components, ref, &Component::ref);
    return found == components.end() ? nullptr : &*found;
}

bool is_same_type(std::string const& one, std::string const& other) {
    auto const first = read_type(one), second = read_type(other);
    return first.item == second.item && first.is_list == second.is_list;
}

bool is_list_of_texts(std::string const& type) {
    auto const [item, is_list] = read_type(type);
    return is_list && item != "int" && item != "double" && item != "bool";
}

bool is_of_type(std::string const& type, std::vector<std::string> const& values) {
    auto const [item, is_list] = read_type(type);
    if (!is_list) return values.size() == 1 && is_item(item, values.front());
    if (is_list_of_texts(type))
        return std::ranges::all_of(values, [&item = item](auto const& value) { return is_item(item, value); });
    for (auto const& value : values) {
        std::istringstream words{value};
        for (std::string word; words >> word;)
            if (!is_item(item, word)) return false;
    }
    return true;
}

}  // namespace rois::conformance
