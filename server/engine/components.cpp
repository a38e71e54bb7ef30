// Components come and go (7.5.3; decisions 12, 13).
#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "engine/core.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

void list(EngineProfile& engine, std::string const& sub_engine, std::string const& ref) {
    auto* owner = &engine;
    if (sub_engine != engine.object.name) {
        auto const known = std::ranges::find(engine.sub_profiles, sub_engine, [](auto const& sub) { return sub.object.name; });
        owner = known != engine.sub_profiles.end() ? &*known : &engine.sub_profiles.emplace_back();
        owner->object = {.identifier = engine.object.identifier + "." + sub_engine,
                         .code_space = engine.object.code_space,
                         .name = sub_engine,
                         .description = {},
                         .meta_data = {}};
    }
    owner->components.push_back(ref);
}

// A sub engine without components is none.
void unlist(EngineProfile& engine, std::set<std::string_view> const& refs) {
    auto const goes = [&](std::string const& ref) { return refs.contains(ref); };
    std::erase_if(engine.components, goes);
    for (auto& sub : engine.sub_profiles) std::erase_if(sub.components, goes);
    std::erase_if(engine.sub_profiles, [](EngineProfile const& sub) { return sub.components.empty(); });
}

}  // namespace

Engine::Core::SharedComponent Engine::Core::made(std::unique_ptr<Component> component,
                                                 std::vector<ComponentProfile> const& known) {
    auto const& description = component->description();
    // Conditions look for refs without it.
    if (trimmed(description.ref.code) != description.ref.code)
        throw std::runtime_error("the ref " + quoted(description.ref.code) + " begins or ends with white space");
    auto whole = flattened(*description.profile, known);
    auto engine = description.engine.empty() ? profile_.object.name : description.engine;
    return std::make_shared<RegisteredComponent>(std::move(component), std::move(whole), std::move(engine), agenda_,
                                                 places_.frames);
}

std::shared_ptr<EngineProfile const> Engine::Core::profile() const {
    if (!told_profile_) told_profile_ = std::make_shared<EngineProfile const>(profile_);
    return told_profile_;
}

void Engine::Core::enter(SharedComponent const& component) {
    auto const& entry = registry_.add(component).entry();
    list(profile_, entry.engine, entry.ref);
    told_profile_.reset();
}

void Engine::Core::leave(RegisteredComponent& component, Instant now) {
    executor_.part(component, now);
    if (auto* session = std::exchange(component.bound_to, nullptr)) {
        session->bound.erase(&component);
        journal_->released(session->number, component.ref().code);
    }
    settle(now);
    auto const last = component.shared_from_this();
    registry_.remove(component);
    component.depart();
}

void Engine::Core::add(std::unique_ptr<Component> component) { enter(made(std::move(component), known_profiles_)); }

void Engine::Core::check(ComponentChange const& change) const {
    std::set<std::string_view> const going{change.going.begin(), change.going.end()};
    std::set<std::string_view> refs;
    for (auto const& ref : change.going)
        if (registry_.find(ref) == nullptr) throw std::runtime_error("there is no component " + quoted(ref) + " that could go");
    for (auto const& component : change.coming) {
        auto const& ref = component->description().ref.code;
        bool const stays = registry_.find(ref) != nullptr && !going.contains(ref);
        if (!refs.insert(ref).second || stays) throw std::runtime_error("there are two components with the ref " + quoted(ref));
    }
}

void Engine::Core::change(ComponentChange change, Instant now) {
    check(change);
    std::vector<SharedComponent> coming;
    coming.reserve(change.coming.size());
    for (auto& component : change.coming) coming.push_back(made(std::move(component), change.known_profiles));
    known_profiles_ = std::move(change.known_profiles);
    settle(now);
    for (auto const& ref : change.going) leave(*registry_.find(ref), now);
    if (!change.going.empty()) unlist(profile_, {change.going.begin(), change.going.end()});
    told_profile_.reset();
    for (auto& component : coming) {
        enter(component);
        executor_.halt(*component, CompletedStatus::abort, "it has just come", now);
    }
    if (change.going.empty() && coming.empty()) return;
    auto const notification = std::make_shared<OutgoingNotification const>(ProfileChanged{});
    for (auto const& [id, session] : sessions_) notifier_.tell(*session, notification);
    settle(now);
}

}  // namespace rois
