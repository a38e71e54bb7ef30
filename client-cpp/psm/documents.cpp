#include "psm/documents.hpp"

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "types/text/texts.hpp"
#include "xml/codec/names.hpp"
#include "xml/codec/writer.hpp"

namespace rois::psm {

namespace {

constexpr std::string_view place = "the application's XML";

void declare_prefixes(xml::Writer& out) {
    out.constant("xmlns", xml::message_namespace).constant("xmlns:rois", xml::rois_namespace);
    out.constant("xmlns:fes", xml::fes_namespace).constant("xmlns:gml", xml::gml_namespace);
    out.constant("xmlns:unr", xml::unr_namespace).constant("xmlns:xsi", xml::xsi_namespace);
}

// Removes an XML declaration: it is not allowed inside a document.
std::string_view without_declaration(std::string_view xml) {
    xml = trimmed(xml);
    if (!xml.starts_with("<?xml ")) return xml;
    auto const end = xml.find("?>");
    return end == xml.npos ? xml : xml.substr(end + 2);
}

// Puts the application's XML in place of the text `place`, the last text of the document.
std::string filled(std::string document, std::string_view xml) {
    return document.replace(document.rfind(place), place.size(), xml);
}

}  // namespace

std::string request_with_condition(std::string_view operation, std::vector<Child> const& children, std::string_view condition) {
    bool const restricts = !trimmed(condition).empty();
    xml::Writer out;
    out.start(operation);
    declare_prefixes(out);
    if (operation == "subscribe") out.constant("inline_results", "true");
    for (auto const& [name, text] : children) out.element(name, text);
    if (restricts) out.element("condition", place);
    out.end();
    auto document = std::move(out).written();
    return restricts ? filled(std::move(document), without_declaration(condition)) : document;
}

std::string request_with_sequence(std::string_view sequence) {
    xml::Writer out;
    out.start("execute");
    declare_prefixes(out);
    out.text(place).end();
    return filled(std::move(out).written(), without_declaration(sequence));
}

std::optional<std::string> problem_with(std::string_view xml) {
    xml = without_declaration(xml);
    pugi::xml_document document;
    auto const parsed =
        document.load_buffer(xml.data(), xml.size(), pugi::parse_full | pugi::parse_fragment, pugi::encoding_utf8);
    if (!parsed) {
        auto const before =
            xml.substr(0, std::min(xml.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0))));
        auto const line = 1 + std::ranges::count(before, '\n');
        return "the XML is not well-formed in line " + std::to_string(line) + ": " + parsed.description();
    }
    for (auto const& node : document.children()) {
        if (node.type() != pugi::node_element && node.type() != pugi::node_comment)
            return "an XML text must consist of elements: no document type, no processing instructions and no text beside them";
    }
    return std::nullopt;
}

std::string engine_profile_in(std::string const& response) {
    pugi::xml_document whole;
    whole.load_buffer(response.data(), response.size(), pugi::parse_default, pugi::encoding_utf8);
    auto const root = whole.document_element();
    auto const found = root.find_child([](pugi::xml_node each) { return xml::local_part(each.name()) == "HRIEngineProfile"; });
    if (!found) return {};
    pugi::xml_document document;
    auto profile = document.append_copy(found);
    for (auto const& attribute : root.attributes()) {
        bool const declares_prefix = std::string_view{attribute.name()}.starts_with("xmlns:");
        if (declares_prefix && !profile.attribute(attribute.name())) profile.prepend_copy(attribute);
    }
    std::ostringstream text;
    document.save(text, "  ", pugi::format_indent, pugi::encoding_utf8);
    return text.str();
}

}  // namespace rois::psm
