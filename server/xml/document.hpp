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

#include "types/messages.hpp"
#include "xml/schemas.hpp"

namespace rois::xml {

// What is wrong with a file, as "name:line:column: reason".
class BadDocument : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// An attribute as it stands, of its namespace; that of a name without prefix is empty. The names live as long as the document.
struct Attribute {
    std::string_view name_space;
    std::string_view name;  // local
    std::string value;
};

// An element of a document, which it keeps alive. Cheap to copy. Names are local names; namespaces were checked by validation,
// or, where nothing was validated, are the caller's to look at.
class Element {
public:
    std::string_view name() const;
    std::string_view name_space() const;                         // empty: none
    std::vector<Attribute> attributes() const;                   // in order; without declarations of namespaces
    Place place() const;                                         // of its start tag
    std::vector<Element> children() const;                       // elements only, in order
    std::vector<Element> children(std::string_view name) const;  // those of that name
    std::optional<Element> child(std::string_view name) const;   // the first of that name
    std::optional<std::string> attribute(std::string_view name) const;
    std::string attribute(std::string_view name, std::string_view otherwise) const;
    // As a token of XML Schema: without white space at its ends.
    std::optional<std::string> token(std::string_view attribute) const;
    std::string token(std::string_view attribute, std::string_view otherwise) const;
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

// A document that was read.
class Document {
public:
    // `name` is the file's name for messages. Throws BadDocument when it is not well-formed or not valid.
    static Document parse(std::shared_ptr<Schemas const>, std::string name, std::string text);

    // One that is well-formed, with namespaces, and within the limits of documents; no schema is asked. The fault says what is
    // wrong and where.
    static std::variant<Document, Fault> read_well_formed(std::string text);

    Element root() const;

private:
    Element root_;
};

}  // namespace rois::xml
