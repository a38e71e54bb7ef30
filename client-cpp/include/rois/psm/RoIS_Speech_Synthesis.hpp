// Speech Synthesis in the C++ PSM (sections 7.6.11 and 7.7; table 44).
#pragma once

#include <string>
#include <vector>

#include "RoIS_Common.hpp"

namespace Speech_Synthesis {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("SpeechSynthesis") {}

    // The speech of the next start(): either plain text or SSML. volume: 0 to 100; language: an ISO 639-1 code; character: one of
    // synthesizable_characters. Empty texts and a negative volume leave their parameters unchanged.
    RoIS_HRI::ReturnCode_t set_parameter(std::string speech_text, std::string SSML_text, RoIS_HRI::Integer volume,
                                         std::string language, RoIS_HRI::RoIS_Identifier character);
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("SpeechSynthesis") {}

    // Parameters that are not set are empty texts, empty lists and -1.
    RoIS_HRI::ReturnCode_t get_parameter(std::string& speech_text, std::string& SSML_text, RoIS_HRI::Integer& volume,
                                         std::string& language, RoIS_HRI::RoIS_Identifier& character,
                                         std::vector<std::string>& synthesizable_languages,
                                         RoIS_HRI::RoIS_IdentifierList& synthesizable_characters);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("SpeechSynthesis", {}) {}  // has no events
};

}  // namespace Speech_Synthesis
