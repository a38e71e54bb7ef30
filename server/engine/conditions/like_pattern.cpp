#include "engine/conditions/like_pattern.hpp"

#include <algorithm>
#include <utility>

#include "engine/conditions/effort.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr char32_t any_one = 0x110000;  // beyond Unicode
constexpr std::size_t word = 64;

std::optional<char32_t> only_character(std::string_view text) {
    auto const first = take_character(text);
    return first && text.empty() ? first : std::nullopt;
}

bool has(std::vector<std::uint64_t> const& bits, std::size_t at) { return (bits[at / word] >> (at % word) & 1U) != 0; }
void put(std::vector<std::uint64_t>& bits, std::size_t at) { bits[at / word] |= std::uint64_t{1} << (at % word); }

}  // namespace

std::variant<LikePattern, std::string> LikePattern::compile(std::string_view pattern, PropertyIsLike const& characters) {
    auto const wild = only_character(characters.wild_card);
    auto const single = only_character(characters.single_char);
    auto const escape = only_character(characters.escape_char);
    auto const not_one = [](std::string_view name, std::string const& value) {
        return std::string{name} + " of PropertyIsLike is " + quoted(value) + ": expected one character";
    };
    if (!wild) return not_one("wildCard", characters.wild_card);
    if (!single) return not_one("singleChar", characters.single_char);
    if (!escape) return not_one("escapeChar", characters.escape_char);
    if (wild == single || wild == escape || single == escape)
        return std::string{"wildCard, singleChar and escapeChar of PropertyIsLike are not three different characters"};
    Effort::spend(10 * pattern.size());
    LikePattern made;
    while (auto character = take_character(pattern)) {
        if (character == wild) {
            made.wild_card_before_.back() = true;
            continue;
        }
        if (made.elements_.size() == longest)
            return "the pattern of PropertyIsLike is longer than " + std::to_string(longest) + " characters";
        bool const any = character == single;
        if (character == escape) character = take_character(pattern).value_or(*character);
        made.elements_.push_back(any ? any_one : characters.match_case ? *character : folded_case(*character));
        made.wild_card_before_.push_back(false);
    }
    made.set_bits();
    return made;
}

void LikePattern::set_bits() {
    auto const words = elements_.size() / word + 1;
    loops_.resize(words);
    any_.resize(words);
    for (std::size_t i = 0; i < wild_card_before_.size(); ++i)
        if (wild_card_before_[i]) put(loops_, i);
    for (std::size_t i = 0; i < elements_.size(); ++i)
        if (elements_[i] == any_one) put(any_, i);
    for (std::size_t i = 0; i < elements_.size(); ++i) {
        if (elements_[i] == any_one) continue;
        takers_.push_back({elements_[i], static_cast<std::uint32_t>(i / word), std::uint64_t{1} << (i % word)});
    }
    auto const place = [](Taker const& taker) { return std::pair{taker.character, taker.word}; };
    std::ranges::sort(takers_, {}, place);
    std::size_t last = 0;
    for (std::size_t i = 1; i < takers_.size(); ++i) {
        if (place(takers_[last]) == place(takers_[i])) {
            takers_[last].bits |= takers_[i].bits;
        } else {
            takers_[++last] = takers_[i];
        }
    }
    if (!takers_.empty()) takers_.resize(last + 1);
    takers_.shrink_to_fit();
}

// `next` has one bit for each element that may match the next character, and one for the end of the pattern.
bool LikePattern::matches(std::string_view text) const {
    Bits next(loops_.size());
    put(next, 0);
    while (!text.empty()) {
        auto const character = take_character(text).value_or(0);
        auto taker = std::ranges::lower_bound(takers_, character, {}, &Taker::character);
        std::uint64_t carried = 0;
        std::uint64_t alive = 0;
        for (std::size_t i = 0; i < next.size(); ++i) {
            auto takes = any_[i];
            if (taker != takers_.end() && taker->character == character && taker->word == i) takes |= (taker++)->bits;
            auto const taken = next[i] & takes;
            next[i] = (next[i] & loops_[i]) | (taken << 1U) | carried;
            carried = taken >> (word - 1);
            alive |= next[i];
        }
        if (alive == 0) return false;
    }
    return has(next, elements_.size());
}

std::string LikePattern::canonical() const {
    std::string text;
    for (std::size_t i = 0; i < wild_card_before_.size(); ++i) {
        if (wild_card_before_[i]) text += "*,";
        if (i < elements_.size())
            text += (elements_[i] == any_one ? "?" : std::to_string(static_cast<std::uint32_t>(elements_[i]))) + ",";
    }
    return text;
}

}  // namespace rois
