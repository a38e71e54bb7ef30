// Merges what several units (robots, fixed sensors) sense of persons into one list. Faces and sounds are merged in the same way.
//
// Positions are in metres, in the main engine's frame. Times are passed in, all from one clock: no code here reads a clock.
// Errors are return values. Not thread-safe: the caller makes one call at a time.
//
//   Fusion fusion;
//   fusion.sensed("robot1", when, std::vector<Sighting>{{"person-3", {2.0, 1.5}}});
//   for (Change const& change : fusion.take_changes()) ...
//   for (FusedPerson const& person : fusion.persons(when)) ...
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "choosing/fusion/people.hpp"
#include "choosing/fusion/placement.hpp"

namespace rois::choosing {

// A person as a unit reports them.
struct Sighting {
    std::string name;  // the unit's own; no other unit needs to use the same name for the same person
    Vector position = Vector::Zero();
    Details details{};
    std::optional<Matrix> covariance = std::nullopt;  // in m^2; absent: UnitSettings::deviation
};

// A unit that senses a person, and its name for them.
struct SensedBy {
    std::string unit;
    std::string name;

    bool operator==(SensedBy const&) const = default;
};

struct FusedPerson {
    std::string name;  // "person-1"; never given to another person
    Vector position;
    Matrix covariance;
    Details details{};
    // In the order in which the units were first seen. Empty: no unit senses the person now. The position is then a guess.
    std::vector<SensedBy> sensed_by;
};

// What was wrong with a list of sightings.
struct Problem {
    std::string name;    // of the sighting; empty: the list has too many
    std::string reason;  // "the position is not finite; the sighting is ignored"
};

struct Received {
    enum class Outcome : std::uint8_t { accepted, outdated };
    Outcome outcome = Outcome::accepted;  // outdated: older than the unit's last list, and ignored
    std::vector<Problem> problems{};
};

// A unit whose persons lie beside those of the other units.
struct Misplaced {
    std::string unit;
    Displacement displacement;
    std::string text;  // for people
};

struct FusionSettings {
    std::string prefix = "person-";  // of the names
    Matching matching{};
    std::chrono::nanoseconds longest_age = std::chrono::seconds{10};  // a unit's list without a successor is valid for so long
    std::size_t most_persons = 100;                                   // per unit
};

class Fusion {
public:
    explicit Fusion(FusionSettings settings = {});

    // Sets the properties of a unit. Persons whom it lists already keep the earlier settings. Without a call, the unit has
    // default settings.
    void configure(std::string_view unit, UnitSettings const&);

    // Takes the list of all persons whom a unit senses at `when`. It replaces the unit's previous list. It stays valid until the
    // next one, but at most for `longest_age`. A silent unit says that no person has moved (UnitSettings::period).
    Received sensed(std::string_view unit, Steady when, std::span<Sighting const> list);

    // A unit has left: it senses no person until its next list.
    void lost(std::string_view unit, Steady when);

    // No unit is asked from `when` on. After `wake`, time goes on as if the pause had not been, so that persons who have stayed
    // where they were keep their names. A pause of more than a minute counts.
    void rest(Steady when);
    void wake(Steady when);

    // Lets time pass. Call it at least every 0.1 s; otherwise decisions wait for the next list. Earlier times are ignored.
    void advance(Steady when);

    // Returns the appeared and gone persons since the last call, oldest first. persons() contains those who appeared and are not
    // gone.
    std::vector<Change> take_changes() { return people_.take_changes(); }

    // Returns all persons with a name, oldest first, with their positions at `when`.
    std::vector<FusedPerson> persons(Steady when) const;

    // Returns a unit's name for a person; nothing if the unit does not sense the person now.
    std::optional<std::string> unit_name(std::string_view name, std::string_view unit) const;

    // Returns the fused name of a unit's person; nothing if the unit does not sense the person now, or if it is not yet decided
    // who the person is (usually half a second, at most 1.5 s).
    std::optional<std::string> own_name(std::string_view unit, std::string_view name) const;

    // Returns the units that seem to be misplaced, in the order in which they were first seen. The list changes slowly: a wrong
    // placement takes up to a minute of moving persons to be found. A report stays until persons show that the unit is right
    // again, or the unit is lost.
    std::vector<Misplaced> misplaced() const;

private:
    using Tracks = std::map<std::string, std::unique_ptr<Track>, std::less<>>;  // by the unit's names
    struct Unit {
        std::string name;
        UnitSettings settings;
        std::optional<Steady> last_list;
        Tracks tracks;   // of the last list
        Tracks missing;  // of the list before, or shortly before: a unit may miss a person once
    };
    Steady counted(Steady when) const;  // without the pauses
    void advance_to(Steady when);
    int index_of(std::string_view unit);
    Unit const* find(std::string_view unit) const;
    std::optional<Measurement> checked(Sighting const&, Unit const&, Received&) const;
    void take(int unit, Sighting const&, Measurement const&, Steady when);
    void drop_unlisted(Unit&, std::set<std::string_view> const& listed, Steady when);
    void drop_all(Unit&, Steady when);
    void step(Steady when);
    void compare_units(Steady when);
    void compare(Track const& one, Track const& other, Steady when);
    std::string text_of(int unit, Displacement const&) const;

    FusionSettings settings_;
    std::vector<Unit> units_;
    People people_;
    PlacementCheck placement_;
    std::uint64_t last_track_ = 0;
    std::optional<Steady> rests_since_;
    std::chrono::nanoseconds rested_{};  // pauses that do not count
    std::optional<Steady> now_;          // the latest time that was passed in
    std::optional<Steady> last_step_;    // empty: the next call of advance() makes a step
    Steady last_compared_{};
    Steady last_judged_{};
};

}  // namespace rois::choosing
