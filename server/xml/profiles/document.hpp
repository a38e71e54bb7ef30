// Documents that are read from files: profiles, floor plans, scenarios. Documents are validated like messages. An Element then
// gives access to the content.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "types/messages.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::xml {

// An error in a file. The message is "name:line:column: reason".
class BadDocument : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// An attribute. The namespace of a name without prefix is empty. The names live as long as the document.
struct Attribute {
    std::string_view name_space;
    std::string_view name;  // local
    std::string value;
};

// An element of a document. Keeps the document alive. Cheap to copy. Names are local names. Validation has checked the
// namespaces; in a document without validation, the caller must check them.
class Element {
public:
    std::string_view name() const;
    std::string_view name_space() const;                         // empty: none
    std::vector<Attribute> attributes() const;                   // in order; without namespace declarations
    Place place() const;                                         // of its start tag
    std::vector<Element> children() const;                       // elements only, in order
    std::vector<Element> children(std::string_view name) const;  // all with this name
    std::optional<Element> child(std::string_view name) const;   // the first with this name
    std::optional<std::string> attribute(std::string_view name) const;
    std::string attribute(std::string_view name, std::string_view otherwise) const;
    // An attribute without white space at its ends.
    std::optional<std::string> token(std::string_view attribute) const;
    std::string token(std::string_view attribute, std::string_view otherwise) const;
    double number(std::string_view attribute) const;  // throws BadDocument if it is missing or not a number
    double number(std::string_view attribute, double otherwise) const;
    std::string_view type() const;  // the local name of its xsi:type; empty if it has none
    std::string text() const;       // all character data directly inside, untrimmed

    // Returns the texts, untrimmed, and the child elements, in order.
    std::vector<std::variant<std::string, Element>> content() const;

    // Returns an error with the place of this element.
    BadDocument complain(std::string_view reason) const;

private:
    friend class Document;
    struct Node;
    std::shared_ptr<Node const> node_;
};

class Document {
public:
    // `name` is the file's name for messages. Throws BadDocument if the text is not well-formed or not valid.
    static Document parse(std::shared_ptr<Schemas const>, std::string name, std::string text);

    // Checks that the text is well-formed, with namespaces, and within the limits of documents; uses no schema. Returns a fault
    // with a place otherwise.
    static std::variant<Document, Fault> read_well_formed(std::string text);

    Element root() const;

private:
    Element root_;
};

}  // namespace rois::xml
