#include "fuzz/comparison.hpp"

#include <utility>
#include <variant>

#include "fuzz/reading.hpp"
#include "xml/codec/tree.hpp"
#include "xml/validation/grammars.hpp"
#include "xml/validation/scan.hpp"

namespace rois::fuzz {

Comparison::Comparison(std::shared_ptr<xml::Schemas const> schemas, xml::DocumentLimits limits)
    : schemas_{std::move(schemas)}, limits_{limits}, acceptor_{schemas_, limits}, validator_{schemas_} {}

Comparison::Outcome Comparison::look_at(std::string const& document) {
    auto const accepted = acceptor_.accepts(document);
    auto objection = objection_to(document);
    if (accepted && !objection && read_by_xerces(document) != read_by_pugixml(document))
        objection = "the tree holds something else";
    if (accepted && !objection && trees_differ(document)) objection = "the acceptor's tree holds something else";
    auto const outcome = accepted    ? (objection ? Outcome::wrong : Outcome::both)
                         : objection ? Outcome::neither
                                     : Outcome::xerces_only;
    if (outcome == Outcome::wrong) complaint_ = objection.value_or("");
    ++counts_[static_cast<std::size_t>(outcome)];
    return outcome;
}

// The acceptor's, where it has made one, and pugixml's.
bool Comparison::trees_differ(std::string document) const {
    if (acceptor_.tree() == nullptr) return false;
    pugi::xml_document parsed;
    parsed.load_buffer_inplace(document.data(), document.size(), xml::as_xerces_reads, pugi::encoding_utf8);
    xml::MessageTree expected;
    expected.read(parsed.document_element());
    return *acceptor_.tree() != expected;
}

std::optional<std::string> Comparison::objection_to(std::string const& document) {
    auto bytes = document;
    auto const scanned = xml::scan(bytes, limits_, schemas_->grammars().namespaces());
    if (auto const* refusal = std::get_if<xml::Refusal>(&scanned)) return "scan: " + refusal->reason;
    if (std::get<xml::Scanned>(scanned).foreign) return "scan: a foreign namespace";
    if (bytes != document) return "scan: it must be changed";
    auto const objection = validator_.objection_to(bytes);
    return objection ? std::optional{objection->text} : std::nullopt;
}

}  // namespace rois::fuzz
