#include "xml/validation/scan.hpp"

#include <algorithm>
#include <array>
#include <pugixml.hpp>
#include <utility>
#include <vector>

#include "types/identifier_length.hpp"
#include "types/text/texts.hpp"
#include "xml/codec/characters.hpp"
#include "xml/codec/names.hpp"
#include "xml/tables/start_tag.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view cdata_begin = "<![CDATA[";
constexpr std::string_view cdata_end = "]]>";

std::string limit(std::string_view what, std::size_t size) {
    return std::string{what} + ": the limit is " + std::to_string(size);
}

class Scan {
public:
    Scan(std::span<char> document, DocumentLimits const& limits, std::span<std::string const> namespaces)
        : document_{document}, text_{document.data(), document.size()}, limits_{limits}, namespaces_{namespaces} {}

    std::variant<Scanned, Refusal> run();

private:
    // `nothing`: the scan ends here, because the document is rejected or the parser will report the error.
    enum class Next { markup, nothing };

    void prologue();
    void declaration(std::size_t end);
    Next markup();
    Next skip_to(std::string_view end);
    Next cdata_section();
    Next end_tag();
    Next start_tag();
    void end_list();
    void close();
    void attribute(StartTag const&, std::size_t tag);
    void namespace_declaration(StartTag const&, std::size_t tag);
    void refuse(FaultCode code, std::string reason, std::size_t offset) { refusal_ = Refusal{code, std::move(reason), offset}; }

    std::span<char> document_;
    std::string_view text_;
    DocumentLimits const& limits_;
    std::span<std::string const> namespaces_;

    std::size_t at_ = 0;
    std::size_t depth_ = 0;
    std::size_t elements_ = 0;
    std::vector<std::size_t> outer_;   // of each open element: the namespace declarations in scope around it
    std::size_t in_scope_ = 0;         // namespace declarations
    std::optional<std::size_t> list_;  // offset of the start tag of the current list of numbers
    Scanned scanned_;
    std::optional<Refusal> refusal_;
};

std::variant<Scanned, Refusal> Scan::run() {
    prologue();
    while (!refusal_) {
        at_ = text_.find('<', at_);
        if (at_ == text_.npos || markup() == Next::nothing) break;
    }
    if (refusal_) return *std::move(refusal_);
    return scanned_;
}

void Scan::prologue() {
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
    auto const first = text_.find_first_not_of(white_space, at_);
    if (first == text_.npos) return refuse(FaultCode::not_well_formed, "the document is empty", at_);
    auto const rest = text_.substr(first);
    if (!rest.starts_with("<?xml") || rest.size() == 5 || white_space.find(rest[5]) == white_space.npos) return;
    if (first != at_) {
        return refuse(FaultCode::not_well_formed, "the XML declaration must be at the very beginning of the document", first);
    }
    auto const end = text_.find("?>", at_);
    if (end == text_.npos) return refuse(FaultCode::not_well_formed, "the document ends inside the XML declaration", at_);
    declaration(end);
    at_ = end + 2;
}

// The parser reports other errors in an XML declaration.
void Scan::declaration(std::size_t end) {
    StartTag declared{text_.substr(0, end), at_ + 1};
    while (declared.next() == StartTag::Step::attribute) {
        if (declared.attribute() == "version" && declared.value() != "1.0") {
            return refuse(FaultCode::forbidden_xml, "the XML version is " + quoted(declared.value()) + ": expected 1.0", at_);
        }
        if (declared.attribute() == "encoding" && !equal_ignoring_case(declared.value(), "UTF-8")) {
            return refuse(FaultCode::forbidden_xml, "the encoding is " + quoted(declared.value()) + ": expected UTF-8", at_);
        }
    }
}

