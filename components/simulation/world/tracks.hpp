// The temporary names of people, and the people who have been identified.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "simulation/world/entity.hpp"
#include "simulation/world/units.hpp"

namespace rois::simulation {

class Tracks {
public:
    explicit Tracks(WorldTime memory) : memory_(memory) {}

    void see(PersonId, WorldTime now);  // assigns a new name if the person has none
    void identify(PersonId);            // marks a known person as identified
    void forget_lost(WorldTime now);    // forgets names and identification of people not seen for longer than `memory`
    void leave(PersonId);

    std::optional<std::string> name(PersonId) const;
    std::optional<PersonId> find(std::string_view name) const;
    bool identified(PersonId) const;
    bool was_given(std::string_view name) const;  // ever assigned to a person

private:
    struct Track {
        std::uint64_t number = 0;  // 0: no name
        WorldTime seen{};
        bool identified = false;
    };
    WorldTime memory_;
    std::map<PersonId, Track> tracks_;
    std::uint64_t last_number_ = 0;
};

}  // namespace rois::simulation
