#include "simulation/world/tracks.hpp"

#include "types/text/texts.hpp"

namespace rois::simulation {

void Tracks::see(PersonId person, WorldTime now) {
    Track& track = tracks_[person];
    if (track.number == 0) track.number = ++last_number_;
    track.seen = now;
}

void Tracks::identify(PersonId person) { tracks_[person].identified = true; }

void Tracks::forget_lost(WorldTime now) {
    for (auto& [person, track] : tracks_) {
        if (now - track.seen <= memory_) continue;
        track.number = 0;
        track.identified = false;
    }
}

void Tracks::leave(PersonId person) { tracks_.erase(person); }

std::optional<std::string> Tracks::name(PersonId person) const {
    auto found = tracks_.find(person);
    if (found == tracks_.end() || found->second.number == 0) return std::nullopt;
    return "person-" + std::to_string(found->second.number);
}

std::optional<PersonId> Tracks::find(std::string_view wanted) const {
    for (auto const& [person, track] : tracks_) {
        if (name(person) == wanted) return person;
    }
    return std::nullopt;
}

bool Tracks::was_given(std::string_view name) const {
    constexpr std::string_view prefix = "person-";
    if (!name.starts_with(prefix)) return false;
    auto const number = to_int(name.substr(prefix.size()));
    return number && *number > 0 && static_cast<std::uint64_t>(*number) <= last_number_;
}

bool Tracks::identified(PersonId person) const {
    auto found = tracks_.find(person);
    return found != tracks_.end() && found->second.identified;
}

}  // namespace rois::simulation
