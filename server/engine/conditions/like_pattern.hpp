// A compiled pattern of PropertyIsLike (ISO 19143).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "types/condition.hpp"

namespace rois {

// Matching takes time in proportion to the text's length, whatever the pattern: it tries all ways to match at the same time. Each
// way is one bit.
class LikePattern {
public:
    static constexpr std::size_t longest = 1'000;  // characters of a pattern

    // Returns the pattern, or why it is invalid: a special character that is not one character, two special characters that are
    // the same, or a pattern that is too long. If `match_case` is false, texts to match must be folded by `folded_case`.
    static std::variant<LikePattern, std::string> compile(std::string_view pattern, PropertyIsLike const& characters);

    // Matches the whole text, in UTF-8.
    bool matches(std::string_view text) const;

    // The cost of matching a text of this many bytes (Effort).
    std::size_t steps(std::size_t bytes) const { return bytes * (6 + 2 * loops_.size()); }

    // Returns the same text for equivalent patterns.
    std::string canonical() const;

private:
    using Bits = std::vector<std::uint64_t>;

    // The elements that match only this character, as `bits` in the word `word` of Bits.
    struct Taker {
        char32_t character;
        std::uint32_t word;
        std::uint64_t bits;
    };

    void set_bits();

    std::u32string elements_;                       // without wild cards; any_one for a single_char
    std::vector<bool> wild_card_before_ = {false};  // by element, and one more for the end
    Bits loops_;                                    // wild_card_before_ as bits
    Bits any_;                                      // the elements that match any character
    std::vector<Taker> takers_;                     // ordered by character and word
};

}  // namespace rois
