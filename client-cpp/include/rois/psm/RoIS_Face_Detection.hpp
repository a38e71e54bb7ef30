// Face Detection in the C++ PSM (sections 7.6.5 and 7.7; table 38).
#pragma once

#include <string>

#include "RoIS_Common.hpp"

namespace Face_Detection {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("FaceDetection") {}
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("FaceDetection") {}
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("FaceDetection", {"face_detected"}) {}

    // The number of faces in sight has changed.
    virtual void face_detected(RoIS_HRI::DateTime timestamp, RoIS_HRI::Integer number);

    void deliver(std::string const& event_type, rois::psm::EventResults const& results) override;
};

}  // namespace Face_Detection
