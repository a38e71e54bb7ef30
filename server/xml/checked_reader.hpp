// From bytes to a tree, for documents that are well-formed and valid: the way of every document into the program.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>

#include "types/messages.hpp"
#include "xml/acceptor.hpp"
#include "xml/codec.hpp"
#include "xml/message_tree.hpp"
#include "xml/scan.hpp"
#include "xml/validator.hpp"

namespace rois::xml {

// Whether a document may declare a namespace that no schema knows. Where schemas let anything stand somewhere, it may there.
enum class ForeignNamespaces : std::uint8_t { refused, as_the_schemas_say };

// Checks a document's bytes and makes a tree of the very same bytes. What the tables of the schemas accept is taken; everything
// else is looked over by the scan and judged by xerces-c, which has the last word. Keeps its parsers and buffers; for one thread.
class CheckedReader {
public:
    // Without schemas it looks at a document's form alone. `roots` are the elements that a fault names when the root is another
    // one; none: any that the schemas have.
    CheckedReader(std::shared_ptr<Schemas const>, DocumentLimits, std::span<std::string_view const> roots = {},
                  ForeignNamespaces = ForeignNamespaces::refused, Validation = Validation::fast);

    // Nothing when all is well: then the document may be asked for, until the next call. It must live as long as that.
    std::optional<Fault> read(std::string_view document);
    pugi::xml_node root();
    MessageTree const& message();

    // Which way the last document was checked; nothing for one that was too large to be looked at.
    std::optional<Validation> checked() const { return checked_; }

    // A fault about an element of the last document.
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
    std::string_view document_;  // the last one, as it came
    std::string bytes_;          // it with its namespaces in today's form; the tree points into it
    pugi::xml_document tree_;
    MessageTree message_;  // of what the acceptor made no tree
    std::optional<Validation> checked_;
};

}  // namespace rois::xml
