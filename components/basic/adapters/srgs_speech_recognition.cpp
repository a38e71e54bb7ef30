// Speech recognition with W3C SRGS (Annex C.1): reports speech near the robot that matches a grammar, with alternatives.
#include <algorithm>
#include <cmath>
#include <utility>

#include "basic/adapters/example_components.hpp"
#include "basic/base/listening.hpp"
#include "basic/base/parameter_reading.hpp"
#include "basic/body/wire_units.hpp"
#include "basic/speech/languages.hpp"
#include "basic/speech/srgs_grammar.hpp"
#include "types/text/text_encoding.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

constexpr std::size_t longest_grammar = 16'384;  // bytes
constexpr std::size_t most_hypotheses = 5;
constexpr Metres near = 1.5;  // maximum distance from position_of_sound

// Returns the certainty with three digits: "0.875".
std::string certainty_text(double certainty) {
    auto const thousandths = std::to_string(1000 + std::lround(std::clamp(certainty, 0.0, 1.0) * 1000));
    return std::string{thousandths[0] == '2' ? "1." : "0."} + thousandths.substr(1);
}

// NBestType: a line for each hypothesis, the most likely first: certainty, language, text.
std::string n_best_text(std::vector<SrgsGrammar::Hypothesis> const& hypotheses, std::string const& language) {
    std::string lines;
    for (auto const& each : hypotheses)
        lines += (lines.empty() ? "" : "\n") + certainty_text(each.certainty) + " " + language + " " + each.text();
    return lines;
}

// LatticeType: a line for each word of all hypotheses: id, ids of the positions before and after it, certainty, language, text.
std::string lattice_text(std::vector<SrgsGrammar::Hypothesis> const& hypotheses, std::string const& language) {
    std::vector<SrgsGrammar::Word> words;
    auto const same = [](SrgsGrammar::Word const& a, SrgsGrammar::Word const& b) {
        return a.from == b.from && a.to == b.to && a.text == b.text;
    };
    for (auto const& hypothesis : hypotheses)
        for (auto const& word : hypothesis.words)
            if (std::ranges::none_of(words, [&](auto const& other) { return same(word, other); })) words.push_back(word);
    std::ranges::stable_sort(words, {}, [](auto const& word) { return std::pair{word.from, word.to}; });
    std::string lines;
    for (std::size_t i = 0; i < words.size(); ++i)
        lines += (lines.empty() ? "w" : "\nw") + std::to_string(i + 1) + " n" + std::to_string(words[i].from) + " n" +
                 std::to_string(words[i].to) + " " + certainty_text(words[i].certainty) + " " + language + " " + words[i].text;
    return lines;
}

// Returns the document of the parameter: its text, or the content of a data URI (RFC 2397). Nothing for other URIs.
std::optional<std::string> document_of(std::string_view grammar) {
    grammar = trimmed(grammar);
    if (grammar.starts_with('<')) return std::string{grammar};
    auto const comma = grammar.find(',');
    if (!equal_ignoring_case(grammar.substr(0, 5), "data:") || comma == grammar.npos) return {};
    if (grammar.substr(0, comma).ends_with(";base64")) return {};
    return percent_decoded(grammar.substr(comma + 1));
}

Parameter typed(std::string name, std::string type, std::string value) {
    return {.name = std::move(name),
            .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = {}, .version = {}},
            .values = {std::move(value)}};
}

class SrgsSpeechRecognition final : public Listening {
public:
    SrgsSpeechRecognition(Context context, std::shared_ptr<xml::Schemas const> schemas)
        : Listening{with_position_parameter(std::move(context), "position_of_sound")}, schemas_{std::move(schemas)} {}

    ParameterList readable_parameters() const override {
        return {texts("recognizable_languages", {languages.begin(), languages.end()})};
    }

private:
    using ReadGrammar = std::variant<SrgsGrammar, SrgsGrammar::Flaw>;

    std::optional<std::string> parameter_problem(ParameterList const& parameters) const override {
        if (auto const* wanted = find(parameters, "languages"))
            for (auto const& language : wanted->values)
                if (!is_language(language))
                    return "parameter 'languages': " + quoted(language) + " cannot be recognized; expected one of " +
                           names_of_languages();
        if (auto const* position = find(parameters, "position_of_sound"))
            if (position->values.size() > 1 || (!position->values.empty() && !target_from_wire(position->values.front())))
                return "parameter 'position_of_sound' must be one position, x, y, th in mm, mm and degrees";
        auto const grammar = text_of(parameters, "grammar");
        if (grammar.empty()) return {};
        auto const& read = grammar_of(grammar);
        if (auto const* flaw = std::get_if<SrgsGrammar::Flaw>(&read)) return "parameter 'grammar': " + flaw->reason;
        auto const rule = text_of(parameters, "active_rule");
        if (rule.empty()) return {};
        if (auto objection = std::get<SrgsGrammar>(read).objection_to(rule)) return "parameter 'active_rule': " + *objection;
        return {};
    }

