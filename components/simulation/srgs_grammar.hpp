// Speech recognition grammars in the XML form of W3C's SRGS 1.0, for the example component of Annex C: read, checked, and applied
// to what people say.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "xml/schemas.hpp"

namespace rois::simulation {

class SrgsGrammar {
public:
    // Why it cannot be used: "grammar:line:column: reason".
    struct Flaw {
        std::string reason;
    };
    // Reads the document (schemas/srgs.xsd). A rule that refers to itself before any word is a flaw.
    static std::variant<SrgsGrammar, Flaw> read(std::shared_ptr<xml::Schemas const> const&, std::string_view document);

    std::string const& language() const { return language_; }  // its xml:lang: "en-US"

    // Why this cannot be the active rule ("#order" or "order"; empty: the root), or nothing.
    std::optional<std::string> objection_to(std::string_view active_rule) const;

    // A token of the grammar that was heard, between two of the gaps that the spoken words stand between (0: before the first).
    struct Word {
        std::string text;  // as the grammar writes it
        std::size_t from = 0;
        std::size_t to = 0;
        double certainty = 1;
    };
    struct Hypothesis {
        std::vector<Word> words;
        std::vector<std::string> tags;  // those on the way, in order
        double certainty = 1;           // 0 to 1: how alike the words are, times how likely the alternatives are

        std::string text() const;  // the words, a space between two of them
    };

    // What may have been said, the likeliest first, at most `most` with different texts; none when it is not in the language of
    // the rule. Words that sound nearly like those of the grammar are taken for them. `active_rule` has no objection.
    std::vector<Hypothesis> recognize(std::string_view active_rule, std::string_view speech, std::size_t most) const;

    // One piece of the compiled grammar; a tree for each rule.
    struct Expansion {
        enum class Kind : std::uint8_t { sequence, one_of, repeat, token, rule, tag, garbage, never } kind = Kind::sequence;
        std::vector<Expansion> parts;
        std::string text;                // of a token or a tag
        std::vector<std::string> words;  // of a token, as they are compared
        std::size_t least = 1;           // of a repeat
        std::optional<std::size_t> most;
        double weight = 1;       // of an alternative, beside the likeliest one's
        std::size_t rule = 0;    // to which it refers
        std::size_t number = 0;  // unique in the grammar
    };
    struct Rule {
        std::string id;
        bool is_public = false;
        Expansion expansion;
    };

private:
    std::optional<std::size_t> rule_of(std::string_view active_rule) const;

    std::string language_;
    std::optional<std::size_t> root_;
    std::vector<Rule> rules_;
};

}  // namespace rois::simulation
