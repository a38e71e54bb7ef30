// Follow in the C++ PSM (sections 7.6.14 and 7.7; table 47).
#pragma once

#include "RoIS_Common.hpp"

namespace Follow {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("Follow") {}

    // The person or object that the next start() follows. distance: mm, the robot waits while it is closer; time_limit: ms, 0 for
    // none. An empty identifier and negative numbers leave their parameters unchanged.
    RoIS_HRI::ReturnCode_t set_parameter(RoIS_HRI::RoIS_Identifier target_object_ref, RoIS_HRI::Integer distance,
                                         RoIS_HRI::Integer time_limit);
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("Follow") {}

    // Parameters that are not set are empty texts, empty lists and -1.
    RoIS_HRI::ReturnCode_t get_parameter(RoIS_HRI::RoIS_Identifier& target_object_ref, RoIS_HRI::Integer& distance,
                                         RoIS_HRI::Integer& time_limit);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("Follow", {}) {}  // has no events
};

}  // namespace Follow
