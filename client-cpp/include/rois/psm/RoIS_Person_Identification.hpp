// Person Identification in the C++ PSM (sections 7.6.4 and 7.7; table 37).
#pragma once

#include <string>

#include "RoIS_Common.hpp"

namespace Person_Identification {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("PersonIdentification") {}
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("PersonIdentification") {}
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("PersonIdentification", {"person_identified"}) {}

    // The permanent ids of the people in sight.
    virtual void person_identified(RoIS_HRI::DateTime timestamp, RoIS_HRI::RoIS_IdentifierList person_ref);

    void deliver(std::string const& event_type, rois::psm::EventResults const& results) override;
};

}  // namespace Person_Identification
