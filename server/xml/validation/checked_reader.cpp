#include "xml/validation/checked_reader.hpp"

#include "types/text/texts.hpp"
#include "xml/codec/place.hpp"
#include "xml/codec/tree.hpp"
#include "xml/validation/explanation.hpp"
#include "xml/validation/grammars.hpp"

namespace rois::xml {

namespace {

constexpr std::size_t keep_at_most = 256 << 10;  // bytes of the buffer between two documents

// Returns a parser's message, shortened and without control characters.
std::string clean(std::string_view text) {
    constexpr std::size_t longest = 160;
    auto const with_quotes = quoted(text, longest);
    return with_quotes.substr(1, with_quotes.size() - 2);
}

Objection about(ForeignNamespace const& foreign) { return {"unknown namespace " + quoted(foreign.name), foreign.offset + 1}; }

// Returns the offset of the last start tag that begins before `offset`.
std::size_t tag_before(pugi::xml_node root, std::size_t offset) {
    struct Last : pugi::xml_tree_walker {
        std::size_t limit = 0, found = 0;
        bool for_each(pugi::xml_node& node) override {
            if (node.type() != pugi::node_element) return true;
            if (offset_of(node) >= limit) return false;
            found = offset_of(node);
            return true;
        }
    } last;
    last.limit = offset;
    last.found = offset_of(root);
    root.traverse(last);
    return last.found;
}

}  // namespace

CheckedReader::CheckedReader(std::shared_ptr<Schemas const> schemas, DocumentLimits limits,
                             std::span<std::string_view const> roots, ForeignNamespaces foreign, Validation validation)
    : schemas_{std::move(schemas)}, limits_{limits}, roots_{roots}, foreign_{foreign} {
    if (schemas_) validator_.emplace(schemas_);
    if (schemas_ && validation == Validation::fast) acceptor_.emplace(schemas_, limits);
}

std::optional<Fault> CheckedReader::read(std::string_view document) {
    checked_.reset();
    if (document.size() > limits_.bytes) {
        return Fault{FaultCode::too_large, "the document is too large: the limit is " + std::to_string(limits_.bytes) + " bytes"};
    }
    tree_.reset();
    document_ = document;
    checked_ = acceptor_ && acceptor_->accepts(document) ? Validation::fast : Validation::full;
    if (checked_ == Validation::fast) return std::nullopt;

    take_bytes();
    if (auto fault = check_in_full()) return fault;
    if (auto const result = parse(); !result) {
        return refused(FaultCode::not_well_formed, result.description(), static_cast<std::size_t>(result.offset));
    }
    return std::nullopt;
}

void CheckedReader::take_bytes() {
    if (bytes_.capacity() > keep_at_most && document_.size() <= keep_at_most) std::string{}.swap(bytes_);
    bytes_ = document_;
}

pugi::xml_parse_result CheckedReader::parse() {
    return tree_.load_buffer_inplace(bytes_.data(), bytes_.size(), as_xerces_reads, pugi::encoding_utf8);
}

// A document that the acceptor accepted is parsed here, at the first call.
pugi::xml_node CheckedReader::root() {
    if (!tree_.first_child()) {
        take_bytes();
        parse();
    }
    return tree_.document_element();
}

MessageTree const& CheckedReader::message() {
    if (auto const* const made = checked_ == Validation::fast ? acceptor_->tree() : nullptr) return *made;
    message_.read(root());
    return message_;
}

// Also replaces old namespaces in `bytes_`.
std::optional<Fault> CheckedReader::check_in_full() {
    std::span<std::string const> namespaces;
    if (schemas_) namespaces = schemas_->grammars().namespaces();
    auto const outcome = scan(bytes_, limits_, namespaces);
    if (auto const* refusal = std::get_if<Refusal>(&outcome)) return refused(refusal->code, refusal->reason, refusal->offset);
    return objection_to(std::get<Scanned>(outcome));
}

std::optional<Fault> CheckedReader::objection_to(Scanned const& scanned) {
    if (!validator_) {
        auto const objection = objection_to_form(bytes_);
        return objection ? std::optional{not_well_formed(*objection, scanned)} : std::nullopt;
    }
    if (scanned.foreign && foreign_ == ForeignNamespaces::refused) return not_valid(about(*scanned.foreign), scanned);
    auto const objection = validator_->objection_to(bytes_);
    return objection ? std::optional{not_valid(*objection, scanned)} : std::nullopt;
}

Fault CheckedReader::complain(pugi::xml_node element, std::string reason) const {
    return refused(FaultCode::invalid, std::move(reason), offset_of(element));
}

Place CheckedReader::place(pugi::xml_node element) const { return place_of(document_, offset_of(element)); }

Fault CheckedReader::refused(FaultCode code, std::string reason, std::size_t offset) const {
    return {code, std::move(reason), place_of(document_, offset), request_id_of(document_)};
}

Fault CheckedReader::not_well_formed(Objection const& objection, Scanned const& scanned) const {
    return refused(FaultCode::not_well_formed, "not well-formed: " + clean(objection.text),
                   tag_to_blame(objection.offset, scanned));
}

// Returns the offset of the unclosed start tag if the document is cut short or has a wrong end tag; else `offset`.
std::size_t CheckedReader::tag_to_blame(std::size_t offset, Scanned const& scanned) const {
    if (offset >= bytes_.find_last_not_of(" \t\r\n") + 1)
        return open_element_at(bytes_, bytes_.size()).value_or(scanned.last_tag);
    auto const markup = bytes_.rfind('<', offset);
    bool const in_end_tag =
        markup != bytes_.npos && bytes_.compare(markup, 2, "</") == 0 && bytes_.find('>', markup) + 1 >= offset;
    return in_end_tag ? open_element_at(bytes_, markup).value_or(offset) : offset;
}

Fault CheckedReader::not_valid(Objection const& objection, Scanned const& scanned) const {
    if (auto const form = objection_to_form(bytes_)) return not_well_formed(*form, scanned);
    auto copy = bytes_;
    pugi::xml_document tree;
    tree.load_buffer_inplace(copy.data(), copy.size(), as_xerces_reads, pugi::encoding_utf8);
    auto const root = tree.document_element();
    if (auto explanation = explain(*schemas_, root, roots_)) {
        return refused(FaultCode::invalid, std::move(explanation->reason), explanation->offset);
    }
    return refused(FaultCode::invalid, "not valid: " + clean(objection.text), tag_before(root, objection.offset));
}

}  // namespace rois::xml
