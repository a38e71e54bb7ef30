// Navigation in the C++ PSM (sections 7.6.13 and 7.7; table 46).
#pragma once

#include <string>
#include <vector>

#include "RoIS_Common.hpp"

namespace Navigation {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("Navigation") {}

    // The targets of the next start(): points or names of places, in order. time_limit: ms for the whole way, 0 for none.
    // routing_policy: "time" or "distance". Empty lists and texts and a negative limit leave their parameters unchanged.
    RoIS_HRI::ReturnCode_t set_parameter(std::vector<RoLo::Architecture::Data> target_position, RoIS_HRI::Integer time_limit,
                                         std::string routing_policy);
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("Navigation") {}

    // Parameters that are not set are empty texts, empty lists and -1.
    RoIS_HRI::ReturnCode_t get_parameter(std::vector<RoLo::Architecture::Data>& target_position, RoIS_HRI::Integer& time_limit,
                                         std::string& routing_policy);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("Navigation", {}) {}  // has no events
};

}  // namespace Navigation
