// Reaction in the C++ PSM (sections 7.6.12 and 7.7; table 45).
#pragma once

#include "RoIS_Common.hpp"

namespace Reaction {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("Reaction") {}

    // The reaction that the next start() performs: one of available_reactions (annex D). BAD_PARAMETER for more than one.
    RoIS_HRI::ReturnCode_t set_parameter(RoIS_HRI::RoIS_IdentifierList reaction_ref);
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("Reaction") {}

    // Parameters that are not set are empty texts, empty lists and -1.
    RoIS_HRI::ReturnCode_t get_parameter(RoIS_HRI::RoIS_IdentifierList& available_reactions,
                                         RoIS_HRI::RoIS_Identifier& reaction_ref);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("Reaction", {}) {}  // has no events
};

}  // namespace Reaction
