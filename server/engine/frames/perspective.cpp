#include "engine/frames/perspective.hpp"

#include <algorithm>

#include "engine/conditions/effort.hpp"
#include "engine/registry.hpp"
#include "engine/session.hpp"

namespace rois {

Perspective::Perspective(Registry const& registry, Places const& places, Places const& named, Session const* asker, Of of)
    : registry_{registry}, places_{places}, named_{named}, asker_{asker}, of_{of} {}

Candidate const& Perspective::candidate(RegisteredComponent const& component) {
    return components_.try_emplace(&component, component, *this).first->second;
}

namespace {

bool matches(std::optional<GroupVerdict> const& verdict) { return verdict && verdict->match == Match::yes; }

bool is_better(GroupVerdict const& one, GroupVerdict const& other) {
    bool const is_held = one.held != nullptr, other_is_held = other.held != nullptr;
    return is_held != other_is_held ? other_is_held : one.bound > other.bound;
}

}  // namespace

void Perspective::keep_one_robot(std::vector<RegisteredComponent*> const& found) {
    std::map<void const*, std::optional<GroupVerdict>*> kept;  // the best robot's verdict, by group
    for (auto const* component : found)
        for (auto& [of, verdict] : verdicts_) {
            if (of.second != component->entry().engine || !matches(verdict)) continue;
            auto& best = kept.try_emplace(of.first, &verdict).first->second;
            if (is_better(*verdict, **best)) best = &verdict;
        }
    for (auto& [of, verdict] : verdicts_)
        if (auto const best = kept.find(of.first); best != kept.end() && best->second != &verdict) verdict = GroupVerdict{};
}

std::optional<std::string_view> Perspective::drop_held_robots() {
    std::optional<std::string_view> held;
    for (auto& [of, verdict] : verdicts_) {
        if (!matches(verdict) || verdict->held == nullptr) continue;
        held = verdict->held->rid();
        verdict = GroupVerdict{};
    }
    return held;
}

bool Perspective::is_lacked(RegisteredComponent const& component) {
    auto const& looked_for = candidate(component);
    return std::ranges::any_of(verdicts_, [&](auto const& of) {
        return of.second && std::ranges::find(of.second->to_bind, &looked_for) != of.second->to_bind.end();
    });
}

std::vector<Candidate const*> const& Perspective::robot(std::string_view engine) {
    auto const* rights = asker_ == nullptr ? nullptr : asker_->rights.get();
    if (robots_.empty()) {
        Effort::spend(40 * registry_.all().size());
        for (auto const& [ref, component] : registry_.all())
            if (may_see(rights, ref)) robots_[component->entry().engine].push_back(&candidate(*component));
    }
    static std::vector<Candidate const*> const none;
    auto const found = robots_.find(engine);
    return found == robots_.end() ? none : found->second;
}

}  // namespace rois