Scan::Next Scan::markup() {
    auto const rest = text_.substr(at_);
    if (rest.starts_with("<!--")) {
        at_ += 4;
        return skip_to("-->");
    }
    if (rest.starts_with(cdata_begin)) return cdata_section();
    if (rest.starts_with("<!DOCTYPE")) {
        refuse(FaultCode::forbidden_xml, "a document type is not allowed", at_);
        return Next::nothing;
    }
    if (rest.starts_with("<?")) {
        bool const whole = rest.find("?>") != rest.npos;
        if (whole) refuse(FaultCode::forbidden_xml, "a processing instruction is not allowed", at_);
        if (!whole) refuse(FaultCode::not_well_formed, "the document ends inside a processing instruction", at_);
        return Next::nothing;
    }
    if (rest.starts_with("<!")) {
        refuse(FaultCode::not_well_formed, "'<!' must begin a comment or a CDATA section", at_);
        return Next::nothing;
    }
    return rest.starts_with("</") ? end_tag() : start_tag();
}

Scan::Next Scan::skip_to(std::string_view end) {
    auto const found = text_.find(end, at_);
    if (found == text_.npos) return Next::nothing;
    at_ = found + end.size();
    return Next::markup;
}

// Between elements, XSD allows a CDATA section of white space, but xerces-c rejects every section. Overwrites such a section with
// a comment of the size of its markup, followed by the white space. The meaning is the same, and all tags keep their offsets.
Scan::Next Scan::cdata_section() {
    constexpr std::string_view comment = "<!--CDATA-->";
    static_assert(comment.size() == cdata_begin.size() + cdata_end.size());
    auto const begin = at_;
    if (skip_to(cdata_end) == Next::nothing) return Next::nothing;
    auto const section = document_.subspan(begin, at_ - begin);
    auto const text = section.subspan(cdata_begin.size(), section.size() - comment.size());
    bool const blank = std::ranges::all_of(text, [](char c) { return white_space.find(c) != white_space.npos; });
    if (depth_ == 0 || !blank) return Next::markup;
    // Replaces a single '\r' by the equivalent '\n', so that it does not form a pair with a '\n' after the section.
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) text[i] = '\n';
    std::ranges::copy_backward(text, section.end());
    std::ranges::copy(comment, section.begin());
    return Next::markup;
}

void Scan::end_list() {
    auto const begin = std::exchange(list_, {});
    if (begin && at_ - *begin > longest_list)
        refuse(FaultCode::forbidden_xml, limit("a list of numbers is too long", longest_list), *begin);
}

// Closes the innermost open element.
void Scan::close() {
    --depth_;
    in_scope_ = outer_.back();
    outer_.pop_back();
}

Scan::Next Scan::end_tag() {
    end_list();
    if (depth_ == 0 || refusal_) return Next::nothing;
    close();
    return skip_to(">");
}

Scan::Next Scan::start_tag() {
    end_list();
    auto const begin = at_;
    StartTag tag{text_, begin};
    scanned_.last_tag = begin;
    if (holds_list_of_numbers(local_part(tag.name()))) list_ = begin;
    auto const forbid = [&](std::string reason) {
        refuse(FaultCode::forbidden_xml, std::move(reason), begin);
        return Next::nothing;
    };
    if (++elements_ > limits_.elements) return forbid(limit("too many elements", limits_.elements));
    if (++depth_ > limits_.depth) return forbid(limit("elements are nested too deeply", limits_.depth));
    outer_.push_back(in_scope_);
    if (tag.name().size() > limits_.name_length) return forbid(limit("the name of an element is too long", limits_.name_length));

    auto step = tag.next();
    for (std::size_t count = 1; step == StartTag::Step::attribute; ++count, step = tag.next()) {
        if (count > limits_.attributes) return forbid(limit("too many attributes in one element", limits_.attributes));
        attribute(tag, begin);
    }
    if (step == StartTag::Step::broken) {
        auto const place = tag.offset() < text_.size() ? tag.offset() : begin;
        refuse(FaultCode::not_well_formed, std::string{tag.complaint()}, place);
    }
    if (step == StartTag::Step::empty_end) {
        close();
        list_.reset();
    }
    at_ = tag.offset();
    return refusal_ ? Next::nothing : Next::markup;
}

