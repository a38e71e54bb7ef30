// What the markup of W3C SSML means: words, languages, voices, time, and how the voice is to sound. Who walks through the
// document (ssml.cpp) feeds it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/robot.hpp"

namespace rois::simulation {

struct SsmlAttribute {
    std::string_view name;  // as SSML writes it: "alias", "xml:lang"
    std::string value;
};

class SsmlMeaning {
public:
    // `character`: the voice of what is in no `voice` element.
    explicit SsmlMeaning(std::string_view character) : character_{&voice_character(character)} {}

    // An element begins: the local name of one of SSML's own, else empty. Says which language it asks for in vain, when that is
    // to be refused.
    std::optional<std::string> begin(std::string_view kind, std::span<SsmlAttribute const>);
    void end();

    // Text, within an element.
    void say(std::string_view content);

    std::vector<Passage> passages() const;

private:
    // What to do when the voice has not the language of an element (`onlangfailure`).
    enum class InVain : std::uint8_t { refuse, say_nothing, keep_language };

    // The values of pitch, range, contour and volume, in this order; empty: as usual.
    using Sound = std::array<std::string, 4>;

    struct Element {
        std::string kind;
        double rate = 1;       // of the default one
        double stress = 1;     // how emphasis changes it
        bool silent = false;   // what is in it is not spoken
        std::string language;  // empty: not said
        VoiceCharacter const* character = nullptr;
        InVain in_vain = InVain::refuse;
        Sound sound;
        std::optional<Seconds> duration;  // in which all that is in it is to be said
        std::size_t first_piece = 0;
    };

    // Some of the time that a passage takes.
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

}  // namespace rois::simulation
