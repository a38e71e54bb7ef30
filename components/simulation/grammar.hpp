// What speech recognition listens for: the parameters `grammar` and `rule` of 7.6.9.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rois::simulation {

// A grammar is the word `default`, which anything matches, or rules in a form of our own:
//
//     yes | no | help                                  one rule, named `default`
//     answer = yes | no; drink = green tea | coffee    two rules, separated by semicolons or line ends
//
// A rule is a list of phrases. Speech matches a phrase when both have the same words: case (of ASCII letters), punctuation and
// the amount of white space do not count. The active rule `default` stands for all rules.
class Grammar {
public:
    // Listens for anything.
    Grammar() = default;

    // Why it cannot be read, or that it has no such rule, in words.
    struct Flaw {
        std::string reason;
    };
    // Empty texts are `default`.
    static std::variant<Grammar, Flaw> read(std::string_view grammar, std::string_view rule);

    // What was recognized: the phrase as the grammar writes it, or under `default` the speech itself. Nothing when no phrase
    // matches.
    std::optional<std::string> match(std::string_view speech) const;

private:
    struct Phrase {
        std::string text;
        std::string words;  // in the form that is compared
    };
    bool anything_ = true;
    std::vector<Phrase> phrases_;
};

}  // namespace rois::simulation
