// Sound Detection in the C++ PSM (sections 7.6.7 and 7.7; table 40).
#pragma once

#include <string>

#include "RoIS_Common.hpp"

namespace Sound_Detection {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("SoundDetection") {}
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("SoundDetection") {}
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("SoundDetection", {"sound_detected"}) {}

    // The number of sounds has changed.
    virtual void sound_detected(RoIS_HRI::DateTime timestamp, RoIS_HRI::Integer number);

    void deliver(std::string const& event_type, rois::psm::EventResults const& results) override;
};

}  // namespace Sound_Detection
