// Recognizes speech with a grammar: searches the matching ways through its rules and keeps the most likely ones.
#include <algorithm>
#include <map>
#include <memory>
#include <ranges>
#include <utility>

#include "basic/speech/spoken_words.hpp"
#include "basic/speech/srgs_grammar.hpp"

namespace rois::basic {
namespace {

using Expansion = SrgsGrammar::Expansion;
using Kind = Expansion::Kind;

constexpr double alike = 0.65;             // minimum similarity of matching words
constexpr double skipped = 0.9;            // factor of the certainty for each word that GARBAGE skips
constexpr std::size_t most_words = 100;    // of an utterance; longer ones are ignored
constexpr std::size_t kept_at_once = 8;    // ways kept for each end position
constexpr std::size_t most_ways = 50'000;  // limit of the search; beyond it nothing is recognized
constexpr int deepest = 40;                // nested rules

// One step of a way, linked to the previous one.
struct Step {
    std::shared_ptr<Step const> before;
    Expansion const* expansion;  // a token or a tag
    std::size_t from;
    std::size_t to;
    double certainty;
};

// A way through an expansion.
struct Way {
    std::size_t end;
    double certainty;
    std::shared_ptr<Step const> last;
};
using Ways = std::vector<Way>;

// Appends the steps of `then` to `first`.
std::shared_ptr<Step const> joined(std::shared_ptr<Step const> const& first, std::shared_ptr<Step const> const& then) {
    if (!then) return first;
    std::vector<Step const*> steps;
    for (auto const* step = then.get(); step != nullptr; step = step->before.get()) steps.push_back(step);
    auto last = first;
    for (auto const* step : std::views::reverse(steps)) {
        auto copy = *step;
        copy.before = std::move(last);
        last = std::make_shared<Step const>(std::move(copy));
    }
    return last;
}

class Recognition {
public:
    Recognition(std::vector<SrgsGrammar::Rule> const& rules, std::vector<std::string> words)
        : rules_{rules}, words_{std::move(words)} {}

    // Returns the ways that match the whole speech, the most likely first.
    Ways whole(std::size_t rule) {
        Ways ways = through(rules_[rule].expansion, 0, 0);
        std::erase_if(ways, [&](Way const& way) { return way.end != words_.size(); });
        if (ways_ > most_ways) ways.clear();
        return ways;
    }

private:
    Ways const& through(Expansion const& expansion, std::size_t from, int depth) {
        static Ways const none;
        if (ways_ > most_ways || depth > deepest) return none;
        auto const known = known_.find({expansion.number, from});
        if (known != known_.end()) return known->second;
        auto ways = best(find(expansion, from, depth));
        ways_ += ways.size() + 1;
        return known_.emplace(std::pair{expansion.number, from}, std::move(ways)).first->second;
    }

    Ways find(Expansion const& expansion, std::size_t from, int depth) {
        switch (expansion.kind) {
            case Kind::sequence:
                return sequence(expansion, from, depth);
            case Kind::one_of:
                return one_of(expansion, from, depth);
            case Kind::repeat:
                return repeat(expansion, from, depth);
            case Kind::token:
                return token(expansion, from);
            case Kind::rule:
                return through(rules_[expansion.rule].expansion, from, depth + 1);
            case Kind::tag:
                return {{from, 1, std::make_shared<Step const>(Step{nullptr, &expansion, from, from, 1})}};
            case Kind::garbage:
                return garbage(from);
            case Kind::never:
                break;
        }
        return {};
    }

    enum class Words : std::uint8_t { any, one_or_more };

    // Continues each way through the expansion, by any number of words or at least one.
    Ways onward(Ways const& ways, Expansion const& expansion, int depth, Words more = Words::any) {
        Ways further;
        for (auto const& way : ways)
            for (auto const& next : through(expansion, way.end, depth))
                if (more == Words::any || next.end > way.end)
                    further.push_back({next.end, way.certainty * next.certainty, joined(way.last, next.last)});
        return best(std::move(further));
    }

