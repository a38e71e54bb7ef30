#include "basic/speech/ssml_meaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "basic/speech/languages.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

constexpr Seconds longest_break = 60;
constexpr Seconds longest_duration = 600;
constexpr Seconds shortest_speech = 0.5;
constexpr double least_rate = 0.2;
constexpr double greatest_rate = 5;
constexpr int grown_up = 14;  // years; a younger `voice` is a child's voice

struct Word {
    std::string_view name;
    double value;
};
constexpr std::array<Word, 6> rates{
    {{"x-slow", 0.5}, {"slow", 0.75}, {"medium", 1}, {"default", 1}, {"fast", 1.5}, {"x-fast", 2}}};
constexpr std::array<Word, 6> strengths{
    {{"none", 0}, {"x-weak", 0.1}, {"weak", 0.25}, {"medium", 0.5}, {"strong", 0.75}, {"x-strong", 1.5}}};
constexpr std::array<Word, 4> emphases{{{"strong", 0.8}, {"moderate", 0.9}, {"none", 1}, {"reduced", 1.1}}};

constexpr std::array<std::string_view, 4> sounds{"pitch", "range", "contour", "volume"};  // attributes of `prosody`
constexpr std::array<std::string_view, 5> pitches{"x-low", "low", "medium", "high", "x-high"};
constexpr std::array<std::string_view, 6> volumes{"silent", "x-soft", "soft", "medium", "loud", "x-loud"};

// Elements whose content is not spoken.
constexpr std::array<std::string_view, 4> silent_kinds{"metadata", "meta", "desc", "lexicon"};

// Elements that separate words. Other elements may occur within a word.
constexpr std::array<std::string_view, 7> word_ends{"break", "p", "s", "sub", "audio", "w", "token"};

template <std::size_t size>
bool is_one_of(std::array<std::string_view, size> const& all, std::string_view kind) {
    return std::ranges::find(all, kind) != all.end();
}

std::optional<double> look_up(std::span<Word const> words, std::string_view name) {
    auto const found = std::ranges::find(words, name, &Word::name);
    if (found == words.end()) return {};
    return found->value;
}

// SSML 1.1, 3.2.4: a name, a percentage or a factor is relative to the default rate; a value with a sign (SSML 1.0) is relative
// to the outer rate. Returns nothing for invalid values.
std::optional<double> rate_of(std::string_view text, double around) {
    if (auto const named = look_up(rates, text)) return named;
    bool const is_change = text.starts_with('+') || text.starts_with('-');
    bool const percent = text.ends_with('%');
    if (percent) text.remove_suffix(1);
    auto const number = to_double(text);
    if (!number || !(std::abs(*number) < 1e6)) return {};
    double const factor = percent ? *number / 100 : *number;
    return is_change ? around * (1 + factor) : factor;
}

// Reads "500ms" or "1.5s". Returns nothing for invalid values.
std::optional<Seconds> time_of(std::string_view text, Seconds longest) {
    bool const milliseconds = text.ends_with("ms");
    if (!text.ends_with('s')) return {};
    text.remove_suffix(milliseconds ? 2 : 1);
    auto const number = to_double(text);
    if (!number || !(*number >= 0)) return {};
    return std::min(milliseconds ? *number / 1000 : *number, longest);
}

// Whether the text is a number with an optional unit: "+10", "-2.5st", "120Hz".
bool is_measure(std::string_view text, std::span<std::string_view const> units) {
    if (text.starts_with('+')) text.remove_prefix(1);
    auto const unit = std::ranges::find_if(units, [&](std::string_view u) { return text.ends_with(u); });
    if (unit != units.end()) text.remove_suffix(unit->size());
    return to_double(text).has_value();
}

