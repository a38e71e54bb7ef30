#include <xercesc/util/XMLChar.hpp>

#include "types/text/texts.hpp"
#include "xml/codec/codec.hpp"
#include "xml/codec/encoding.hpp"
#include "xml/codec/names.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

void write_object(Writer& out, IdentifiedObject const& object, std::string_view gml_id) {
    out.attribute("gml:id", gml_id);
    if (!object.meta_data.empty())
        out.start("gml:metaDataProperty")
            .constant("xmlns:xlink", xlink_namespace)
            .attribute("xlink:href", object.meta_data)
            .end();
    if (!object.description.empty()) out.element("gml:description", object.description);
    out.start("gml:identifier").attribute("codeSpace", object.code_space).text(object.identifier).end();
    if (!object.name.empty()) out.element("gml:name", object.name);
}

void write_parameter(Writer& out, std::string_view element, ParameterProfile const& parameter) {
    out.start(element).attribute("rois:name", parameter.name);
    if (parameter.default_value) out.attribute("rois:default_value", *parameter.default_value);
    out.attribute_unless_empty("rois:description", parameter.description);
    write_identifier(out, "rois:data_type_ref", parameter.data_type_ref);
    out.end();
}

void write_parameters(Writer& out, std::vector<ParameterProfile> const& parameters) {
    for (auto const& parameter : parameters) write_parameter(out, "rois:ParameterProfile", parameter);
}

constexpr std::string_view type_of(MessageKind kind) {
    switch (kind) {
        case MessageKind::command:
            return "rois:CommandMessageProfileType";
        case MessageKind::query:
            return "rois:QueryMessageProfileType";
        case MessageKind::event:
            break;
    }
    return "rois:EventMessageProfileType";
}

void write_message(Writer& out, MessageProfile const& message) {
    out.start("rois:MessageProfile").attribute("xsi:type", type_of(message.kind)).attribute("rois:name", message.name);
    bool const command = message.kind == MessageKind::command;
    if (command && message.timeout) out.attribute("rois:timeout", std::string_view{std::to_string(message.timeout->count())});
    for (auto const& result : message.results) write_parameter(out, "rois:Results", result);
    if (command) {
        for (auto const& argument : message.arguments) write_parameter(out, "rois:Arguments", argument);
    }
    out.end();
}

void write_content(Writer& out, EngineProfile const& profile, std::string_view gml_id) {
    write_object(out, profile.object, gml_id);
    for (auto const& sub : profile.sub_profiles) {
        out.start("rois:SubProfile");
        write_content(out, sub, nc_name("engine." + sub.object.name));
        out.end();
    }
    for (auto const& component : profile.components) out.element("rois:HRIComponent", component);
    write_parameters(out, profile.parameters);
}

template <class Profile>
std::string document_of(Profile const& profile, std::string_view gml_id) {
    Writer out;
    write_profile(out, profile, gml_id);
    return std::string{declaration}.append(std::move(out).written()) + '\n';
}

constexpr std::string_view digits = "0123456789ABCDEF";

// Returns whether the text begins with "_x" and two hexadecimal digits, so that it looks like an escaped character.
bool looks_escaped(std::string_view text) {
    return text.starts_with("_x") && text.size() >= 4 && digits.find(text[2]) != digits.npos &&
           digits.find(text[3]) != digits.npos;
}

bool is_name_character(char32_t c, bool first) {
    if (c > 0xFFFF) return false;
    auto const unit = static_cast<XMLCh>(c);
    return first ? xercesc::XMLChar1_0::isFirstNCNameChar(unit) : xercesc::XMLChar1_0::isNCNameChar(unit);
}

}  // namespace

bool is_nc_name(std::string_view text) {
    if (text.empty()) return false;
    for (bool first = true; !text.empty(); first = false) {
        auto const character = take_character(text);
        if (!character || !is_name_character(*character, first)) return false;
    }
    return true;
}

std::string nc_name(std::string_view text) {
    std::string name;
    while (!text.empty()) {
        auto const rest = text;
        auto const character = *take_character(text);
        auto const bytes = rest.substr(0, rest.size() - text.size());
        if (is_name_character(character, name.empty()) && !looks_escaped(rest)) {
            name += bytes;
            continue;
        }
        for (char const c : bytes) {
            auto const byte = static_cast<unsigned char>(c);
            ((name += "_x") += digits[byte >> 4]) += digits[byte & 15];
            name += '_';
        }
    }
    return name.empty() ? "_" : name;
}

// A profile declares its own prefixes, so that clients can use it as a document of its own.
void write_profile(Writer& out, EngineProfile const& profile, std::string_view gml_id) {
    out.start("rois:HRIEngineProfile");
    declare_rois(out);
    declare_gml(out);
    write_content(out, profile, nc_name(gml_id));
    out.end();
}

void write_profile(Writer& out, ComponentProfile const& profile, std::string_view gml_id) {
    out.start("rois:HRIComponentProfile");
    declare_rois(out);
    declare_gml(out);
    declare_xsi(out);
    write_object(out, profile.object, nc_name(gml_id));
    for (auto const& sub : profile.sub_components) out.element("rois:SubComponentProfile", sub);
    for (auto const& message : profile.messages) write_message(out, message);
    write_parameters(out, profile.parameters);
    out.end();
}

std::string encode(EngineProfile const& profile, std::string_view gml_id) { return document_of(profile, gml_id); }

std::string encode(ComponentProfile const& profile, std::string_view gml_id) { return document_of(profile, gml_id); }

}  // namespace rois::xml
