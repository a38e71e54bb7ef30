// Finds the tags of a document, which need not be well-formed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rois::fuzz {

// From `begin` up to `end`, in bytes.
struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;

    std::size_t size() const { return end - begin; }
};

struct Tag {
    enum class Kind { start, end, empty };

    Kind kind = Kind::start;
    Range all;                               // with its brackets
    Range name;                              // with its prefix
    std::vector<Range> attributes;           // name and value
    std::optional<std::size_t> counterpart;  // of a start tag its end tag, and the other way
};

std::vector<Tag> tags_of(std::string_view document);

// From the start tag to the end tag.
Range element_of(std::vector<Tag> const&, std::size_t start_tag);

// The value of an attribute, without its quotes.
Range value_of(std::string_view document, Range attribute);

}  // namespace rois::fuzz
