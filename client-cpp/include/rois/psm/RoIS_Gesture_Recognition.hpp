// Gesture Recognition in the C++ PSM (sections 7.6.10 and 7.7; table 43).
#pragma once

#include <string>

#include "RoIS_Common.hpp"

namespace Gesture_Recognition {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("GestureRecognition") {}
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("GestureRecognition") {}

    // Parameters that are not set are empty texts, empty lists and -1.
    RoIS_HRI::ReturnCode_t get_parameter(RoIS_HRI::RoIS_IdentifierList& recognizable_gestures);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("GestureRecognition", {"gesture_recognized"}) {}

    // gesture_ref: the most likely gesture first.
    virtual void gesture_recognized(RoIS_HRI::DateTime timestamp, RoIS_HRI::RoIS_IdentifierList gesture_ref);

    void deliver(std::string const& event_type, rois::psm::EventResults const& results) override;
};

}  // namespace Gesture_Recognition
