#include "basic/speech/srgs_grammar.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "basic/speech/languages.hpp"
#include "basic/speech/spoken_words.hpp"
#include "types/text/texts.hpp"
#include "xml/profiles/document.hpp"

namespace rois::basic {
namespace {

using Expansion = SrgsGrammar::Expansion;
using Kind = Expansion::Kind;
using Rules = std::vector<SrgsGrammar::Rule>;

constexpr std::array<std::string_view, 3> special_rules{"NULL", "VOID", "GARBAGE"};

std::size_t number_of(std::string_view digits) {
    std::size_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

// Reads the expansions of a grammar. The rules must already have their ids.
class ExpansionReader {
public:
    explicit ExpansionReader(Rules const& rules) : rules_{rules} {}

    Expansion sequence(xml::Element const& element) {
        auto made = make(Kind::sequence);
        for (auto const& part : element.content()) {
            if (auto const* text = std::get_if<std::string>(&part)) {
                add_tokens(made, element, *text);
            } else {
                add(made, std::get<xml::Element>(part));
            }
        }
        return made;
    }

private:
    Expansion make(Kind kind) {
        Expansion made;
        made.kind = kind;
        made.number = ++last_;
        return made;
    }

    void add(Expansion& sequence, xml::Element const& element) {
        auto const name = element.name();
        if (name == "item") sequence.parts.push_back(item(element));
        if (name == "one-of") sequence.parts.push_back(one_of(element));
        if (name == "ruleref") sequence.parts.push_back(rule_ref(element));
        if (name == "token") add_token(sequence, element, element.text());
        if (name == "tag") {
            sequence.parts.push_back(make(Kind::tag));
            sequence.parts.back().text = trimmed(element.text());
        }
    }

    // Adds the tokens of text between elements. Tokens are separated by white space, or quoted.
    void add_tokens(Expansion& sequence, xml::Element const& element, std::string_view text) {
        for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
            bool const is_quoted = text.front() == '"' && text.find('"', 1) != text.npos;
            auto const end = is_quoted ? text.find('"', 1) + 1 : std::min(text.find_first_of(" \t\r\n"), text.size());
            add_token(sequence, element, text.substr(0, end));
            text.remove_prefix(end);
        }
    }

    void add_token(Expansion& sequence, xml::Element const& element, std::string_view written) {
        auto text = trimmed(written);
        if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
        if (text.find('"') != text.npos)
            throw element.complain("the token " + quoted(trimmed(written)) +
                                   " has a quote that does not enclose the whole token");
        auto words = split_into_words(text);
        if (words.empty()) return;
        auto token = make(Kind::token);
        token.text = trimmed(text);
        token.words = std::move(words);
        sequence.parts.push_back(std::move(token));
    }

    Expansion item(xml::Element const& element) {
        auto const repeat = element.token("repeat");
        if (!repeat) return sequence(element);
        auto made = make(Kind::repeat);
        auto const range = trimmed(*repeat);
        auto const dash = range.find('-');
        made.least = number_of(range.substr(0, dash));
        if (dash == range.npos) made.most = made.least;
        if (dash != range.npos && dash + 1 < range.size()) made.most = number_of(range.substr(dash + 1));
        if (made.most && *made.most < made.least)
            throw element.complain("the repeat " + quoted(range) + " has a maximum below its minimum");
        made.parts.push_back(sequence(element));
        return made;
    }

    Expansion one_of(xml::Element const& element) {
        auto made = make(Kind::one_of);
        double heaviest = 0;
        for (auto const& alternative : element.children()) {
            made.parts.push_back(item(alternative));
            made.parts.back().weight = alternative.number("weight", 1);
            heaviest = std::max(heaviest, made.parts.back().weight);
        }
        if (heaviest <= 0) throw element.complain("all alternatives have the weight 0");
        for (auto& part : made.parts) part.weight /= heaviest;
        return made;
    }

    Expansion rule_ref(xml::Element const& element) {
        auto const uri = element.token("uri");
        auto const special = element.token("special", "");
        if (uri.has_value() == !special.empty()) throw element.complain("a ruleref needs either 'uri' or 'special'");
        if (special == "GARBAGE") return make(Kind::garbage);
        if (special == "VOID") return make(Kind::never);
        if (special == "NULL") return make(Kind::sequence);
        if (!uri) throw element.complain("unknown special rule " + quoted(special) + "; expected NULL, VOID or GARBAGE");
        if (!uri->starts_with('#'))
            throw element.complain("unsupported uri " + quoted(*uri) + ": expected '#' and the id of a rule of this grammar");
        auto const rule = std::ranges::find(rules_, uri->substr(1), &SrgsGrammar::Rule::id);
        if (rule == rules_.end()) throw element.complain("unknown rule " + quoted(uri->substr(1)));
        auto made = make(Kind::rule);
        made.rule = static_cast<std::size_t>(rule - rules_.begin());
        return made;
    }

    Rules const& rules_;
    std::size_t last_ = 0;
};

// Finds rules that refer to themselves before any word: recognition would not end.
class LeftRecursion {
public:
    explicit LeftRecursion(Rules const& rules) : rules_{rules}, may_be_empty_(rules.size()), state_(rules.size()) {
        for (bool changed = true; std::exchange(changed, false);)
            for (std::size_t i = 0; i < rules.size(); ++i)
                if (!may_be_empty_[i] && may_be_empty(rules[i].expansion)) changed = may_be_empty_[i] = true;
    }

