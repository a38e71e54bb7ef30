// The pattern of PropertyIsLike (ISO 19143), made ready once.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "types/condition.hpp"

namespace rois {

// Takes time in proportion to the text's length, whatever the pattern: all ways to match are followed at once, a bit each.
class LikePattern {
public:
    static constexpr std::size_t longest = 1'000;  // characters of a pattern

    // The pattern, or why there is none: a special character that is not one character, the same twice, too long a pattern.
    // With `match_case` false, the texts must be folded as `folded_case` does.
    static std::variant<LikePattern, std::string> compile(std::string_view pattern, PropertyIsLike const& characters);

    // The whole text, in UTF-8.
    bool matches(std::string_view text) const;

    // The same for patterns that mean the same.
    std::string canonical() const;

private:
    using Bits = std::vector<std::uint64_t>;

    // The elements that match only this character; `bits` covers those in the word `word` of Bits.
    struct Taker {
        char32_t character;
        std::uint32_t word;
        std::uint64_t bits;
    };

    void set_bits();

    std::u32string elements_;                       // without wild cards; any_one for a single_char
    std::vector<bool> wild_card_before_ = {false};  // by element, and one more for the end
    Bits loops_;                                    // the same as bits
    Bits any_;                                      // the elements that take any character
    std::vector<Taker> takers_;                     // in the order of characters and words
};

}  // namespace rois
