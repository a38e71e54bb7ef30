// Move in the C++ PSM (sections 7.6.15 and 7.7).
#pragma once

#include <vector>

#include "RoIS_Common.hpp"

namespace Move {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("Move") {}

    // The next motion, in the robot's own frame: either a line or a curve; the other list is empty.
    // line: {distance mm, orientation degree}. The robot turns on the spot by the orientation, to the left when positive, then
    // drives the distance straight on, backwards when negative.
    // curve: {radius mm, direction degree}. The robot drives along a circle until its heading has changed by the direction, to
    // the left when positive. A negative radius drives backwards.
    // time: ms for the motion; a negative one leaves the parameter unchanged.
    RoIS_HRI::ReturnCode_t set_parameter(std::vector<RoIS_HRI::Integer> line, std::vector<RoIS_HRI::Integer> curve,
                                         RoIS_HRI::Integer time);
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("Move") {}

    // Parameters that are not set are empty texts, empty lists and -1.
    RoIS_HRI::ReturnCode_t get_parameter(std::vector<RoIS_HRI::Integer>& line, std::vector<RoIS_HRI::Integer>& curve,
                                         RoIS_HRI::Integer& time);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("Move", {}) {}  // has no events
};

}  // namespace Move