void Scan::attribute(StartTag const& tag, std::size_t begin) {
    if (tag.attribute().size() > limits_.name_length) {
        return refuse(FaultCode::forbidden_xml, limit("the name of an attribute is too long", limits_.name_length), begin);
    }
    if (declares_namespace(tag.attribute())) namespace_declaration(tag, begin);
}

void Scan::namespace_declaration(StartTag const& tag, std::size_t begin) {
    if (++in_scope_ > limits_.namespaces) {
        return refuse(FaultCode::forbidden_xml, limit("too many namespace declarations in scope", limits_.namespaces), begin);
    }
    if (tag.value() == old_rois_namespace) {
        auto const offset = static_cast<std::size_t>(tag.value().data() - text_.data());
        std::ranges::copy(rois_namespace, document_.begin() + static_cast<std::ptrdiff_t>(offset));
        return;
    }
    if (tag.value().empty() || scanned_.foreign || std::ranges::find(namespaces_, tag.value()) != namespaces_.end()) return;
    scanned_.foreign = ForeignNamespace{tag.value(), begin};
}

}  // namespace

bool holds_list_of_numbers(std::string_view local_name) {
    constexpr std::array<std::string_view, 9> names{"lowerCorner", "upperCorner", "pos", "posList", "position",
                                                    "orientation", "covariance",  "low", "high"};
    return std::ranges::find(names, local_name) != names.end();
}

std::variant<Scanned, Refusal> scan(std::span<char> document, DocumentLimits const& limits,
                                    std::span<std::string const> namespaces) {
    if (auto const bad = first_bad_character({document.data(), document.size()})) {
        return Refusal{FaultCode::not_well_formed, std::string{bad->complaint}, bad->offset};
    }
    return Scan{document, limits, namespaces}.run();
}

std::optional<std::size_t> open_element_at(std::string_view document, std::size_t offset) {
    std::vector<std::size_t> open;
    for (auto at = document.find('<'); at < offset; at = document.find('<', at)) {
        auto const rest = document.substr(at);
        auto const skip_past = [&](std::string_view end) { at = std::min(document.find(end, at), document.size()); };
        if (rest.starts_with("<!--")) {
            skip_past("-->");
        } else if (rest.starts_with("<![CDATA[")) {
            skip_past("]]>");
        } else if (rest.starts_with("</")) {
            if (!open.empty()) open.pop_back();
            ++at;
        } else if (rest.starts_with("<?") || rest.starts_with("<!")) {
            ++at;
        } else {
            StartTag tag{document, at};
            auto step = tag.next();
            while (step == StartTag::Step::attribute) step = tag.next();
            if (step == StartTag::Step::end) open.push_back(at);
            at = std::max(tag.offset(), at + 1);
        }
    }
    return open.empty() ? std::nullopt : std::optional{open.back()};
}

std::string request_id_of(std::string_view document) {
    auto at = document.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    auto const skip_past = [&](std::string_view end) {
        auto const found = document.find(end, at);
        at = found == document.npos ? found : found + end.size();
    };
    for (;;) {
        if (at != document.npos) at = document.find_first_not_of(white_space, at);
        if (at == document.npos || document[at] != '<') return {};
        if (document.substr(at).starts_with("<!--")) {
            skip_past("-->");
        } else if (document.substr(at).starts_with("<?")) {
            skip_past("?>");
        } else {
            break;
        }
    }
    StartTag root{document, at};
    auto step = root.next();
    while (step == StartTag::Step::attribute) step = root.next();
    if (step == StartTag::Step::broken) return {};
    // Copies the root's start tag as an empty element, and parses that: this resolves the references in the attribute.
    std::string alone{document.substr(at, root.offset() - at)};
    if (first_bad_character(alone)) return {};
    if (step == StartTag::Step::end) alone.insert(alone.size() - 1, 1, '/');
    pugi::xml_document tree;
    tree.load_buffer_inplace(alone.data(), alone.size(), pugi::parse_default | pugi::parse_wconv_attribute, pugi::encoding_utf8);
    std::string id = tree.document_element().attribute("request_id").value();
    return why_too_long("request_id", id) ? std::string{} : id;
}

}  // namespace rois::xml
