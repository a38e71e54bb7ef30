// The temporary names by which robots know people, and whom they have identified.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "simulation/entity.hpp"
#include "simulation/pose.hpp"

namespace rois::simulation {

class Tracks {
public:
    explicit Tracks(WorldTime memory) : memory_(memory) {}

    void see(PersonId, WorldTime now);  // gives a new name when there is none
    void identify(PersonId);            // a known person who was recognized
    void forget_lost(WorldTime now);    // the names of those not seen for longer than the memory, and who they are
    void leave(PersonId);

    std::optional<std::string> name(PersonId) const;
    std::optional<PersonId> find(std::string_view name) const;
    bool identified(PersonId) const;
    bool was_given(std::string_view name) const;  // to anybody, at any time

private:
    struct Track {
        std::uint64_t number = 0;  // 0: has no name now
        WorldTime seen{};
        bool identified = false;
    };
    WorldTime memory_;
    std::map<PersonId, Track> tracks_;
    std::uint64_t last_number_ = 0;
};

}  // namespace rois::simulation