// Whether the value is valid for this attribute of `sounds`.
bool is_sound(std::string_view attribute, std::string_view value) {
    constexpr std::size_t longest = 200;  // bytes
    constexpr std::string_view contour_signs = "0123456789+-.%,() abcdefghijklmnopqrstuvwxyzH";
    constexpr std::array<std::string_view, 3> pitch_units{"Hz", "st", "%"};
    constexpr std::array<std::string_view, 2> volume_units{"dB", "%"};
    if (value.size() > longest) return false;
    if (attribute == "contour")
        return value.starts_with('(') && value.ends_with(')') && value.find_first_not_of(contour_signs) == std::string_view::npos;
    if (attribute == "volume") return is_one_of(volumes, value) || is_measure(value, volume_units);
    return is_one_of(pitches, value) || is_measure(value, pitch_units);
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// Returns the trimmed value; nothing if the attribute is missing.
std::optional<std::string_view> value_of(std::span<SsmlAttribute const> attributes, std::string_view name) {
    auto const found = std::ranges::find(attributes, name, &SsmlAttribute::name);
    if (found == attributes.end()) return {};
    return trimmed(found->value);
}

// Returns the first known voice of a list of names; null if there is none.
VoiceCharacter const* named_voice(std::string_view names) {
    while (!names.empty()) {
        auto const end = std::min(names.find_first_of(" \t\r\n"), names.size());
        if (auto const* found = find_voice_character(names.substr(0, end))) return found;
        names = trimmed(names.substr(end));
    }
    return nullptr;
}

Seconds break_time(std::span<SsmlAttribute const> attributes) {
    if (auto const time = value_of(attributes, "time"))
        if (auto const seconds = time_of(*time, longest_break)) return *seconds;
    auto const strength = value_of(attributes, "strength");
    return (strength ? look_up(strengths, *strength) : std::nullopt).value_or(0.5);
}

}  // namespace

std::optional<std::string> SsmlMeaning::begin(std::string_view kind, std::span<SsmlAttribute const> attributes) {
    Element element;
    if (open_.empty()) {
        element.character = character_;
    } else {
        element = open_.back();
    }
    element.kind = kind;
    element.duration.reset();
    element.first_piece = pieces_.size();
    if (is_one_of(silent_kinds, kind)) element.silent = true;
    auto unsupported = speak_language(element, attributes);
    set_voice(element, attributes);
    set_pace(element, attributes);
    set_sound(element, attributes);
    part_words(kind);
    if (kind == "break" && !element.silent)
        pieces_.push_back(
            {passages_.empty() ? passage_of(element) : passages_.size() - 1, break_time(attributes), Piece::Of::pause});
    open_.push_back(std::move(element));
    if (auto const alias = value_of(attributes, "alias"); alias && kind == "sub") {
        say(*alias);
        open_.back().silent = true;
    }
    return unsupported;
}

// Ignores the region of a language: "en" for "en-US".
std::optional<std::string> SsmlMeaning::speak_language(Element& element, std::span<SsmlAttribute const> attributes) {
    if (auto const what = value_of(attributes, "onlangfailure")) {
        element.on_language_failure = *what == "ignoretext"   ? OnLanguageFailure::say_nothing
                                      : *what == "ignorelang" ? OnLanguageFailure::keep_language
                                                              : OnLanguageFailure::refuse;
    }
    auto const said = value_of(attributes, "xml:lang");
    if (!said || element.silent) return {};
    auto language = lower_case(said->substr(0, said->find('-')));
    if (language.empty() || is_language(language)) {
        element.language = std::move(language);
        return {};
    }
    if (element.on_language_failure == OnLanguageFailure::refuse) return std::string{*said};
    element.silent = element.on_language_failure == OnLanguageFailure::say_nothing;
    return {};
}

// Keeps the voice if no character matches (SSML 1.1: onvoicefailure="keepexisting").
void SsmlMeaning::set_voice(Element& element, std::span<SsmlAttribute const> attributes) {
    if (element.kind != "voice") return;
    if (auto const* named = named_voice(value_of(attributes, "name").value_or(""))) {
        element.character = named;
        return;
    }
    auto const years = value_of(attributes, "age");
    auto const age = years ? to_int(*years) : std::nullopt;
    auto const gender = value_of(attributes, "gender").value_or("");
    auto const* const meant = find_voice_character(age && *age >= 0 && *age < grown_up      ? "child"
                                                   : gender == "female" || gender == "male" ? gender
                                                   : gender == "neutral"                    ? default_character
                                                                                            : "");
    if (meant != nullptr) element.character = meant;
}

