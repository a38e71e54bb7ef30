#include "basic/speech/spoken_words.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "types/text/text_encoding.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

// Full-width punctuation, three bytes each in UTF-8.
constexpr std::array<std::string_view, 8> wide_punctuation{"\u3000", "\u3001", "\u3002", "\uFF01",
                                                           "\uFF0C", "\uFF0E", "\uFF1F", "\u2026"};

bool is_narrow_punctuation(char c) { return std::string_view{".,!?:;\"'()-"}.find(c) != std::string_view::npos; }
bool is_blank(char c) { return std::string_view{" \t\r\n"}.find(c) != std::string_view::npos; }

// U+3040 (hiragana) to U+9FFF (last Han character of the basic plane).
bool is_word_by_itself(std::string_view character) {
    return character.size() == 3 && character >= "\u3040" && character <= "\u9FFF";
}

std::vector<std::string_view> characters_of(std::string_view text) {
    std::vector<std::string_view> characters;
    for (; !text.empty(); text.remove_prefix(characters.back().size()))
        characters.push_back(text.substr(0, std::max<std::size_t>(first_character(text).length, 1)));
    return characters;
}

}  // namespace

std::string spoken_words(std::string_view text) {
    std::string words;
    bool gap = false;
    while (!text.empty()) {
        auto const wide = std::ranges::find_if(wide_punctuation, [&](auto p) { return text.starts_with(p); });
        bool const separates = wide != wide_punctuation.end() || is_narrow_punctuation(text.front()) || is_blank(text.front());
        if (separates) {
            gap = true;
        } else {
            if (gap && !words.empty()) words += ' ';
            gap = false;
            words += text.front();
        }
        text.remove_prefix(wide != wide_punctuation.end() ? wide->size() : 1);
    }
    return lower_case(words);
}

std::vector<std::string> split_into_words(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    auto const finish = [&] {
        if (!word.empty()) words.push_back(std::move(word));
        word.clear();
    };
    auto const clean = spoken_words(text);
    for (auto const character : characters_of(clean)) {
        if (character == " " || is_word_by_itself(character)) finish();
        if (character != " ") word += character;
        if (is_word_by_itself(character)) finish();
    }
    finish();
    return words;
}

double likeness(std::string_view a, std::string_view b) {
    if (a == b) return 1;
    auto const ours = characters_of(a), theirs = characters_of(b);
    std::vector<std::size_t> changes(theirs.size() + 1);
    std::iota(changes.begin(), changes.end(), 0);
    for (std::size_t i = 0; i < ours.size(); ++i) {
        std::size_t diagonal = std::exchange(changes[0], i + 1);
        for (std::size_t j = 0; j < theirs.size(); ++j) {
            auto const replaced = diagonal + (ours[i] == theirs[j] ? 0 : 1);
            diagonal = changes[j + 1];
            changes[j + 1] = std::min({replaced, changes[j] + 1, diagonal + 1});
        }
    }
    return 1.0 - static_cast<double>(changes.back()) / static_cast<double>(std::max(ours.size(), theirs.size()));
}

}  // namespace rois::basic
