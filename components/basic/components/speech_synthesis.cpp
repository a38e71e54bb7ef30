// Speech synthesis (7.6.11): the robot's voice.
#include <algorithm>

#include "basic/base/parameter_reading.hpp"
#include "basic/components/basic_components.hpp"
#include "basic/speech/languages.hpp"
#include "basic/speech/ssml.hpp"
#include "basic/speech/voice_characters.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

constexpr std::int32_t default_volume = 50;
constexpr std::string_view default_language = "en";
constexpr std::size_t longest_text = 16'384;  // bytes

std::optional<std::string> too_long(ParameterList const& parameters, std::string_view name) {
    if (text_of(parameters, name).size() <= longest_text) return {};
    return "parameter '" + std::string{name} + "' is longer than " + std::to_string(longest_text) + " bytes";
}

std::optional<std::string> unknown_language(std::string_view language) {
    if (language.empty() || is_language(language)) return {};
    return "parameter 'language': " + quoted(language) + " cannot be synthesized; expected one of " + names_of_languages();
}

class SpeechSynthesis final : public Action {
public:
    explicit SpeechSynthesis(Context context) : Action{with_alternatives(std::move(context), {"speech_text", "SSML_text"})} {}

    ParameterList readable_parameters() const override {
        return {texts("synthesizable_languages", {languages.begin(), languages.end()}),
                texts("synthesizable_characters", names_of_voice_characters())};
    }

private:
    std::optional<std::string> parameter_problem(ParameterList const& parameters) const override {
        if (auto problem = not_between(parameters, "volume", 0, 100)) return problem;
        if (auto problem = unknown_language(text_of(parameters, "language"))) return problem;
        auto const character = text_of(parameters, "character");
        if (!character.empty() && find_voice_character(character) == nullptr)
            return "parameter 'character': " + quoted(character) +
                   " is not one of the synthesizable_characters: " + listed(names_of_voice_characters());
        if (auto problem = too_long(parameters, "speech_text")) return problem;
        if (auto problem = too_long(parameters, "SSML_text")) return problem;
        auto const document = text_of(parameters, "SSML_text");
        if (document.empty()) return {};
        if (!text_of(parameters, "speech_text").empty())
            return "'speech_text' and 'SSML_text' exclude each other: set only one of them";
        auto const& read = marked_up(parameters);
        if (auto const* bad = std::get_if<BadSsml>(&read)) return "parameter 'SSML_text': " + bad->reason;
        return {};
    }

    std::variant<Plan, Refused> plan(ParameterList const& parameters) override {
        if (text_of(parameters, "speech_text").empty() && text_of(parameters, "SSML_text").empty())
            return Refused{"parameter 'speech_text' or 'SSML_text' is mandatory"};
        auto utterance = utterance_of(parameters);
        auto const takes_time = [](Passage const& passage) { return passage.duration > 0; };
        if (text_of(parameters, "speech_text").empty() && std::ranges::none_of(utterance.passages, takes_time))
            return Refused{"parameter 'SSML_text' has no text to speak"};
        return [this, utterance = std::move(utterance)] { utterance_ = body().speech().speak(utterance); };
    }

    Utterance utterance_of(ParameterList const& parameters) const {
        auto const loudness = integer_of(parameters, "volume").value_or(default_volume) / 100.0;
        auto const asked = text_of(parameters, "language");
        std::string const language{asked.empty() ? default_language : asked};
        if (auto const plain = text_of(parameters, "speech_text"); !plain.empty()) {
            auto const& voice = voice_character(text_of(parameters, "character"));
            return {{{.text = std::string{plain},
                      .language = language,
                      .duration = speech_duration(plain) / voice.pace,
                      .character = std::string{voice.name}}},
                    loudness};
        }
        Utterance utterance{std::get<SpokenText>(marked_up(parameters)).passages, loudness};
        for (auto& passage : utterance.passages)
            if (passage.language.empty()) passage.language = language;
        return utterance;
    }

    void act() override {
        switch (body().speech().state(utterance_)) {
            case SpeechState::speaking:
            case SpeechState::held:
                return;
            case SpeechState::spoken:
                return end(CompletedStatus::ok);
            case SpeechState::broken:
                return end(CompletedStatus::error, "the speech was broken off");
        }
    }

    void stop() override { body().speech().break_off(utterance_); }
    void hold() override { body().speech().hold(utterance_); }
    void go_on() override { body().speech().go_on(utterance_); }

    static std::string_view character_of(ParameterList const& parameters) {
        return voice_character(text_of(parameters, "character")).name;
    }

    // Reads SSML_text. Caches the last one: each command of a sequence needs it.
    std::variant<SpokenText, BadSsml> const& marked_up(ParameterList const& parameters) const {
        auto const document = text_of(parameters, "SSML_text"), character = character_of(parameters);
        if (document != document_ || character != character_) {
            read_ = read_ssml(document, character);
            document_ = document;
            character_ = character;
        }
        return read_;
    }

    UtteranceId utterance_{};
    mutable std::string document_, character_;
    mutable std::variant<SpokenText, BadSsml> read_;
};

}  // namespace

std::unique_ptr<LocalComponent> speech_synthesis(Context context) {
    return std::make_unique<SpeechSynthesis>(std::move(context));
}

}  // namespace rois::basic