void SsmlMeaning::set_pace(Element& element, std::span<SsmlAttribute const> attributes) {
    if (element.kind == "prosody") {
        if (auto const rate = value_of(attributes, "rate"))
            element.rate = std::clamp(rate_of(*rate, element.rate).value_or(element.rate), least_rate, greatest_rate);
        if (auto const duration = value_of(attributes, "duration")) element.duration = time_of(*duration, longest_duration);
        if (element.duration && *element.duration <= 0) element.duration.reset();
    } else if (element.kind == "emphasis") {
        element.stress *= look_up(emphases, value_of(attributes, "level").value_or("moderate")).value_or(1);
        element.stress = std::clamp(element.stress, least_rate, greatest_rate);
    }
}

// Ignores empty and invalid values.
void SsmlMeaning::set_sound(Element& element, std::span<SsmlAttribute const> attributes) {
    if (element.kind != "prosody") return;
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        auto const value = value_of(attributes, sounds[i]);
        if (!value) continue;
        if (*value == "default") element.sound[i].clear();
        if (is_sound(sounds[i], *value)) element.sound[i] = *value;
    }
}

void SsmlMeaning::end() {
    auto const element = std::move(open_.back());
    open_.pop_back();
    part_words(element.kind);
    if (!element.duration) return;
    Seconds usual = 0;
    auto const inside = std::span{pieces_}.subspan(element.first_piece);
    for (Piece const& piece : inside) usual += piece.seconds;
    if (usual <= 0) return;
    for (Piece& piece : inside) piece.seconds *= *element.duration / usual;
}

void SsmlMeaning::part_words(std::string_view kind) { gap_ = gap_ || is_one_of(word_ends, kind); }

// A new language, voice or prosody begins a new passage.
std::size_t SsmlMeaning::passage_of(Element const& element) {
    std::string prosody;
    for (std::size_t i = 0; i < sounds.size(); ++i)
        if (!element.sound[i].empty())
            prosody += std::string{prosody.empty() ? "" : ", "} + std::string{sounds[i]} + ' ' + element.sound[i];
    auto const differs = [&](Passage const& last) {
        return last.language != element.language || last.prosody != prosody || last.character != element.character->name;
    };
    bool const another = passages_.empty() || (!passages_.back().text.empty() && differs(passages_.back()));
    if (another) passages_.emplace_back();
    passages_.back().language = element.language;
    passages_.back().character = element.character->name;
    passages_.back().prosody = std::move(prosody);
    return passages_.size() - 1;
}

void SsmlMeaning::say(std::string_view content) {
    auto const& element = open_.back();
    if (element.silent) return;
    std::string said;
    Passage* passage = nullptr;
    for (char const c : content) {
        if (is_blank(c)) {
            gap_ = true;
            continue;
        }
        if (passage == nullptr) passage = &passages_[passage_of(element)];
        if (std::exchange(gap_, false) && !(passage->text.empty() && said.empty())) said += ' ';
        said += c;
    }
    if (passage == nullptr) return;
    passage->text += said;
    double const rate = std::clamp(element.rate * element.stress, least_rate, greatest_rate) * element.character->pace;
    pieces_.push_back({passages_.size() - 1, spoken_seconds(said) / rate, Piece::Of::words});
}

std::vector<Passage> SsmlMeaning::passages() const {
    auto all = passages_;
    Seconds words = 0;
    for (Piece const& piece : pieces_) {
        all[piece.passage].duration += piece.seconds;
        if (piece.of == Piece::Of::words) words += piece.seconds;
    }
    if (words > 0 && words < shortest_speech) all.front().duration += shortest_speech - words;
    return all;
}

}  // namespace rois::basic
