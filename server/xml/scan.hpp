// Looks over a document's bytes before any parser sees them (bad-input 3, 4): what a parser would do harm with, or do at great
// cost, never reaches it. Takes linear time. The limit of bytes is the caller's to check.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "types/messages.hpp"
#include "xml/codec.hpp"

namespace rois::xml {

// Why a document was refused, and the offset of the byte that tells.
struct Refusal {
    FaultCode code = FaultCode::not_well_formed;
    std::string reason;
    std::size_t offset = 0;
};

// A declaration of a namespace that no schema knows.
struct ForeignNamespace {
    std::string_view name;   // as written
    std::size_t offset = 0;  // of the tag's `<`
};

struct Scanned {
    std::optional<ForeignNamespace> foreign;  // the first one
    std::size_t last_tag = 0;                 // offset of the last start tag
};

// Elements of this local name hold a list of numbers, of which a parser makes a string each: from start tag to end tag they may
// be so long only.
bool holds_list_of_numbers(std::string_view local_name);
inline constexpr std::size_t longest_list = 8 << 10;  // bytes

// `namespaces` are those that may be declared. Declarations of the RoIS namespace of 2015 are written over with that of 2024, and
// CDATA sections that are empty or hold white space alone with a comment and that white space: xerces-c takes them in values
// only. Passing says nothing yet of well-formedness beyond characters and start tags.
std::variant<Scanned, Refusal> scan(std::span<char> document, DocumentLimits const&, std::span<std::string const> namespaces);

// The offset of the start tag of the innermost element that is open at `offset`; nothing when none is.
std::optional<std::size_t> open_element_at(std::string_view document, std::size_t offset);

// The attribute request_id of the root element as far as it can be read in a document that was refused; else empty.
std::string request_id_of(std::string_view document);

}  // namespace rois::xml
