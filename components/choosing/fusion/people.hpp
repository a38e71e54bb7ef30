// The persons in the main engine: joins the tracks of all units, and gives names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "choosing/fusion/contacts.hpp"
#include "choosing/fusion/person.hpp"

namespace rois::choosing {

// A person has got a name, or a name is no longer used.
struct Change {
    enum class Kind : std::uint8_t { appeared, gone };
    Kind kind;
    std::string name;
    // Of `gone`: the person who turned out to be the same. Empty: no unit has sensed the person for Matching::memory.
    std::string merged_into;
};

// A track belongs to exactly one person from add() to remove(); it must not move in memory meanwhile. Two tracks of one unit
// never belong to the same person. Not thread-safe.
class People {
public:
    People(Matching const& matching, std::string prefix) : matching_{matching}, prefix_{std::move(prefix)} {}

    // A unit senses a new person. If another person is near, the new one gets no name until step() has decided whether they are
    // the same.
    void add(Track&, Steady when);

    // A unit no longer senses the person.
    void remove(Track&, Steady when);

    // A unit senses the person of a removed track again, after less than Matching::memory.
    void bring_back(Track&, Steady when);

    // Merges, names and forgets persons. `units`: the number of units.
    void step(int units, Steady when);

    Persons const& all() const { return all_; }
    Person const* find(std::string_view name) const;  // null if unknown

    // Returns the changes since the last call, oldest first.
    std::vector<Change> take_changes();

private:
    void refresh(Steady when);
    void split(Steady when);
    Track* to_leave(Person const&, Steady when) const;
    bool is_apart(Person const&, Track const&, Steady when) const;
    bool fits_better(Track const&, Estimate const& rest, double distance, Person const& other, Steady when) const;
    void merge(std::uint64_t one, std::uint64_t other, Steady when);
    void settle(Steady when);
    void move_tracks(Person& from, Person& to, Steady when);
    void announce(Person&);
    void forget_lost(Steady when);

    Matching matching_;
    std::string prefix_;
    Persons all_;
    Contacts contacts_;
    std::vector<Change> changes_;
    std::uint64_t last_id_ = 0;
    int last_number_ = 0;
};

}  // namespace rois::choosing
