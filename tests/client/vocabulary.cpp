#include "client/vocabulary.hpp"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "client/names.hpp"

namespace rois::client {

namespace {

std::string element(std::string const& name, std::string const& content) {
    return "<" + name + ">" + content + "</" + name + ">";
}

std::string reference(std::string const& path) { return element("fes:ValueReference", path); }

std::string literal(std::string const& text) { return element("fes:Literal", text); }

std::string typed(std::string const& type, std::string const& content) {
    return "<rois:command_unit_list xsi:type=\"rois:" + type + "\">" + content + "</rois:command_unit_list>";
}

// The type ParameterType under one of its names.
std::string parameter(std::string const& element, Argument const& argument) {
    std::string texts;
    for (auto const& value : argument.values) texts += "<rois:value>" + value + "</rois:value>";
    return "<" + element + " rois:name=\"" + argument.name + "\"><rois:data_type_ref rois:code=\"" + argument.type + "\"/>" +
           texts + "</" + element + ">";
}

std::string message(std::string const& element, Command const& command) {
    auto const delay = command.delay ? " rois:delay_time=\"" + std::to_string(*command.delay) + "\"" : "";
    std::string arguments;
    for (auto const& argument : command.arguments) arguments += parameter("rois:parameter", argument);
    if (!arguments.empty()) arguments = "<rois:arguments>" + arguments + "</rois:arguments>";
    return "<rois:" + element + " xsi:type=\"rois:CommandMessageType\" rois:command_type=\"" + command.type +
           "\" rois:command_id=\"" + command.id + "\"" + delay + "><rois:component_ref rois:code=\"" + command.component +
           "\"/>" + arguments + "</rois:" + element + ">";
}

void collect_ids(pugi::xml_node node, std::vector<std::string>& ids) {
    if (auto const id = node.attribute("rois:command_id")) ids.emplace_back(id.value());
    for (auto const child : node.children()) collect_ids(child, ids);
}

}  // namespace

Document::Document(std::string const& text)
    : text_{std::make_shared<std::string const>(text)}, document_{std::make_shared<pugi::xml_document>()} {
    if (!document_->load_buffer(text.data(), text.size())) throw std::runtime_error{"no XML document: " + text};
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

std::string equal(std::string const& path, std::string const& text) {
    return element("fes:PropertyIsEqualTo", reference(path) + literal(text));
}

std::string literal_first(std::string const& text, std::string const& path) {
    return element("fes:PropertyIsEqualTo", literal(text) + reference(path));
}

std::string both(std::string const& one, std::string const& other) { return element("fes:And", one + other); }

std::string either(std::string const& one, std::string const& other) { return element("fes:Or", one + other); }

std::string like(std::string const& path, std::string const& pattern) {
    return "<fes:PropertyIsLike wildCard=\"*\" singleChar=\"?\" escapeChar=\"!\">" + reference(path) + literal(pattern) +
           "</fes:PropertyIsLike>";
}

std::string compared(std::string const& comparison, std::string const& path, std::string const& text) {
    return element("fes:PropertyIs" + comparison, reference(path) + literal(text));
}

std::string is_null(std::string const& path) { return element("fes:PropertyIsNull", reference(path)); }

std::string contrary(std::string const& filter) { return element("fes:Not", filter); }

std::string related(std::string const& relation, std::string const& path, std::string const& other) {
    return element("fes:" + relation, reference(path) + other);
}

std::string box(std::string const& lower, std::string const& upper, std::string const& frame) {
    auto const name = frame.empty() ? "" : " srsName=\"" + frame + "\"";
    return "<gml:Envelope xmlns:gml=\"http://www.opengis.net/gml/3.2\"" + name + ">" + element("gml:lowerCorner", lower) +
           element("gml:upperCorner", upper) + "</gml:Envelope>";
}

std::string place(std::string const& name) { return literal(name); }

std::string distance(std::string const& millimetres) { return "<fes:Distance uom=\"mm\">" + millimetres + "</fes:Distance>"; }

std::string touching(std::string const& path) { return related("Touches", path, place("desk")); }

std::string nearest(std::string const& name) {
    return "<fes:SortBy><fes:SortProperty><fes:Function name=\"distance\">" + reference("location") + place(name) +
           "</fes:Function></fes:SortProperty></fes:SortBy>";
}

std::string sorted_by(std::string const& path, std::string const& order) {
    return "<fes:SortBy><fes:SortProperty>" + reference(path) + element("fes:SortOrder", order) +
           "</fes:SortProperty></fes:SortBy>";
}

std::string ordered(std::string const& filter, std::string const& sort_by) {
    auto const whole = filter.empty() ? "" : element("fes:Filter", filter);
    return "<condition xmlns:fes=\"http://www.opengis.net/fes/2.0\">" + whole + sort_by + "</condition>";
}

std::string where(std::string const& filter) { return ordered(filter, ""); }

std::vector<std::string> escaped(std::vector<std::string> texts) {
    for (auto& text : texts) {
        std::string written;
        for (char const c : text) {
            if (c == '&') {
                written += "&amp;";
            } else if (c == '<') {
                written += "&lt;";
            } else {
                written += c;
            }
        }
        text = std::move(written);
    }
    return texts;
}

Argument speech_text(std::string const& text) { return {"speech_text", "string", {text}}; }

Argument target_position(std::vector<std::string> const& positions) { return {"target_position", "string[]", positions}; }

Argument time_limit(std::string const& milliseconds) { return {"time_limit", "int", {milliseconds}}; }

std::string parameters(std::vector<Argument> const& arguments) {
    std::string list;
    for (auto const& argument : arguments) list += parameter("parameter", argument);
    return element("parameters", list);
}

std::string unit(Command const& command) { return message("command_unit_list", command); }

std::string pause(int delay) { return "<rois:command_unit_list rois:delay_time=\"" + std::to_string(delay) + "\"/>"; }

std::string branch(std::vector<Command> const& commands) {
    std::string list;
    for (auto const& command : commands) list += command_list(command);
    return element("rois:branch_list", list);
}

std::string command_list(Command const& command) { return message("command_list", command); }

std::string concurrent(std::string const& branches) { return typed("ConcurrentCommandsType", branches); }

std::string one_after_another(std::string const& units) { return typed("SequentialCommandUnitType", units); }

std::string side_by_side(std::string const& units) { return typed("ParallelCommandUnitType", units); }

std::string sequence(std::string const& units) {
    return "<rois:CommandUnitSequence xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">" + units +
           "</rois:CommandUnitSequence>";
}

std::vector<std::string> command_ids(Document const& answer) {
    std::vector<std::string> ids;
    collect_ids(answer.root(), ids);
    return ids;
}

}  // namespace rois::client
