// Grammars of speech recognition: the parameters `grammar` and `rule` of 7.6.9.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rois::basic {

// A grammar is the word `default`, which matches all speech, or a list of rules:
//
//     yes | no | help                                  one rule, named `default`
//     answer = yes | no; drink = green tea | coffee    two rules, separated by semicolons or line ends
//
// A rule is a list of phrases. Speech matches a phrase if both have the same spoken_words(). The active rule `default` stands for
// all rules.
class Grammar {
public:
    // Matches all speech.
    Grammar() = default;

    // Why the grammar or the rule is invalid.
    struct Flaw {
        std::string reason;
    };
    // An empty text means `default`.
    static std::variant<Grammar, Flaw> read(std::string_view grammar, std::string_view rule);

    // Returns the matching phrase as the grammar writes it, or, for `default`, the speech itself. Returns nothing if no phrase
    // matches.
    std::optional<std::string> match(std::string_view speech) const;

private:
    struct Phrase {
        std::string text;
        std::string words;  // spoken_words() of the text
    };
    bool anything_ = true;
    std::vector<Phrase> phrases_;
};

}  // namespace rois::basic
