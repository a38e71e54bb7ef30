#include "choosing/sightings.hpp"

#include <chrono>

namespace rois::choosing {

namespace {

constexpr double metre = 1'000;                   // mm
constexpr std::chrono::minutes longest_age{5};    // of a list: members report changes only
constexpr std::chrono::seconds end_of_sound{10};  // the same of sounds, whose end is not reported

}  // namespace

void Sightings::advance(Instant now) {
    now_ = now.steady;
    for (auto& [name, kind] : kinds_) kind.fusion.advance(now_);
    for (auto* observer : observers_) observer->time_passed(now);
}

void Sightings::begin(std::string const& kind) {
    auto const place =
        kinds_
            .try_emplace(
                kind,
                Kind{Fusion{{.prefix = kind + "-", .matching = {}, .longest_age = kind == "sound" ? end_of_sound : longest_age}}})
            .first;
    auto& [fusion, used] = place->second;
    if (used++ == 0) fusion.wake(now_);
}

void Sightings::end(std::string const& kind) {
    auto const found = kinds_.find(kind);
    if (found != kinds_.end() && --found->second.used == 0) found->second.fusion.rest(now_);
}

Fusion* Sightings::fusion_of(std::string_view kind) {
    auto const found = kinds_.find(kind);
    return found == kinds_.end() || found->second.used == 0 ? nullptr : &found->second.fusion;
}

std::optional<Identifier> Sightings::translated(std::string const& name, std::string const& unit) const {
    for (auto const& [kind, state] : kinds_)
        if (auto own = state.fusion.unit_name(name, unit)) {
            auto const codebook = codebooks_.find(unit);
            return Identifier{.code = std::move(*own), .codebook_ref = codebook == codebooks_.end() ? "" : codebook->second};
        }
    return {};
}

std::optional<std::array<double, 2>> Sightings::position_of(std::string_view name) const {
    for (auto const& [kind, state] : kinds_)
        for (auto const& person : state.fusion.persons(now_))
            if (person.name == name) return std::array{person.position.x() * metre, person.position.y() * metre};
    return {};
}

}  // namespace rois::choosing