    std::optional<std::string> start_problem(ParameterList const& parameters) const override {
        auto const grammar = text_of(parameters, "grammar");
        if (grammar.empty()) return "parameter 'grammar' is mandatory: a grammar of W3C SRGS in XML";
        auto const rule = text_of(parameters, "active_rule");
        if (auto objection = std::get<SrgsGrammar>(grammar_of(grammar)).objection_to(rule))
            return "parameter 'active_rule': " + *objection;
        return {};
    }

    // Reads a grammar. Caches the last one: each command of a sequence needs it.
    ReadGrammar const& grammar_of(std::string_view grammar) const {
        if (grammar == source_ && read_grammar_) return *read_grammar_;
        source_ = grammar;
        auto const document = document_of(grammar);
        if (grammar.size() > longest_grammar) {
            read_grammar_ = SrgsGrammar::Flaw{"is longer than " + std::to_string(longest_grammar) + " bytes"};
        } else if (!document) {
            read_grammar_ = SrgsGrammar::Flaw{"expected the document itself, or a data URI without base64 that holds it"};
        } else {
            read_grammar_ = SrgsGrammar::read(schemas_, *document);
        }
        return *read_grammar_;
    }

    void apply(ParameterList const& parameters) override {
        grammar_ = std::get<SrgsGrammar>(grammar_of(text_of(parameters, "grammar")));
        rule_ = text_of(parameters, "active_rule");
        auto const* wanted = find(parameters, "languages");
        // The default is the grammar's language, "en" for "en-US".
        auto const& own = grammar_.language();
        languages_ = wanted != nullptr ? wanted->values : std::vector<std::string>{lower_case(own.substr(0, own.find('-')))};
        place_.reset();
        auto const* position = find(parameters, "position_of_sound");
        if (position != nullptr && !position->values.empty()) place_ = target(position->values.front())->position;
    }

    bool listens_to(Point const& place) const override { return !place_ || distance(*place_, place) <= near; }

    void began(Instant) override { port().event("speech_input_started", {}); }
    void ended(Instant) override { port().event("speech_input_finished", {}); }

    void heard(HeardSpeech const& speech, Instant when) override {
        if (std::ranges::find(languages_, speech.language) == languages_.end()) return;
        port().event("speech_recognition_started", {});
        auto const hypotheses = grammar_.recognize(rule_, speech.text, most_hypotheses);
        if (!hypotheses.empty()) port().event("speech_recognized", results(hypotheses, speech, when));
        port().event("speech_recognition_finished", {});
    }

    Results results(std::vector<SrgsGrammar::Hypothesis> const& hypotheses, HeardSpeech const& speech, Instant when) const {
        Results results;
        results.parameters = {date_time("timestamp", when.utc),
                              date_time("timestamp_speech_start", speech.began.utc),
                              date_time("timestamp_speech_end", when.utc),
                              typed("nbest", "NBestType", n_best_text(hypotheses, speech.language)),
                              typed("lattice", "LatticeType", lattice_text(hypotheses, speech.language)),
                              texts("meaning", hypotheses.front().tags)};
        if (!speech.source) return results;
        auto const& source = *speech.source;
        results.parameters.push_back(positions("position_of_sound", {to_wire(source.pose)}, body().crs()));
        results.located.push_back(located_entity("position_of_sound", source.ref, source.pose, source.height, source.covariance));
        return results;
    }

    std::shared_ptr<xml::Schemas const> schemas_;
    SrgsGrammar grammar_;
    std::string rule_;
    std::vector<std::string> languages_;
    std::optional<Point> place_;
    mutable std::string source_;
    mutable std::optional<ReadGrammar> read_grammar_;
};

}  // namespace

std::unique_ptr<LocalComponent> srgs_speech_recognition(Context context, std::shared_ptr<xml::Schemas const> schemas) {
    return std::make_unique<SrgsSpeechRecognition>(std::move(context), std::move(schemas));
}

}  // namespace rois::basic
