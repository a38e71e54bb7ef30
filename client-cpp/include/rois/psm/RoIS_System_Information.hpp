// System Information in the C++ PSM (sections 7.6.1 and 7.7; table 34).
#pragma once

#include <vector>

#include "RoIS_Common.hpp"

// The published header has this line.
using namespace RoIS_Common;

namespace System_Information {

class Query {
public:
    // The positions of all robots of the engine: robot_ref and position_data in the same order.
    RoIS_HRI::ReturnCode_t robot_position(RoIS_HRI::DateTime& timestamp, RoIS_HRI::RoIS_IdentifierList& robot_ref,
                                          std::vector<RoLo::Architecture::Data>& position_data);

    // The status of the whole engine. operable_time is empty if the engine does not report it.
    RoIS_HRI::ReturnCode_t engine_status(RoIS_Common::Component_Status& status, std::vector<RoIS_HRI::DateTime>& operable_time);
};

}  // namespace System_Information
