#include "choosing/fusion/people.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "choosing/fusion/assignment.hpp"

namespace rois::choosing {
namespace {

// How much smaller the sum of the squared distances must become before a track changes to another person.
constexpr double clearly_better = 3;

// How long a new person near another one waits for a decision, in multiples of Matching::decides_after.
constexpr int longest_wait = 3;

bool is_older(Person const& a, Person const& b) {
    if (a.is_announced() != b.is_announced()) return a.is_announced();
    return a.is_announced() ? a.number < b.number : a.id < b.id;
}

}  // namespace

void People::add(Track& track, Steady when) {
    Person person;
    person.id = ++last_id_;
    person.since = when;
    person.tracks.push_back(&track);
    person.now = track.at(when);
    track.person = person.id;
    track.joined = when;
    all_.emplace(person.id, std::move(person));
}

void People::remove(Track& track, Steady when) {
    Person& person = all_.at(track.person);
    std::erase(person.tracks, &track);
    if (person.is_sensed()) return;
    contacts_.erase(person.id);
    if (!person.is_announced()) {
        all_.erase(track.person);
        return;
    }
    Steady const seen = track.stands(when) ? when : track.measured();
    person.last = {track.at(seen), seen, track.details()};
}

void People::bring_back(Track& track, Steady when) {
    auto const found = all_.find(track.person);
    if (found == all_.end() || found->second.is_sensed_by(track.unit())) return add(track, when);
    found->second.tracks.push_back(&track);
    found->second.now = found->second.at(when);
    track.apart_since.reset();
}

void People::step(int units, Steady when) {
    refresh(when);
    split(when);
    contacts_.update(all_, matching_, when);
    for (auto const& [one, other] : contacts_.decided(all_, matching_, units, when)) merge(one, other, when);
    settle(when);
    forget_lost(when);
}

Person const* People::find(std::string_view name) const {
    for (auto const& [id, person] : all_)
        if (person.is_announced() && person.name == name) return &person;
    return nullptr;
}

std::vector<Change> People::take_changes() { return std::exchange(changes_, {}); }

void People::refresh(Steady when) {
    for (auto& [id, person] : all_) {
        for (Track* track : person.tracks) track->now = track->at(when);
        person.now = person.at(when);
    }
}

// Takes tracks out of their persons if they have lain apart for long enough. Each becomes a new person without a name.
void People::split(Steady when) {
    std::vector<Track*> leaving;
    for (auto& [id, person] : all_) {
        if (person.tracks.size() < 2) continue;
        for (Track* track : person.tracks) {
            if (!is_apart(person, *track, when)) {
                track->apart_since.reset();
            } else if (!track->apart_since) {
                track->apart_since = when;
            }
        }
        if (Track* track = to_leave(person, when)) leaving.push_back(track);
    }
    for (Track* track : leaving) {
        Person& person = all_.at(track->person);
        std::erase(person.tracks, track);
        person.now = person.at(when);
        track->apart_since.reset();
        add(*track, when);
    }
}

// Returns the track that lies farthest from the others of its person; of two that are left, the one that joined last. So the name
// stays with the majority, or with those who had it first.
Track* People::to_leave(Person const& person, Steady when) const {
    Track* farthest = nullptr;
    double most = 0;
    for (Track* track : person.tracks) {
        if (!track->apart_since || when - *track->apart_since < matching_.decides_after) continue;
        double const distance =
            person.tracks.size() == 2 ? 0 : gap(matching_, track->now, fused(person.tracks, when, track->unit()));
        bool const later = farthest && distance == most && track->joined > farthest->joined;
        if (!farthest || distance > most || later) {
            farthest = track;
            most = distance;
        }
    }
    return farthest;
}

bool People::is_apart(Person const& person, Track const& track, Steady when) const {
    Estimate const rest = fused(person.tracks, when, track.unit());
    double const distance = gap(matching_, track.now, rest);
    if (distance > matching_.apart_beyond) return true;
    if (distance * distance < clearly_better) return false;
    return std::ranges::any_of(all_, [&](auto const& entry) {
        return entry.first != person.id && fits_better(track, rest, distance, entry.second, when);
    });
}

// Whether a track belongs to another person rather than to its own. If the other person already has a track of the same unit, the
// two tracks would be exchanged. `rest`: the track's own person without the track, at this distance.
bool People::fits_better(Track const& track, Estimate const& rest, double distance, Person const& other, Steady when) const {
    if (!other.is_sensed() || gap(matching_, track.now, other.now) > matching_.apart_beyond) return false;
    auto const rival = std::ranges::find_if(other.tracks, [&](Track const* t) { return t->unit() == track.unit(); });
    bool const has_rival = rival != other.tracks.end();
    if (has_rival && other.tracks.size() == 1) return false;
    Estimate const others = has_rival ? fused(other.tracks, when, track.unit()) : other.now;
    double const then = gap(matching_, track.now, others);
    if (then > matching_.same_within) return false;
    double gain = distance * distance - then * then;
    if (has_rival) gain += std::pow(gap(matching_, (*rival)->now, others), 2) - std::pow(gap(matching_, (*rival)->now, rest), 2);
    return gain > clearly_better;
}

void People::merge(std::uint64_t one, std::uint64_t other, Steady when) {
    bool const first = is_older(all_.at(one), all_.at(other));
    Person& kept = all_.at(first ? one : other);
    Person& dropped = all_.at(first ? other : one);
    if (dropped.is_announced()) changes_.push_back({Change::Kind::gone, dropped.name, kept.name});
    move_tracks(dropped, kept, when);
}

// Moves the tracks, and removes the person who had them.
void People::move_tracks(Person& from, Person& to, Steady when) {
    for (Track* track : from.tracks) {
        track->person = to.id;
        track->joined = when;
        track->apart_since.reset();
        to.tracks.push_back(track);
    }
    to.now = to.at(when);
    contacts_.erase(from.id);
    all_.erase(from.id);
}

// Gives names to new persons who are not near another person, or have waited for too long: the name of a lost person if they
// appear where that one may be, or a new one.
void People::settle(Steady when) {
    std::vector<Person*> found;
    std::vector<Person*> lost;
    for (auto& [id, person] : all_) {
        bool const waits = contacts_.has(id) && when - person.since < longest_wait * matching_.decides_after;
        if (person.is_sensed() && !person.is_announced() && !waits) found.push_back(&person);
        if (!person.is_sensed()) lost.push_back(&person);
    }
    Costs costs{found.size(), lost.size()};
    for (std::size_t row = 0; row < found.size(); ++row) {
        for (std::size_t column = 0; column < lost.size(); ++column) {
            double const cost = misfit(found[row]->now, when, lost[column]->last);
            if (cost < 1) costs.at(row, column) = cost - 2;  // two pairs are better than one good pair
        }
    }
    auto const pairs = best_pairs(costs);
    for (std::size_t row = 0; row < found.size(); ++row) {
        if (pairs[row]) {
            move_tracks(*found[row], *lost[*pairs[row]], when);
        } else {
            announce(*found[row]);
        }
    }
}

void People::announce(Person& person) {
    person.number = ++last_number_;
    person.name = prefix_ + std::to_string(person.number);
    changes_.push_back({Change::Kind::appeared, person.name, {}});
}

void People::forget_lost(Steady when) {
    std::erase_if(all_, [&](auto const& entry) {
        Person const& person = entry.second;
        if (person.is_sensed() || when - person.last.when <= matching_.memory) return false;
        changes_.push_back({Change::Kind::gone, person.name, {}});
        return true;
    });
}

}  // namespace rois::choosing
