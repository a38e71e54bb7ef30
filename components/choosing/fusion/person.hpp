// A person as all units together sense them.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "choosing/fusion/track.hpp"

namespace rois::choosing {

// When persons are the same, and how long they are remembered. Distances are in standard deviations of both values together.
struct Matching {
    // Two persons are the same if their positions and their velocities stay this near for
    // `decides_after`. The velocities tell persons who pass each other from one person.
    double same_within = 3;
    double same_speed_within = 2.5;

    // They stay the same until their positions are farther apart than this for `decides_after`.
    double apart_beyond = 5;

    std::chrono::nanoseconds decides_after = std::chrono::milliseconds{500};

    // In metres. Persons farther apart are never the same, however uncertain their positions are.
    double never_beyond = 3;

    // A person whom no unit senses keeps the name for so long.
    std::chrono::nanoseconds memory = std::chrono::seconds{5};
};

// The last estimate of a person whom no unit senses.
struct LastSeen {
    Estimate estimate;
    Steady when;
    Details details{};
};

struct Person {
    std::uint64_t id = 0;  // within this program, never used again
    int number = 0;        // of the name; 0: not announced yet
    std::string name;
    Steady since{};              // of the first track
    std::vector<Track*> tracks;  // at most one for each unit; empty: no unit senses the person
    Estimate now;                // of the last step
    LastSeen last;               // only if `tracks` is empty

    bool is_announced() const { return number != 0; }
    bool is_sensed() const { return !tracks.empty(); }
    bool is_sensed_by(int unit) const {
        return std::ranges::any_of(tracks, [&](Track const* t) { return t->unit() == unit; });
    }
    Estimate at(Steady) const;
    Details const& details() const;
};

// Whether one unit lists both persons.
bool share_a_unit(Person const&, Person const&);

// Returns the fused estimate of tracks at a time, without those of the unit `except`. At least one track must remain.
Estimate fused(std::span<Track* const> tracks, Steady when, int except = -1);

// Returns the distance of two positions in standard deviations, and infinity beyond Matching::never_beyond.
double gap(Matching const&, Estimate const&, Estimate const&);

// Returns the mismatch of a new person and one who was lost: 0 is a perfect place; from 1 on they are not the same.
double misfit(Estimate const& found, Steady when, LastSeen const& lost);

}  // namespace rois::choosing
