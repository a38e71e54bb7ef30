// Speech synthesis (7.6.11): the robot's voice.
#include <algorithm>

#include "simulation/basic/basic_components.hpp"
#include "simulation/basic/parameter_reading.hpp"
#include "simulation/robot/voice_characters.hpp"
#include "simulation/speech/languages.hpp"
#include "simulation/speech/ssml.hpp"
#include "types/listing.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
namespace {

constexpr std::int32_t default_volume = 50;
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
    using Action::Action;

    // The new text, even if empty, replaces the stored text of the other kind.
    void reconcile(ParameterList& stored, ParameterList const& arrived) const override {
        bool const plain = find(arrived, "speech_text") != nullptr;
        bool const marked_up = find(arrived, "SSML_text") != nullptr;
        if (plain == marked_up) return;
        std::erase_if(stored,
                      [&](Parameter const& p) { return equal_ignoring_case(p.name, plain ? "SSML_text" : "speech_text"); });
    }

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

    std::optional<std::string> start_problem(ParameterList const& parameters) const override {
        if (!text_of(parameters, "speech_text").empty()) return {};
        if (text_of(parameters, "SSML_text").empty()) return "parameter 'speech_text' or 'SSML_text' is mandatory";
        auto const& passages = std::get<SpokenText>(marked_up(parameters)).passages;
        auto const takes_time = [](Passage const& passage) { return passage.duration > 0; };
        if (std::ranges::none_of(passages, takes_time)) return "parameter 'SSML_text' has no text to speak";
        return {};
    }

    void begin(ParameterList const& parameters) override { utterance_ = hall().speak(robot(), utterance_of(parameters)); }

    Utterance utterance_of(ParameterList const& parameters) const {
        Utterance utterance;
        utterance.loudness = integer_of(parameters, "volume").value_or(default_volume) / 100.0;
        if (auto const language = text_of(parameters, "language"); !language.empty()) utterance.language = language;
        utterance.text = text_of(parameters, "speech_text");
        utterance.character = character_of(parameters);
        if (!utterance.text.empty()) return utterance;
        utterance.further = std::get<SpokenText>(marked_up(parameters)).passages;
        for (auto& passage : utterance.further)
            if (passage.language.empty()) passage.language = utterance.language;
        utterance.text = std::move(utterance.further.front().text);
        utterance.language = std::move(utterance.further.front().language);
        utterance.duration = utterance.further.front().duration;
        utterance.prosody = std::move(utterance.further.front().prosody);
        utterance.character = std::move(utterance.further.front().character);
        utterance.further.erase(utterance.further.begin());
        return utterance;
    }

    void act() override {
        switch (hall().speech_state(robot(), utterance_)) {
            case SpeechState::speaking:
            case SpeechState::held:
                return;
            case SpeechState::spoken:
                return end(CompletedStatus::ok);
            case SpeechState::broken:
                return end(CompletedStatus::error, "the speech was broken off");
        }
    }

    void stop() override { hall().break_off(robot(), utterance_); }
    void hold() override { hall().hold_speech(robot(), utterance_); }
    void go_on() override { hall().go_on_speaking(robot(), utterance_); }

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

std::unique_ptr<Component> speech_synthesis(Context context) { return std::make_unique<SpeechSynthesis>(std::move(context)); }

}  // namespace rois::simulation
