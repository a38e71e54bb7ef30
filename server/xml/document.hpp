// Documents that are read from files at start: profiles, floor plans, scenarios. Validated like messages, then walked with a
// cursor.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "xml/schemas.hpp"

namespace rois::xml {

// What is wrong with a file, as "name:line:column: reason".
class BadDocument : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// An element of a document, which it keeps alive. Cheap to copy. Names are local names; namespaces were checked by validation.
class Element {
public:
    std::string_view name() const;
    std::vector<Element> children() const;                       // elements only, in order
    std::vector<Element> children(std::string_view name) const;  // those of that name
    std::optional<Element> child(std::string_view name) const;   // the first of that name
    std::optional<std::string> attribute(std::string_view name) const;
    std::string attribute(std::string_view name, std::string_view otherwise) const;
    double number(std::string_view attribute) const;  // BadDocument when it is missing or no number
    double number(std::string_view attribute, double otherwise) const;
    std::string_view type() const;  // the local name of its xsi:type; empty when it has none
    std::string text() const;       // all character data directly inside, untrimmed

    // What stands inside, in order: texts, untrimmed, and elements.
    std::vector<std::variant<std::string, Element>> content() const;

    // An error about this element: "name:line:column: reason".
    BadDocument complain(std::string_view reason) const;

private:
    friend class Document;
    struct Node;
    std::shared_ptr<Node const> node_;
};

// A validated document.
class Document {
public:
    // `name` is the file's name for messages. Throws BadDocument when it is not well-formed or not valid.
    static Document parse(std::shared_ptr<Schemas const>, std::string name, std::string text);

    Element root() const;

private:
    Element root_;
};

}  // namespace rois::xml
