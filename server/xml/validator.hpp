// Validates with xerces-c, hardened: nothing is fetched, nothing but the given grammars is used, the first error ends it
// (bad-input 1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "xml/schemas.hpp"

namespace rois::xml {

// What xerces-c said first against a document, and the offset of the byte at which it stood then.
struct Objection {
    std::string text;
    std::size_t offset = 0;
};

// A kept parser, made when it is first needed. After a document that it objects to, and when it hoards memory, it makes way for a
// new one, because parsers keep the names that they have met (bad-input 2). The bytes are UTF-8 and have passed the scan. For one
// thread.
class Validator {
public:
    explicit Validator(std::shared_ptr<Schemas const>);
    ~Validator();

    // Nothing when the document is valid.
    std::optional<Objection> objection_to(std::string_view document);

    // What the parser holds between two documents: bounded, whatever came.
    std::size_t bytes_in_use() const;

private:
    class Parser;
    std::shared_ptr<Schemas const> schemas_;
    std::unique_ptr<Parser> parser_;
};

// The same without schemas and with a parser of its own, which leaves no trace: what is against the document's form alone.
std::optional<Objection> objection_to_form(std::string_view document);

}  // namespace rois::xml
