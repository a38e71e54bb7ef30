// Scans a document's bytes before a parser sees them, and rejects harmful or expensive input. Takes linear time.
// The caller checks the limit of bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "types/messages.hpp"
#include "xml/codec/codec.hpp"

namespace rois::xml {

struct Refusal {
    FaultCode code = FaultCode::not_well_formed;
    std::string reason;
    std::size_t offset = 0;  // of the offending byte
};

// A declaration of a namespace that is not in the schemas.
struct ForeignNamespace {
    std::string_view name;   // as written
    std::size_t offset = 0;  // of the tag's `<`
};

struct Scanned {
    std::optional<ForeignNamespace> foreign;  // the first one
    std::size_t last_tag = 0;                 // offset of the last start tag
};

// Returns whether elements of this local name contain a list of numbers. Their length, from start tag to end tag, is limited,
// because a parser makes a string of each number.
bool holds_list_of_numbers(std::string_view local_name);
inline constexpr std::size_t longest_list = 8 << 10;  // bytes

// Checks characters, start tags and limits; the parser checks everything else. Reports the first namespace that is not in
// `namespaces` as foreign. Overwrites declarations of the RoIS namespace of 2015 with that of 2024. Overwrites CDATA sections of
// white space with a comment and the white space, because xerces-c allows such sections only in values.
std::variant<Scanned, Refusal> scan(std::span<char> document, DocumentLimits const&, std::span<std::string const> namespaces);

// Returns the offset of the start tag of the innermost element that is open at `offset`, or nothing.
std::optional<std::size_t> open_element_at(std::string_view document, std::size_t offset);

// Returns the attribute request_id of the root element of a rejected document; empty if it cannot be read.
std::string request_id_of(std::string_view document);

}  // namespace rois::xml
