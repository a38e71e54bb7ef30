#include "choosing/fusion/fusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace rois::choosing {
namespace {

using std::chrono::milliseconds;

constexpr auto between_steps = milliseconds{100};
constexpr auto between_comparisons = milliseconds{250};
constexpr auto between_judgements = milliseconds{1000};
constexpr auto short_absence = milliseconds{1500};  // of a person from one unit's lists; the track then continues
constexpr auto longest_rest = std::chrono::minutes{1};
constexpr double farthest_position = 1e6;    // metres; limits rounding errors
constexpr double least_deviation = 0.001;    // metres; a unit cannot be more certain
constexpr double largest_deviation = 100.0;  // metres
constexpr double notable_turn = 0.07;        // radians, 4 degrees

bool is_usable(Matrix const& covariance) {
    return is_covariance(covariance) && covariance.trace() < 2 * largest_deviation * largest_deviation;
}

std::string with_one_decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

}  // namespace

Fusion::Fusion(FusionSettings settings) : settings_{std::move(settings)}, people_{settings_.matching, settings_.prefix} {}

int Fusion::index_of(std::string_view name) {
    auto const found = std::ranges::find(units_, name, &Unit::name);
    if (found != units_.end()) return static_cast<int>(found - units_.begin());
    units_.emplace_back().name = name;
    return static_cast<int>(units_.size()) - 1;
}

Fusion::Unit const* Fusion::find(std::string_view name) const {
    auto const found = std::ranges::find(units_, name, &Unit::name);
    return found == units_.end() ? nullptr : &*found;
}

void Fusion::configure(std::string_view unit, UnitSettings const& settings) {
    units_[static_cast<std::size_t>(index_of(unit))].settings = settings;
}

Received Fusion::sensed(std::string_view name, Steady at, std::span<Sighting const> list) {
    Steady const when = counted(at);
    int const index = index_of(name);
    Unit& unit = units_[static_cast<std::size_t>(index)];
    Received received;
    if (unit.last_list && when < *unit.last_list) {
        received.outcome = Received::Outcome::outdated;
        return received;
    }
    unit.last_list = when;
    if (list.size() > settings_.most_persons) {
        auto const most = std::to_string(settings_.most_persons);
        received.problems.push_back(
            {{}, "the list has " + std::to_string(list.size()) + " entries; only the first " + most + " count"});
        list = list.first(settings_.most_persons);
    }
    std::set<std::string_view> listed;
    bool is_news = false;
    for (Sighting const& sighting : list) {
        auto const measurement = checked(sighting, unit, received);
        if (!measurement) continue;
        if (!listed.insert(sighting.name).second) {
            received.problems.push_back({sighting.name, "the unit lists this name twice; the second sighting is ignored"});
            continue;
        }
        is_news |= !unit.tracks.contains(sighting.name);
        take(index, sighting, *measurement, when);
    }
    is_news |= unit.tracks.size() > listed.size();
    drop_unlisted(unit, listed, when);
    if (is_news) last_step_.reset();
    advance_to(when);
    return received;
}

std::optional<Measurement> Fusion::checked(Sighting const& sighting, Unit const& unit, Received& received) const {
    if (sighting.name.empty()) {
        received.problems.push_back({sighting.name, "the name is empty; the sighting is ignored"});
        return {};
    }
    if (!sighting.position.allFinite() || sighting.position.cwiseAbs().maxCoeff() > farthest_position ||
        !std::isfinite(sighting.details.z)) {
        received.problems.push_back({sighting.name, "the position is not finite, or is too large; the sighting is ignored"});
        return {};
    }
    Matrix covariance = Matrix::Identity() * unit.settings.deviation * unit.settings.deviation;
    if (sighting.covariance && !is_usable(*sighting.covariance)) {
        received.problems.push_back({sighting.name,
                                     "the covariance is not finite, symmetric and positive definite, or is too "
                                     "large; the unit's default is used"});
    } else if (sighting.covariance) {
        covariance = (*sighting.covariance + sighting.covariance->transpose()) / 2;
    }
    covariance += Matrix::Identity() * least_deviation * least_deviation;
    return Measurement{{sighting.position, covariance}, sighting.details};
}

// Continues the unit's track of this name, or begins a new one.
void Fusion::take(int index, Sighting const& sighting, Measurement const& measurement, Steady when) {
    Unit& unit = units_[static_cast<std::size_t>(index)];
    auto& track = unit.tracks[sighting.name];
    if (!track) {
        auto missing = unit.missing.extract(sighting.name);
        if (!missing.empty() && missing.mapped()->can_reach(measurement, when)) {
            track = std::move(missing.mapped());
            people_.bring_back(*track, when);
        }
    }
    if (track && track->can_reach(measurement, when)) return track->measure(measurement, when);
    if (track) people_.remove(*track, when);
    track = std::make_unique<Track>(++last_track_, index, sighting.name, unit.settings, measurement, when);
    people_.add(*track, when);
}

void Fusion::drop_unlisted(Unit& unit, std::set<std::string_view> const& listed, Steady when) {
    std::erase_if(unit.missing, [&](auto const& entry) { return when - entry.second->measured() > short_absence; });
    for (auto it = unit.tracks.begin(); it != unit.tracks.end();) {
        auto const track = it++;
        if (listed.contains(track->first)) continue;
        people_.remove(*track->second, when);
        unit.missing[track->first] = std::move(track->second);
        unit.tracks.erase(track);
    }
}

