// Sound Localization in the C++ PSM (sections 7.6.8 and 7.7; table 41).
#pragma once

#include <string>
#include <vector>

#include "RoIS_Common.hpp"

namespace Sound_Localization {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("SoundLocalization") {}

    // detection_threshold: how far a sound must have moved for a new event (mm). minimum_interval: the shortest time between two
    // events (ms). A negative value leaves the parameter unchanged.
    RoIS_HRI::ReturnCode_t set_parameter(RoIS_HRI::Integer detection_threshold, RoIS_HRI::Integer minimum_interval);
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("SoundLocalization") {}

    // Parameters that are not set are -1.
    RoIS_HRI::ReturnCode_t get_parameter(RoIS_HRI::Integer& detection_threshold, RoIS_HRI::Integer& minimum_interval);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("SoundLocalization", {"sound_localized"}) {}

    // The sounds and their positions: two lists in the same order.
    virtual void sound_localized(RoIS_HRI::DateTime timestamp, RoIS_HRI::RoIS_IdentifierList sound_ref,
                                 std::vector<RoLo::Architecture::Data> position_data);

    void deliver(std::string const& event_type, rois::psm::EventResults const& results) override;
};

}  // namespace Sound_Localization
