// Speech recognition grammars in the XML form of W3C SRGS 1.0, for the example component of Annex C: reads and validates
// grammars, and recognizes speech with them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "xml/validation/schemas.hpp"

namespace rois::basic {

class SrgsGrammar {
public:
    // Why the grammar is invalid: "grammar:line:column: reason".
    struct Flaw {
        std::string reason;
    };
    // Reads the document (schemas/srgs.xsd). Rejects rules that refer to themselves before any word.
    static std::variant<SrgsGrammar, Flaw> read(std::shared_ptr<xml::Schemas const> const&, std::string_view document);

    std::string const& language() const { return language_; }  // the document's xml:lang: "en-US"

    // Returns why this active rule ("#order" or "order"; empty: the root) is invalid, or nothing.
    std::optional<std::string> objection_to(std::string_view active_rule) const;

    // A recognized token of the grammar. `from` and `to` are gaps between the spoken words (0: before the first word).
    struct Word {
        std::string text;  // as the grammar writes it
        std::size_t from = 0;
        std::size_t to = 0;
        double certainty = 1;
    };
    struct Hypothesis {
        std::vector<Word> words;
        std::vector<std::string> tags;  // in the order of recognition
        double certainty = 1;           // 0 to 1: similarity of the words times weight of the alternatives

        std::string text() const;  // the words, separated by spaces
    };

    // Returns at most `most` hypotheses with different texts, the most likely first; none if the speech does not match the rule.
    // Words similar to the grammar's count as matches. `active_rule` must be valid (objection_to()).
    std::vector<Hypothesis> recognize(std::string_view active_rule, std::string_view speech, std::size_t most) const;

    // A node of the compiled grammar. Each rule is a tree of them.
    struct Expansion {
        enum class Kind : std::uint8_t { sequence, one_of, repeat, token, rule, tag, garbage, never } kind = Kind::sequence;
        std::vector<Expansion> parts;
        std::string text;                // of a token or a tag
        std::vector<std::string> words;  // of a token, normalized
        std::size_t least = 1;           // of a repeat
        std::optional<std::size_t> most;
        double weight = 1;       // of an alternative, relative to the most likely one
        std::size_t rule = 0;    // the rule that it refers to
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

}  // namespace rois::basic
