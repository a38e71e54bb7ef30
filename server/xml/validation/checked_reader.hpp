// Checks that a document is well-formed and valid, and parses it into a tree.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>

#include "types/messages.hpp"
#include "xml/codec/codec.hpp"
#include "xml/codec/message_tree.hpp"
#include "xml/tables/acceptor.hpp"
#include "xml/validation/scan.hpp"
#include "xml/validation/validator.hpp"

namespace rois::xml {

// Whether a document may declare a namespace that no schema has: never, or where a schema has a wildcard.
enum class ForeignNamespaces : std::uint8_t { refused, as_the_schemas_say };

// Checks a document and parses the same bytes into a tree. If the acceptor does not accept a document, the scan and xerces-c
// decide. Keeps its parsers and buffers for the next document. Not thread-safe.
class CheckedReader {
public:
    // Without schemas it checks only that documents are well-formed. `roots`: the allowed root elements, which are listed in the
    // fault about any other root; empty: all roots that the schemas declare.
    CheckedReader(std::shared_ptr<Schemas const>, DocumentLimits, std::span<std::string_view const> roots = {},
                  ForeignNamespaces = ForeignNamespaces::refused, Validation = Validation::fast);

    // Returns why the document is rejected, or nothing. After success, root() and message() return its content until the next
    // read(); the document's bytes must live as long.
    std::optional<Fault> read(std::string_view document);
    pugi::xml_node root();
    MessageTree const& message();

    // How the last document was checked; empty if it was too large to be checked.
    std::optional<Validation> checked() const { return checked_; }

    // Returns a fault about an element of the last document.
    Fault complain(pugi::xml_node element, std::string reason) const;
    Place place(pugi::xml_node element) const;

private:
    void take_bytes();
    pugi::xml_parse_result parse();
    std::optional<Fault> check_in_full();
    std::optional<Fault> objection_to(Scanned const&);
    Fault refused(FaultCode, std::string reason, std::size_t offset) const;
    Fault not_well_formed(Objection const&, Scanned const&) const;
    Fault not_valid(Objection const&, Scanned const&) const;
    std::size_t tag_to_blame(std::size_t offset, Scanned const&) const;

    std::shared_ptr<Schemas const> schemas_;
    DocumentLimits limits_;
    std::span<std::string_view const> roots_;
    ForeignNamespaces foreign_;
    std::optional<Acceptor> acceptor_;
    std::optional<Validator> validator_;
    std::string_view document_;  // the last one, unchanged
    std::string bytes_;          // a copy in which the scan replaces old namespaces; the tree points into it
    pugi::xml_document tree_;
    MessageTree message_;  // used if the acceptor has no tree
    std::optional<Validation> checked_;
};

}  // namespace rois::xml
