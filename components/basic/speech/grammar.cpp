#include "basic/speech/grammar.hpp"

#include <algorithm>

#include "basic/speech/spoken_words.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

constexpr std::string_view default_name = "default";

bool is_default(std::string_view text) { return text.empty() || text == default_name; }

// Returns the trimmed parts between separators.
std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> parts;
    while (true) {
        auto const end = text.find_first_of(separators);
        parts.push_back(trimmed(text.substr(0, end)));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

}  // namespace

std::variant<Grammar, Grammar::Flaw> Grammar::read(std::string_view grammar, std::string_view rule) {
    Grammar made;
    if (is_default(grammar)) {
        if (is_default(rule)) return made;
        return Flaw{"the default grammar has no rule " + quoted(rule)};
    }
    made.anything_ = false;
    bool found = is_default(rule);
    for (auto text : split(grammar, ";\n")) {
        if (text.empty()) continue;
        auto const equals = text.find('=');
        bool const named = equals != std::string_view::npos;
        auto const name = named ? trimmed(text.substr(0, equals)) : default_name;
        if (name.empty()) return Flaw{"a rule of the grammar has no name before '='"};
        bool const active = is_default(rule) || name == rule;
        found = found || active;
        for (auto phrase : split(named ? text.substr(equals + 1) : text, "|")) {
            auto words = spoken_words(phrase);
            if (words.empty()) return Flaw{"the rule " + quoted(name) + " of the grammar has an empty phrase"};
            if (active) made.phrases_.push_back({std::string{phrase}, std::move(words)});
        }
    }
    if (!found) return Flaw{"the grammar has no rule " + quoted(rule)};
    if (made.phrases_.empty()) return Flaw{"the grammar has no phrase"};
    return made;
}

std::optional<std::string> Grammar::match(std::string_view speech) const {
    if (anything_) return std::string{speech};
    auto const found = std::ranges::find(phrases_, spoken_words(speech), &Phrase::words);
    if (found == phrases_.end()) return {};
    return found->text;
}

}  // namespace rois::basic
