// Person Detection in the C++ PSM (sections 7.6.2 and 7.7; table 35).
#pragma once

#include <string>

#include "RoIS_Common.hpp"

namespace Person_Detection {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("PersonDetection") {}
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("PersonDetection") {}
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("PersonDetection", {"person_detected"}) {}

    // The number of people in sight has changed.
    virtual void person_detected(RoIS_HRI::DateTime timestamp, RoIS_HRI::Integer number);

    void deliver(std::string const& event_type, rois::psm::EventResults const& results) override;
};

}  // namespace Person_Detection
