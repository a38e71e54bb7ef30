// Speech recognition (7.6.9): what people and other robots say near the robot, as text.
#include <algorithm>
#include <map>
#include <utility>

#include "simulation/basic_components.hpp"
#include "simulation/grammar.hpp"
#include "simulation/languages.hpp"
#include "simulation/parameter_reading.hpp"
#include "simulation/senses.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
namespace {

constexpr std::size_t longest_grammar = 16'384;  // bytes

std::vector<std::string> all_languages() { return {languages.begin(), languages.end()}; }

// The parameter, or ja and en.
std::vector<std::string> languages_of(ParameterList const& parameters) {
    auto const* parameter = find(parameters, "languages");
    return parameter == nullptr ? std::vector<std::string>{"ja", "en"} : parameter->values;
}

class SpeechRecognition final : public ContinuousFunction {
public:
    using ContinuousFunction::ContinuousFunction;

    ParameterList readable_parameters() const override { return {texts("recognizable_languages", all_languages())}; }

private:
    // An utterance that has begun.
    enum class Heard : std::uint8_t { whole, in_part };

    std::optional<std::string> unfit(ParameterList const& parameters) const override {
        auto const wanted = languages_of(parameters);
        if (wanted.empty() || wanted.size() > languages.size())
            return "parameter 'languages' must name one language or more of " + names_of_languages();
        for (auto const& language : wanted)
            if (!is_language(language))
                return "parameter 'languages': " + quoted(language) + " cannot be recognized; those that can are " +
                       names_of_languages();
        auto const grammar = text_of(parameters, "grammar");
        if (grammar.size() > longest_grammar)
            return "parameter 'grammar' is longer than " + std::to_string(longest_grammar) + " bytes";
        if (auto const* flaw = std::get_if<Grammar::Flaw>(&grammar_of(grammar, text_of(parameters, "rule")))) return flaw->reason;
        return {};
    }

    // The grammar read; the last one is kept, since each command of a sequence asks for it.
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

    void begin() override {
        inputs_.clear();
        read_ = missed_until_ = hall().chronicle().last();
    }

    void suspended() override {
        for (auto& [who, heard] : inputs_) heard = Heard::in_part;
    }

    void resumed() override { missed_until_ = hall().chronicle().last(); }

    void sense(Instant when) override {
        for (Happening const& happening : hall().chronicle().since(read_)) {
            read_ = happening.sequence;
            if (happening.who == Entity{robot()}) continue;
            if (happening.kind == Happening::Kind::speech_started) begins(happening, when);
            if (happening.kind == Happening::Kind::speech_finished || happening.kind == Happening::Kind::speech_broken ||
                happening.kind == Happening::Kind::left)
                ends(happening, when);
        }
    }

    void begins(Happening const& speech, Instant when) {
        if (speech.sequence <= missed_until_ || !hears(hall(), robot(), speech.place)) return;
        inputs_[speech.who] = Heard::whole;
        port().event("speech_input_started", {{date_time("timestamp", when.utc)}, {}});
    }

    void ends(Happening const& speech, Instant when) {
        auto const input = inputs_.find(speech.who);
        if (input == inputs_.end()) return;
        bool const whole = input->second == Heard::whole && speech.kind == Happening::Kind::speech_finished;
        inputs_.erase(input);
        port().event("speech_input_finished", {{date_time("timestamp", when.utc)}, {}});
        if (!whole || !hears(hall(), robot(), speech.place)) return;
        if (std::ranges::find(languages_, speech.language) == languages_.end()) return;
        if (auto text = grammar_.match(speech.text))
            port().event("speech_recognized",
                         {{date_time("timestamp", when.utc), texts("recognized_text", {std::move(*text)})}, {}});
    }

    std::vector<std::string> languages_;
    Grammar grammar_;
    mutable std::pair<std::string, std::string> source_;
    mutable std::variant<Grammar, Grammar::Flaw> read_grammar_;
    std::map<Entity, Heard> inputs_;  // whose beginning was told
    std::uint64_t read_ = 0;
    std::uint64_t missed_until_ = 0;  // what began by then was not heard
};

}  // namespace

std::unique_ptr<Component> speech_recognition(Fitting fitting) { return std::make_unique<SpeechRecognition>(std::move(fitting)); }

}  // namespace rois::simulation