    Ways sequence(Expansion const& expansion, std::size_t from, int depth) {
        Ways ways{{from, 1, nullptr}};
        for (auto const& part : expansion.parts) ways = onward(ways, part, depth);
        return ways;
    }

    Ways one_of(Expansion const& expansion, std::size_t from, int depth) {
        Ways ways;
        for (auto const& part : expansion.parts)
            for (auto way : through(part, from, depth)) {
                way.certainty *= part.weight;
                if (way.certainty > 0) ways.push_back(std::move(way));
            }
        return ways;
    }

    // Repetitions beyond the minimum must match at least one word each.
    Ways repeat(Expansion const& expansion, std::size_t from, int depth) {
        Ways ways{{from, 1, nullptr}};
        Ways ended;
        for (std::size_t times = 0; !ways.empty(); ++times) {
            if (times >= expansion.least) ended.insert(ended.end(), ways.begin(), ways.end());
            if (expansion.most && times == *expansion.most) break;
            ways = onward(ways, expansion.parts.front(), depth, times < expansion.least ? Words::any : Words::one_or_more);
        }
        return ended;
    }

    Ways token(Expansion const& expansion, std::size_t from) const {
        auto const to = from + expansion.words.size();
        if (to > words_.size()) return {};
        double certainty = 1;
        for (std::size_t i = from; i < to; ++i) {
            auto const same = likeness(words_[i], expansion.words[i - from]);
            if (same < alike) return {};
            certainty *= same;
        }
        return {{to, certainty, std::make_shared<Step const>(Step{nullptr, &expansion, from, to, certainty})}};
    }

    Ways garbage(std::size_t from) const {
        Ways ways;
        double certainty = 1;
        for (std::size_t to = from; to <= words_.size(); ++to, certainty *= skipped) ways.push_back({to, certainty, nullptr});
        return ways;
    }

    // Keeps the most likely ways to each end position, sorted by certainty.
    static Ways best(Ways ways) {
        std::ranges::stable_sort(ways, [](Way const& a, Way const& b) { return a.certainty > b.certainty; });
        std::map<std::size_t, std::size_t> count;
        std::erase_if(ways, [&](Way const& way) { return ++count[way.end] > kept_at_once; });
        return ways;
    }

    std::vector<SrgsGrammar::Rule> const& rules_;
    std::vector<std::string> words_;
    std::map<std::pair<std::size_t, std::size_t>, Ways> known_;  // by expansion and start position
    std::size_t ways_ = 0;
};

SrgsGrammar::Hypothesis hypothesis(Way const& way) {
    SrgsGrammar::Hypothesis made;
    made.certainty = way.certainty;
    for (auto const* step = way.last.get(); step != nullptr; step = step->before.get()) {
        if (step->expansion->kind == Kind::tag) {
            made.tags.push_back(step->expansion->text);
        } else {
            made.words.push_back({step->expansion->text, step->from, step->to, step->certainty});
        }
    }
    std::ranges::reverse(made.tags);
    std::ranges::reverse(made.words);
    return made;
}

}  // namespace

std::string SrgsGrammar::Hypothesis::text() const {
    std::string all;
    for (auto const& word : words) all += (all.empty() ? "" : " ") + word.text;
    return all;
}

std::vector<SrgsGrammar::Hypothesis> SrgsGrammar::recognize(std::string_view active_rule, std::string_view speech,
                                                            std::size_t most) const {
    auto words = split_into_words(speech);
    if (words.empty() || words.size() > most_words) return {};
    std::vector<Hypothesis> found;
    for (auto const& way : Recognition{rules_, std::move(words)}.whole(*rule_of(active_rule))) {
        auto next = hypothesis(way);
        auto const same = [&](Hypothesis const& other) { return other.text() == next.text(); };
        if (std::ranges::none_of(found, same)) found.push_back(std::move(next));
        if (found.size() == most) break;
    }
    return found;
}

}  // namespace rois::basic
