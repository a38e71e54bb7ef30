#include "choosing/roster.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "engine/frames/space.hpp"
#include "types/text/to_number.hpp"

namespace rois::choosing {

namespace {

// Counts how often a ray from the point to the right crosses the border.
bool is_inside(Area const& area, double x, double y) {
    bool inside = false;
    for (std::size_t i = 0, before = area.size() - 1; i < area.size(); before = i++) {
        auto const& [ax, ay] = area[i];
        auto const& [bx, by] = area[before];
        if ((ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) inside = !inside;
    }
    return inside;
}

}  // namespace

Roster::Roster(Settings const& settings) : areas_{settings.areas}, low_battery_{settings.low_battery} {
    for (auto const* names : {&settings.logical, &settings.sensing})
        for (auto const& logical : *names) {
            bound_[logical] = false;
            for (std::size_t i = 0; i < settings.engines.size(); ++i) {
                auto const ref = settings.engines[i] + "." + logical;
                members_[ref] = {.ref = ref, .engine = settings.engines[i], .logical = logical, .preference = i};
            }
        }
}

Member* Roster::find(std::string_view ref) {
    auto const found = members_.find(ref);
    return found == members_.end() ? nullptr : &found->second;
}

std::vector<Member*> Roster::members_of(std::string_view logical) {
    std::vector<Member*> members;
    for (auto& [ref, member] : members_)
        if (member.logical == logical) members.push_back(&member);
    std::ranges::sort(members, {}, &Member::preference);
    return members;
}

void Roster::note(Member& member, ComponentStatus status, Results const& state) const {
    member.status = status;
    member.parameters = state.parameters;
    member.location.reset();
    if (!state.located.empty()) member.location = state.located.front();
    auto const* battery = rois::find(state.parameters, "battery");
    auto const charge = battery == nullptr || battery->values.empty() ? std::nullopt : to_number<double>(battery->values.front());
    member.has_low_battery = charge && *charge < low_battery_;
    auto const area = areas_.find(member.engine);
    member.is_outside = area != areas_.end() && member.location &&
                        !is_inside(area->second, member.location->position[0], member.location->position[1]);
}

bool Roster::may_act_at(Member const& member, std::array<double, 2> const& position) const {
    auto const area = areas_.find(member.engine);
    return area == areas_.end() || is_inside(area->second, position[0], position[1]);
}

std::map<std::string_view, std::size_t> Roster::loads() const {
    std::map<std::string_view, std::size_t> loads;
    for (auto const& [ref, member] : members_)
        if (member.is_bound || member.status == ComponentStatus::busy) ++loads[member.engine];
    return loads;
}

void Roster::note_engine_in_use(std::string const& logical, std::uint64_t session, std::string const& engine) {
    in_use_[logical] = {session, engine};
}

void Roster::note_plan(std::string const& logical, std::uint64_t session, std::string const& engine, Steady now) {
    plans_[logical] = {{session, engine}, now};
}

void Roster::forget_engine_in_use(std::string const& logical) {
    in_use_.erase(logical);
    plans_.erase(logical);
}

std::size_t Roster::count_others_using(std::uint64_t session, std::string_view logical, std::string_view engine,
                                       Steady now) const {
    auto const is_plan = [&](Plan const& plan) { return now - plan.made < longest_plan; };
    auto const is_meant = [&](std::string const& name, InUse const& use) {
        return name != logical && use.session == session && use.engine == engine;
    };
    auto const planned = std::ranges::count_if(
        plans_, [&](auto const& each) { return is_plan(each.second) && is_meant(each.first, each.second.use); });
    auto const used = std::ranges::count_if(in_use_, [&](auto const& each) {
        auto const plan = plans_.find(each.first);
        return is_meant(each.first, each.second) && (plan == plans_.end() || !is_plan(plan->second));
    });
    return static_cast<std::size_t>(planned + used);
}

void Roster::note_speech(std::string const& engine, bool speaks, Steady now) {
    if (speaks)
        speakers_[engine] = std::nullopt;
    else if (auto const speaker = speakers_.find(engine); speaker != speakers_.end() && !speaker->second)
        speaker->second = now;
}

bool Roster::is_heard_by_others(std::string_view listener, Steady now) const {
    constexpr std::chrono::milliseconds recognition{1'500};  // from the end of a speech to the event
    return std::ranges::any_of(speakers_, [&](auto const& each) {
        auto const& [engine, end] = each;
        return engine != listener && (!end || now - *end < recognition);
    });
}

void Roster::set_space(Space const& space, std::string const& own_frame) {
    frames_ = Frames{own_frame, space.frames};
    places_ = space.places;
}

std::optional<std::array<double, 2>> Roster::position_of(std::string const& target) const {
    if (auto const given = point(target, {})) return std::array{given->low[0], given->low[1]};
    auto const place = std::ranges::find(places_, target, &NamedPlace::name);
    if (place == places_.end()) return {};
    auto const& area = place->area;
    Located middle{.of = {}, .ref = {}, .crs = area.crs, .orientation = {}, .certainty = {}};
    for (std::size_t axis = 0; axis < area.low.size(); ++axis) middle.position[axis] = (area.low[axis] + area.high[axis]) / 2;
    if (frames_.change(middle, frames_.own())) return {};
    return std::array{middle.position[0], middle.position[1]};
}

}  // namespace rois::choosing