    // Returns the index of the first such rule; nothing if there is none.
    std::optional<std::size_t> find() {
        for (std::size_t i = 0; i < rules_.size(); ++i)
            if (circles(i)) return i;
        return {};
    }

private:
    enum class State : std::uint8_t { fresh, open, done };

    bool may_be_empty(Expansion const& e) const {
        auto const empty = [&](Expansion const& part) { return may_be_empty(part); };
        switch (e.kind) {
            case Kind::sequence:
                return std::ranges::all_of(e.parts, empty);
            case Kind::one_of:
                return std::ranges::any_of(e.parts, empty);
            case Kind::repeat:
                return e.least == 0 || std::ranges::all_of(e.parts, empty);
            case Kind::rule:
                return may_be_empty_[e.rule];
            case Kind::tag:
            case Kind::garbage:
                return true;
            case Kind::token:
            case Kind::never:
                return false;
        }
        return false;
    }

    bool circles(std::size_t rule) {
        if (state_[rule] != State::fresh) return state_[rule] == State::open;
        state_[rule] = State::open;
        bool const found = begins_with_circle(rules_[rule].expansion);
        state_[rule] = State::done;
        return found;
    }

    bool begins_with_circle(Expansion const& e) {
        if (e.kind == Kind::rule) return circles(e.rule);
        for (auto const& part : e.parts) {
            if (begins_with_circle(part)) return true;
            if (e.kind == Kind::sequence && !may_be_empty(part)) return false;
        }
        return false;
    }

    Rules const& rules_;
    std::vector<bool> may_be_empty_;
    std::vector<State> state_;
};

}  // namespace

std::variant<SrgsGrammar, SrgsGrammar::Flaw> SrgsGrammar::read(std::shared_ptr<xml::Schemas const> const& schemas,
                                                               std::string_view document) {
    try {
        auto const root = xml::Document::parse(schemas, "grammar", std::string{document}).root();
        if (root.name() != "grammar") throw root.complain("not an SRGS grammar: the root element must be grammar");
        SrgsGrammar made;
        made.language_ = root.token("lang", "");
        if (auto const& said = made.language_; !is_language(lower_case(said.substr(0, said.find('-')))))
            throw root.complain("the language " + quoted(said) + " cannot be recognized; expected one of " +
                                names_of_languages());
        auto const elements = root.children("rule");
        for (auto const& element : elements) {
            made.rules_.push_back({element.token("id", ""), element.token("scope", "private") == "public", {}});
            if (std::ranges::find(special_rules, made.rules_.back().id) != special_rules.end())
                throw element.complain("the id " + quoted(made.rules_.back().id) + " is reserved for a special rule");
        }
        ExpansionReader reader{made.rules_};
        for (std::size_t i = 0; i < elements.size(); ++i) made.rules_[i].expansion = reader.sequence(elements[i]);
        if (auto const id = root.token("root")) {
            auto const found = std::ranges::find(made.rules_, *id, &Rule::id);
            if (found == made.rules_.end()) throw root.complain("unknown root rule " + quoted(*id));
            made.root_ = static_cast<std::size_t>(found - made.rules_.begin());
        }
        if (auto const circle = LeftRecursion{made.rules_}.find())
            throw elements[*circle].complain("the rule " + quoted(made.rules_[*circle].id) + " refers to itself before any word");
        return made;
    } catch (xml::BadDocument const& bad) {
        return Flaw{bad.what()};
    }
}

std::optional<std::size_t> SrgsGrammar::rule_of(std::string_view active_rule) const {
    active_rule = trimmed(active_rule);
    if (active_rule.starts_with('#')) active_rule.remove_prefix(1);
    if (active_rule.empty()) return root_;
    auto const found = std::ranges::find(rules_, active_rule, &Rule::id);
    if (found == rules_.end()) return {};
    return static_cast<std::size_t>(found - rules_.begin());
}

std::optional<std::string> SrgsGrammar::objection_to(std::string_view active_rule) const {
    auto const rule = rule_of(active_rule);
    if (!rule && trimmed(active_rule).empty()) return "the grammar has no root rule: name one of its public rules";
    if (!rule) return "the grammar has no rule " + quoted(active_rule);
    if (rule == root_ || rules_[*rule].is_public) return {};
    return "the rule " + quoted(active_rule) + " of the grammar is private";
}

}  // namespace rois::basic