void Fusion::drop_all(Unit& unit, Steady when) {
    for (auto const& [name, track] : unit.tracks) people_.remove(*track, when);
    unit.tracks.clear();
    unit.missing.clear();
}

void Fusion::lost(std::string_view name, Steady at) {
    if (!find(name)) return;
    Steady const when = counted(at);
    int const index = index_of(name);
    drop_all(units_[static_cast<std::size_t>(index)], when);
    placement_.forget(index);
    last_step_.reset();
    advance_to(when);
}

void Fusion::rest(Steady when) { rests_since_ = when; }

void Fusion::wake(Steady when) {
    if (!rests_since_) return;
    auto const pause = when - *std::exchange(rests_since_, {});
    if (pause <= longest_rest) rested_ += pause;
}

Steady Fusion::counted(Steady when) const { return (rests_since_ ? std::min(when, *rests_since_) : when) - rested_; }

void Fusion::advance(Steady at) { advance_to(counted(at)); }

void Fusion::advance_to(Steady when) {
    now_ = std::max(now_.value_or(when), when);
    if (last_step_ && *now_ - *last_step_ < between_steps) return;
    last_step_ = *now_;
    step(*now_);
}

void Fusion::step(Steady when) {
    for (Unit& unit : units_)
        if (unit.last_list && when - *unit.last_list > settings_.longest_age) drop_all(unit, when);
    people_.step(static_cast<int>(units_.size()), when);
    if (when - last_compared_ >= between_comparisons) {
        last_compared_ = when;
        compare_units(when);
    }
    if (when - last_judged_ >= between_judgements) {
        last_judged_ = when;
        placement_.judge(when);
    }
}

// Compares the persons of each two units.
void Fusion::compare_units(Steady when) {
    for (std::size_t first = 0; first < units_.size(); ++first) {
        for (std::size_t second = first + 1; second < units_.size(); ++second) {
            for (auto const& [name, one] : units_[first].tracks)
                for (auto const& [other_name, other] : units_[second].tracks)
                    if (PlacementCheck::is_near(*one, *other)) compare(*one, *other, when);
        }
    }
}

// Compares two persons who are merged, or of whom each is sensed by only one of the two units.
void Fusion::compare(Track const& one, Track const& other, Steady when) {
    using enum PlacementCheck::Relation;
    if (one.person == other.person) return placement_.compare(one, other, merged, when);
    if (one.stands(when) || other.stands(when)) return;
    auto const& all = people_.all();
    if (all.at(one.person).is_sensed_by(other.unit()) || all.at(other.person).is_sensed_by(one.unit())) return;
    placement_.compare(one, other, unmerged, when);
}

std::vector<FusedPerson> Fusion::persons(Steady at) const {
    Steady const when = counted(at);
    std::vector<Person const*> named;
    for (auto const& [id, person] : people_.all())
        if (person.is_announced()) named.push_back(&person);
    std::ranges::sort(named, {}, &Person::number);
    std::vector<FusedPerson> result;
    for (Person const* person : named) {
        Gaussian const position = person->at(when).position;
        FusedPerson& fused =
            result.emplace_back(FusedPerson{person->name, position.mean, position.covariance, person->details(), {}});
        auto tracks = person->tracks;
        std::ranges::sort(tracks, {}, &Track::unit);
        for (Track const* track : tracks)
            fused.sensed_by.push_back({units_[static_cast<std::size_t>(track->unit())].name, track->name()});
    }
    return result;
}

std::optional<std::string> Fusion::unit_name(std::string_view name, std::string_view unit) const {
    Person const* person = people_.find(name);
    if (!person) return {};
    for (Track const* track : person->tracks)
        if (units_[static_cast<std::size_t>(track->unit())].name == unit) return track->name();
    return {};
}

std::optional<std::string> Fusion::own_name(std::string_view unit_name, std::string_view name) const {
    Unit const* unit = find(unit_name);
    if (!unit) return {};
    auto const track = unit->tracks.find(name);
    if (track == unit->tracks.end()) return {};
    Person const& person = people_.all().at(track->second->person);
    if (!person.is_announced()) return {};
    return person.name;
}

std::vector<Misplaced> Fusion::misplaced() const {
    std::vector<Misplaced> all;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        int const unit = static_cast<int>(i);
        if (auto const displacement = placement_.displaced(unit))
            all.push_back({units_[i].name, *displacement, text_of(unit, *displacement)});
    }
    return all;
}

std::string Fusion::text_of(int unit, Displacement const& displacement) const {
    auto const others = placement_.compared_with(unit);
    auto const name_of = [&](int each) { return units_[static_cast<std::size_t>(each)].name; };
    std::string text = name_of(unit) + " senses persons " + with_one_decimal(displacement.distance) + " m away from where ";
    text += others.size() == 1 ? name_of(others.front()) + " senses them" : std::string{"the others sense them"};
    double const degrees = displacement.turn * 180 / std::numbers::pi;
    if (std::abs(displacement.turn) >= notable_turn) text += ", turned by " + std::to_string(std::lround(degrees)) + " degrees";
    return text + ": check where it is placed";
}

}  // namespace rois::choosing
