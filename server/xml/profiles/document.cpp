#include "xml/profiles/document.hpp"

#include <utility>

#include "types/text/texts.hpp"
#include "xml/codec/names.hpp"
#include "xml/codec/tree.hpp"
#include "xml/validation/checked_reader.hpp"

namespace rois::xml {

namespace {

std::string at(std::string const& name, Fault const& fault) {
    auto const place = fault.place.value_or(Place{});
    return name + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": " + fault.reason;
}

// The text of a file and its tree. Its elements keep it alive.
struct Opened {
    Opened(std::string its_name, std::string its_text, std::shared_ptr<Schemas const> schemas)
        : name{std::move(its_name)},
          text{std::move(its_text)},
          reader{std::move(schemas), DocumentLimits{}, {}, ForeignNamespaces::as_the_schemas_say} {}

    std::string name;
    std::string text;
    CheckedReader reader;
};

}  // namespace

struct Element::Node {
    std::shared_ptr<Opened const> document;
    pugi::xml_node node;
};

std::string_view Element::name() const { return local_name(node_->node); }

std::string_view Element::name_space() const { return namespace_of(node_->node, prefix_of(node_->node.name())); }

std::vector<Attribute> Element::attributes() const {
    std::vector<Attribute> all;
    for (auto const each : node_->node.attributes()) {
        std::string_view const full = each.name();
        if (declares_namespace(full)) continue;
        auto const prefix = prefix_of(full);
        auto const name_space = prefix.empty() ? std::string_view{} : namespace_of(node_->node, prefix);
        all.push_back({name_space, local_part(full), each.value()});
    }
    return all;
}

Place Element::place() const { return node_->document->reader.place(node_->node); }

std::vector<Element> Element::children() const {
    std::vector<Element> elements;
    for (auto const each : node_->node.children()) {
        if (each.type() != pugi::node_element) continue;
        elements.emplace_back().node_ = std::make_shared<Node const>(Node{node_->document, each});
    }
    return elements;
}

std::vector<Element> Element::children(std::string_view name) const {
    auto elements = children();
    std::erase_if(elements, [&](Element const& each) { return each.name() != name; });
    return elements;
}

std::optional<Element> Element::child(std::string_view name) const {
    for (auto& each : children()) {
        if (each.name() == name) return each;
    }
    return std::nullopt;
}

std::optional<std::string> Element::attribute(std::string_view name) const {
    auto const found = xml::attribute(node_->node, name);
    return found ? std::optional<std::string>{found.value()} : std::nullopt;
}

std::string Element::attribute(std::string_view name, std::string_view otherwise) const {
    return attribute(name).value_or(std::string{otherwise});
}

std::optional<std::string> Element::token(std::string_view name) const {
    auto text = attribute(name);
    if (text) text = std::string{trimmed(*text)};
    return text;
}

std::string Element::token(std::string_view name, std::string_view otherwise) const {
    return token(name).value_or(std::string{otherwise});
}

double Element::number(std::string_view name) const {
    auto const text = attribute(name);
    if (!text) throw complain("attribute " + quoted(name) + " is missing");
    auto const number = to_double(*text);
    if (!number) throw complain("attribute " + quoted(name) + " is " + quoted(*text) + ": expected a number");
    return *number;
}

double Element::number(std::string_view name, double otherwise) const { return attribute(name) ? number(name) : otherwise; }

std::string_view Element::type() const {
    auto const type = xsi_type(node_->node);
    return type ? type->local_name : std::string_view{};
}

std::string Element::text() const { return text_of(node_->node); }

std::vector<std::variant<std::string, Element>> Element::content() const {
    std::vector<std::variant<std::string, Element>> parts;
    for (auto const each : node_->node.children()) {
        if (each.type() == pugi::node_element) {
            Element element;
            element.node_ = std::make_shared<Node const>(Node{node_->document, each});
            parts.emplace_back(std::move(element));
        } else if (each.type() == pugi::node_pcdata || each.type() == pugi::node_cdata) {
            parts.emplace_back(std::string{each.value()});
        }
    }
    return parts;
}

BadDocument Element::complain(std::string_view reason) const {
    auto const& document = *node_->document;
    auto const fault = document.reader.complain(node_->node, std::string{reason});
    return BadDocument{at(document.name, fault)};
}

Document Document::parse(std::shared_ptr<Schemas const> schemas, std::string name, std::string text) {
    auto opened = std::make_shared<Opened>(std::move(name), std::move(text), std::move(schemas));
    if (auto const fault = opened->reader.read(opened->text)) {
        throw BadDocument{at(opened->name, *fault)};
    }
    Document document;
    document.root_.node_ = std::make_shared<Element::Node const>(Element::Node{opened, opened->reader.root()});
    return document;
}

std::variant<Document, Fault> Document::read_well_formed(std::string text) {
    auto opened = std::make_shared<Opened>(std::string{}, std::move(text), nullptr);
    if (auto fault = opened->reader.read(opened->text)) return *std::move(fault);
    Document document;
    document.root_.node_ = std::make_shared<Element::Node const>(Element::Node{opened, opened->reader.root()});
    return document;
}

Element Document::root() const { return root_; }

}  // namespace rois::xml
