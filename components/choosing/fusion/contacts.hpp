// Which persons may be the same, and for how long already.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "choosing/fusion/person.hpp"

namespace rois::choosing {

// The persons by their ids.
using Persons = std::map<std::uint64_t, Person>;

// Two persons, sensed by different units, who lie near each other.
struct Contact {
    std::optional<Steady> close_since;  // positions and velocities are near enough since then
    double squares = 0;                 // sum since then of the squared distances of positions and of velocities
    int samples = 0;
    std::uint64_t round = 0;  // of the last update

    double cost() const { return samples == 0 ? 0 : squares / samples; }
};

// Not thread-safe. Owned by People.
class Contacts {
public:
    // Measures all pairs of persons. Their `now` must be that of `when`. Time: n^2 for n persons.
    void update(Persons const&, Matching const&, Steady when);

    bool has(std::uint64_t person) const;

    // A person has become part of another, or is no longer known.
    void erase(std::uint64_t person);

    using Key = std::pair<std::uint64_t, std::uint64_t>;

    // Returns the pairs that have been the same for long enough: of all possible pairings, those with the smallest cost in
    // total. No person is in two of these pairs.
    // `units`: the number of units.
    std::vector<Key> decided(Persons const&, Matching const&, int units, Steady when) const;

private:
    // The pairs of a person whom the unit senses and one whom it does not sense; none of the persons is in `taken`.
    std::vector<Key> decided_for(int unit, std::set<std::uint64_t> const& taken, Persons const&, Matching const&,
                                 Steady when) const;
    void update(Person const&, Person const&, Matching const&, Steady when);

    std::map<Key, Contact> all_;  // the smaller id first
    std::uint64_t round_ = 0;
};

}  // namespace rois::choosing
