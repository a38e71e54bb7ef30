// Reads one start tag, attribute by attribute, from unparsed bytes.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace rois::xml {

inline constexpr std::string_view white_space = " \t\r\n";

// A table that is true for these bytes.
constexpr std::array<bool, 256> bytes_of(std::string_view bytes) {
    std::array<bool, 256> table{};
    for (unsigned char const byte : bytes) table[byte] = true;
    return table;
}

class StartTag {
public:
    enum class Step { attribute, end, empty_end, broken };

    // `offset` is the offset of its `<`.
    StartTag(std::string_view document, std::size_t offset);

    std::string_view name() const { return name_; }

    // Advances to the next attribute or the end of the tag. After `broken` (not well-formed), next() must not be called again.
    Step next();

    // Valid after Step::attribute. The value is raw: white space and references are not resolved.
    std::string_view attribute() const { return attribute_; }
    std::string_view value() const { return value_; }

    // The current offset: after the attribute, after the tag, or where the tag is broken.
    std::size_t offset() const { return at_; }
    // The error of a broken tag.
    std::string_view complaint() const { return complaint_; }

private:
    std::string_view take_name();
    Step take_attribute();
    void skip_white_space();
    Step broken(std::string_view complaint);

    std::string_view document_;
    std::size_t at_;
    std::string_view name_;
    std::string_view attribute_;
    std::string_view value_;
    std::string_view complaint_;
};

}  // namespace rois::xml
