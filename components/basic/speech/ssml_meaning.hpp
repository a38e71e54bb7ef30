// Interprets the markup of W3C SSML: words, languages, voices, durations and prosody. ssml.cpp walks through the document and
// calls it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "basic/speech/passage.hpp"

namespace rois::basic {

struct SsmlAttribute {
    std::string_view name;  // as SSML writes it: "alias", "xml:lang"
    std::string value;
};

class SsmlMeaning {
public:
    // `character`: the voice outside of `voice` elements.
    explicit SsmlMeaning(std::string_view character) : character_{&voice_character(character)} {}

    // Begins an element. `kind` is its local name, empty for elements of other namespaces. Returns the element's language if it
    // is unsupported and the document must be rejected for this reason.
    std::optional<std::string> begin(std::string_view kind, std::span<SsmlAttribute const>);
    void end();

    // Adds text of the current element.
    void say(std::string_view content);

    std::vector<Passage> passages() const;

private:
    // Values of `onlangfailure`: what to do if the voice does not support an element's language.
    enum class OnLanguageFailure : std::uint8_t { refuse, say_nothing, keep_language };

    // The values of pitch, range, contour and volume, in this order; empty: the default.
    using Sound = std::array<std::string, 4>;

    struct Element {
        std::string kind;
        double rate = 1;       // relative to the default rate
        double stress = 1;     // factor of emphasis for the rate
        bool silent = false;   // its content is not spoken
        std::string language;  // empty: not specified
        VoiceCharacter const* character = nullptr;
        OnLanguageFailure on_language_failure = OnLanguageFailure::refuse;
        Sound sound;
        std::optional<Seconds> duration;  // of its whole content
        std::size_t first_piece = 0;
    };

    // A part of a passage's duration.
    struct Piece {
        std::size_t passage;
        Seconds seconds;
        enum class Of : std::uint8_t { words, pause } of;
    };

    std::optional<std::string> speak_language(Element&, std::span<SsmlAttribute const>);
    static void set_voice(Element&, std::span<SsmlAttribute const>);
    static void set_pace(Element&, std::span<SsmlAttribute const>);
    static void set_sound(Element&, std::span<SsmlAttribute const>);
    void part_words(std::string_view kind);
    std::size_t passage_of(Element const&);

    VoiceCharacter const* character_;  // of the document
    std::vector<Element> open_;
    std::vector<Passage> passages_;
    std::vector<Piece> pieces_;
    bool gap_ = false;  // white space before the next word
};

}  // namespace rois::basic
