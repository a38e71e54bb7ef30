// Adding and removing components (7.5.3; decisions 12, 13).
#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "engine/core.hpp"
#include "types/text/texts.hpp"

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

// A sub engine without components is removed.
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
    // a condition could not find such a ref: it compares trimmed texts
    if (trimmed(description.ref.code) != description.ref.code)
        throw std::runtime_error("the ref " + quoted(description.ref.code) + " begins or ends with white space");
    auto whole = flattened(*description.profile, known);
    auto engine = description.engine.empty() ? profile_.object.name : description.engine;
    return std::make_shared<RegisteredComponent>(std::move(component), std::move(whole), std::move(engine), agenda_,
                                                 places_.frames);
}

std::shared_ptr<EngineProfile const> Engine::Core::profile() const {
    if (!shared_profile_) shared_profile_ = std::make_shared<EngineProfile const>(profile_);
    return shared_profile_;
}

void Engine::Core::enter(SharedComponent const& component) {
    auto const& entry = registry_.add(component).entry();
    list(profile_, entry.engine, entry.ref);
    shared_profile_.reset();
}

// The component is no longer in the registry. The next tick retries a step that fails.
void Engine::Core::leave(SharedComponent const& component, Instant now) {
    Attempts attempts;
    attempts([&] { executor_.part(*component, now); });
    if (auto* session = std::exchange(component->bound_to, nullptr)) {
        session->bound.erase(component.get());
        attempts([&] { journal_->released(session->number, component->ref().code); });
    }
    attempts([&] { settle(now); });
    component->depart();
    departed_.push_back(component);  // `change` reserved the room
    attempts.rethrow();
}

void Engine::Core::add(std::unique_ptr<Component> component) { enter(made(std::move(component), known_profiles_)); }

void Engine::Core::check(ComponentChange const& change) const {
    std::set<std::string_view> const going{change.going.begin(), change.going.end()};
    std::set<std::string_view> refs;
    for (auto const& ref : change.going)
        if (registry_.find(ref) == nullptr)
            throw std::runtime_error("unknown component " + quoted(ref) + ": it cannot be removed");
    for (auto const& component : change.coming) {
        auto const& ref = component->description().ref.code;
        bool const stays = registry_.find(ref) != nullptr && !going.contains(ref);
        if (!refs.insert(ref).second || stays) throw std::runtime_error("there are two components with the ref " + quoted(ref));
    }
}

// Prepares the change in copies, and then exchanges them. Nothing is thrown after the exchange: if a later step fails, the next
// tick repeats it and reports the failure.
void Engine::Core::change(ComponentChange change, Instant now) {
    check(change);
    settle(now);
    auto registry = registry_;
    auto profile = profile_;
    std::vector<SharedComponent> going, coming;
    for (auto const& ref : change.going) registry.remove(*going.emplace_back(registry_.find(ref)->shared_from_this()));
    unlist(profile, {change.going.begin(), change.going.end()});
    for (auto& component : change.coming) {
        coming.push_back(made(std::move(component), change.known_profiles));
        auto const& entry = registry.add(coming.back()).entry();
        list(profile, entry.engine, entry.ref);
    }
    departed_.reserve(departed_.size() + going.size());
    auto const notification = std::make_shared<OutgoingNotification const>(ProfileChanged{});

    std::swap(registry_, registry);
    std::swap(profile_, profile);
    std::swap(known_profiles_, change.known_profiles);
    shared_profile_.reset();
    if (going.empty() && coming.empty()) return;
    Attempts attempts;
    for (auto const& component : going) attempts([&] { leave(component, now); });
    for (auto const& component : coming)
        attempts([&] { executor_.halt(*component, CompletedStatus::abort, "it was just added", now); });
    for (auto const& [id, session] : sessions_) attempts([&, &to = *session] { notifier_.notify(to, notification); });
    attempts([&] { settle(now); });
    if (attempts.failure()) unsettled_ = attempts.failure();
}

}  // namespace rois
