#include "kit/vocabulary.hpp"

#include <sstream>
#include <stdexcept>

#include "kit/names.hpp"

namespace rois::kit {

namespace {

Xml reference(std::string const& path) { return text_element("fes:ValueReference", path); }

Xml literal(std::string const& text) { return text_element("fes:Literal", text); }

Xml typed(std::string const& type, Xml const& content) {
    return element("rois:command_unit_list", {{"xsi:type", "rois:" + type}}, content);
}

// Returns the type ParameterType under one of its names.
Xml parameter(std::string_view name, Argument const& argument) {
    auto content = element("rois:data_type_ref", {{"rois:code", argument.type}});
    for (auto const& value : argument.values) content += text_element("rois:value", value);
    return element(name, {{"rois:name", argument.name}}, content);
}

Xml message(std::string_view name, Command const& command) {
    Attributes attributes{
        {"xsi:type", "rois:CommandMessageType"}, {"rois:command_type", command.type}, {"rois:command_id", command.id}};
    if (command.delay) attributes.emplace_back("rois:delay_time", std::to_string(*command.delay));
    auto content = element("rois:component_ref", {{"rois:code", command.component}});
    Xml arguments;
    for (auto const& argument : command.arguments) arguments += parameter("rois:parameter", argument);
    if (!arguments.empty()) content += element("rois:arguments", arguments);
    return element(name, attributes, content);
}

void collect_ids(pugi::xml_node node, std::vector<std::string>& ids) {
    if (auto const id = node.attribute("rois:command_id")) ids.emplace_back(id.value());
    for (auto const child : node.children()) collect_ids(child, ids);
}

}  // namespace

Document::Document(std::string const& text)
    : text_{std::make_shared<std::string const>(text)}, document_{std::make_shared<pugi::xml_document>()} {
    if (!document_->load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_ws_pcdata_single))
        throw std::runtime_error{"not an XML document: " + text};
    give_known_prefixes(*document_);
}

std::vector<std::string> Document::children() const {
    std::vector<std::string> names;
    for (auto const child : root().children()) names.emplace_back(child.name());
    return names;
}

Values Document::values(char const* list) const {
    Values values;
    for (auto const one : root().child(list).children()) {
        auto const name = one.attribute("rois:name");
        if (!name) continue;
        auto& texts = values[name.value()];
        for (auto const value : one.children("rois:value")) texts.emplace_back(value.text().get());
    }
    return values;
}

std::string Document::whole() const {
    std::ostringstream text;
    document_->save(text, "", pugi::format_raw | pugi::format_no_declaration);
    return text.str();
}

Xml equal(std::string const& path, std::string const& text) {
    return element("fes:PropertyIsEqualTo", reference(path) + literal(text));
}

Xml literal_first(std::string const& text, std::string const& path) {
    return element("fes:PropertyIsEqualTo", literal(text) + reference(path));
}

Xml both(Xml const& one, Xml const& other) { return element("fes:And", one + other); }

Xml either(Xml const& one, Xml const& other) { return element("fes:Or", one + other); }

Xml like(std::string const& path, std::string const& pattern) {
    return element("fes:PropertyIsLike", {{"wildCard", "*"}, {"singleChar", "?"}, {"escapeChar", "!"}},
                   reference(path) + literal(pattern));
}

Xml compared(std::string const& comparison, std::string const& path, std::string const& text) {
    return element("fes:PropertyIs" + comparison, reference(path) + literal(text));
}

Xml between(std::string const& path, std::string const& lower, std::string const& upper) {
    return element("fes:PropertyIsBetween",
                   reference(path) + element("fes:LowerBoundary", literal(lower)) + element("fes:UpperBoundary", literal(upper)));
}

Xml is_null(std::string const& path) { return element("fes:PropertyIsNull", reference(path)); }

Xml negation(Xml const& filter) { return element("fes:Not", filter); }

Xml related(std::string const& relation, std::string const& path, Xml const& other) {
    return element("fes:" + relation, reference(path) + other);
}

Xml box(std::string const& lower, std::string const& upper, std::string const& frame) {
    Attributes attributes{{"xmlns:gml", "http://www.opengis.net/gml/3.2"}};
    if (!frame.empty()) attributes.emplace_back("srsName", frame);
    return element("gml:Envelope", attributes, text_element("gml:lowerCorner", lower) + text_element("gml:upperCorner", upper));
}

Xml place(std::string const& name) { return literal(name); }

Xml distance(std::string const& length, std::string const& unit) {
    return element("fes:Distance", {{"uom", unit}}, characters(length));
}

Xml undefined_function(std::string const& path) { return element("fes:Function", {{"name", "is_free"}}, reference(path)); }

Xml nearest(std::string const& name) {
    auto const far = element("fes:Function", {{"name", "distance"}}, reference("location") + place(name));
    return element("fes:SortBy", element("fes:SortProperty", far));
}

Xml sorted_by(std::string const& path, std::string const& order) {
    return element("fes:SortBy", element("fes:SortProperty", reference(path) + text_element("fes:SortOrder", order)));
}

Xml ordered(Xml const& filter, Xml const& sort_by) {
    auto const whole = filter.empty() ? Xml{} : element("fes:Filter", filter);
    return element("condition", {{"xmlns:fes", "http://www.opengis.net/fes/2.0"}}, whole + sort_by);
}

Xml where(Xml const& filter) { return ordered(filter, {}); }

Xml of_type(std::string const& type) {
    return element("condition", element("unr:SearchCondition", {{"xmlns:unr", "http://www.irc.atr.jp/std/unr/0.1"}},
                                        element("unr:ComponentCondition", {{"type", type}})));
}

Argument speech_text(std::string const& text) { return {"speech_text", "string", {text}}; }

Argument target_position(std::vector<std::string> const& positions) { return {"target_position", "string[]", positions}; }

Argument time_limit(std::string const& milliseconds) { return {"time_limit", "int", {milliseconds}}; }

Xml parameters(std::vector<Argument> const& arguments) {
    Xml list;
    for (auto const& argument : arguments) list += parameter("parameter", argument);
    return element("parameters", list);
}

Xml unit(Command const& command) { return message("rois:command_unit_list", command); }

Xml pause(int delay) { return element("rois:command_unit_list", {{"rois:delay_time", std::to_string(delay)}}); }

Xml branch(std::vector<Command> const& commands) {
    Xml list;
    for (auto const& command : commands) list += command_list(command);
    return element("rois:branch_list", list);
}

Xml command_list(Command const& command) { return message("rois:command_list", command); }

Xml concurrent(Xml const& branches) { return typed("ConcurrentCommandsType", branches); }

Xml sequential_unit(Xml const& units) { return typed("SequentialCommandUnitType", units); }

Xml parallel_unit(Xml const& units) { return typed("ParallelCommandUnitType", units); }

Xml sequence(Xml const& units) {
    return element("rois:CommandUnitSequence", {{"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"}}, units);
}

std::vector<std::string> command_ids(Document const& answer) {
    std::vector<std::string> ids;
    collect_ids(answer.root(), ids);
    return ids;
}

}  // namespace rois::kit
