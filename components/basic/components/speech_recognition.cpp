// Speech recognition (7.6.9): reports the speech of people and other robots near the robot as text.
#include <algorithm>
#include <utility>

#include "basic/base/listening.hpp"
#include "basic/base/parameter_reading.hpp"
#include "basic/components/basic_components.hpp"
#include "basic/speech/grammar.hpp"
#include "basic/speech/languages.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

constexpr std::size_t longest_grammar = 16'384;  // bytes

std::vector<std::string> all_languages() { return {languages.begin(), languages.end()}; }

// Returns the parameter's languages, by default ja and en.
std::vector<std::string> languages_of(ParameterList const& parameters) {
    auto const* parameter = find(parameters, "languages");
    return parameter == nullptr ? std::vector<std::string>{"ja", "en"} : parameter->values;
}

class SpeechRecognition final : public Listening {
public:
    using Listening::Listening;

    ParameterList readable_parameters() const override { return {texts("recognizable_languages", all_languages())}; }

private:
    std::optional<std::string> parameter_problem(ParameterList const& parameters) const override {
        auto const wanted = languages_of(parameters);
        if (wanted.empty() || wanted.size() > languages.size())
            return "parameter 'languages' must have at least one language of " + names_of_languages();
        for (auto const& language : wanted)
            if (!is_language(language))
                return "parameter 'languages': " + quoted(language) + " cannot be recognized; expected one of " +
                       names_of_languages();
        auto const grammar = text_of(parameters, "grammar");
        if (grammar.size() > longest_grammar)
            return "parameter 'grammar' is longer than " + std::to_string(longest_grammar) + " bytes";
        if (auto const* flaw = std::get_if<Grammar::Flaw>(&grammar_of(grammar, text_of(parameters, "rule")))) return flaw->reason;
        return {};
    }

    // Reads a grammar. Caches the last one: each command of a sequence needs it.
    std::variant<Grammar, Grammar::Flaw> const& grammar_of(std::string_view grammar, std::string_view rule) const {
        std::pair const source{std::string{grammar}, std::string{rule}};
        if (source != source_) {
            read_grammar_ = Grammar::read(grammar, rule);
            source_ = source;
        }
        return read_grammar_;
    }

    void apply(ParameterList const& parameters) override {
        languages_ = languages_of(parameters);
        grammar_ = std::get<Grammar>(grammar_of(text_of(parameters, "grammar"), text_of(parameters, "rule")));
    }

    void began(Instant when) override { port().event("speech_input_started", {{date_time("timestamp", when.utc)}, {}}); }
    void ended(Instant when) override { port().event("speech_input_finished", {{date_time("timestamp", when.utc)}, {}}); }

    void heard(HeardSpeech const& speech, Instant when) override {
        if (std::ranges::find(languages_, speech.language) == languages_.end()) return;
        if (auto text = grammar_.match(speech.text))
            port().event("speech_recognized",
                         {{date_time("timestamp", when.utc), texts("recognized_text", {std::move(*text)})}, {}});
    }

    std::vector<std::string> languages_;
    Grammar grammar_;
    mutable std::pair<std::string, std::string> source_;
    mutable std::variant<Grammar, Grammar::Flaw> read_grammar_;
};

}  // namespace

std::unique_ptr<LocalComponent> speech_recognition(Context context) {
    return std::make_unique<SpeechRecognition>(std::move(context));
}

}  // namespace rois::basic
