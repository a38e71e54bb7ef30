// Validates with a hardened xerces-c: fetches nothing, uses only the given grammars, stops at the first error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "xml/validation/schemas.hpp"

namespace rois::xml {

// The first error that xerces-c reported, and its offset in bytes.
struct Objection {
    std::string text;
    std::size_t offset = 0;
};

// Keeps a parser, created at the first use. Replaces it after an invalid document, and when it uses too much memory, because
// xerces-c's parsers keep all names that they have read. Documents must have passed the scan. Not thread-safe.
class Validator {
public:
    explicit Validator(std::shared_ptr<Schemas const>);
    ~Validator();

    // Returns nothing if the document is valid.
    std::optional<Objection> objection_to(std::string_view document);

    // Returns the memory that the parser keeps between two documents. It is bounded.
    std::size_t bytes_in_use() const;

private:
    class Parser;
    std::shared_ptr<Schemas const> schemas_;
    std::unique_ptr<Parser> parser_;
};

// Checks only that the document is well-formed, with a parser of its own.
std::optional<Objection> objection_to_form(std::string_view document);

}  // namespace rois::xml
