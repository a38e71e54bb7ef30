// Speech Recognition in the C++ PSM (sections 7.6.9 and 7.7; table 42).
#pragma once

#include <string>
#include <vector>

#include "RoIS_Common.hpp"

namespace Speech_Recognition {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("SpeechRecognition") {}

    // languages: ISO 639-1 codes. grammer (sic, the published name): the grammar; rule: its active rule. Empty arguments leave
    // their parameters unchanged.
    RoIS_HRI::ReturnCode_t set_parameter(std::vector<std::string> languages, std::string grammer, std::string rule);
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("SpeechRecognition") {}

    // Parameters that are not set are empty texts, empty lists and -1.
    RoIS_HRI::ReturnCode_t get_parameter(std::vector<std::string>& recognizable_languages, std::vector<std::string>& languages,
                                         std::string& grammer, std::string& rule);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("SpeechRecognition", {"speech_recognized", "speech_input_started", "speech_input_finished"}) {}

    // recognized_text: the most likely text first.
    virtual void speech_recognized(RoIS_HRI::DateTime timestamp, std::vector<std::string> recognized_text);
    virtual void speech_input_started(RoIS_HRI::DateTime timestamp);
    virtual void speech_input_finished(RoIS_HRI::DateTime timestamp);

    void deliver(std::string const& event_type, rois::psm::EventResults const& results) override;
};

}  // namespace Speech_Recognition
