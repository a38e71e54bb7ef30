// Adding and removing components (7.5.3; decisions 12, 13).
#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include "engine/core.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// The frame of a sub engine's positions, and its instance, which no other engine has (decision 40).
std::vector<ParameterProfile> parameters_of_sub_engine(EngineProfile const& main, std::string const& name) {
    std::vector<ParameterProfile> parameters;
    for (auto const& parameter : main.parameters) {
        if (parameter.name != "crs" && parameter.name != "instance") continue;
        auto& own = parameters.emplace_back(parameter);
        if (own.name == "instance" && own.default_value) *own.default_value += "." + name;
    }
    return parameters;
}

// Returns the sub profile of a sub engine, such as "hall.robot1": the sub profile "hall.robot1" of the sub profile "hall". Adds
// the ones that are missing.
EngineProfile& profile_of(EngineProfile& main, std::string const& sub_engine) {
    auto* owner = &main;
    for (std::size_t end = 0; end != std::string::npos;) {
        end = sub_engine.find('.', end == 0 ? 0 : end + 1);
        auto const name = sub_engine.substr(0, end);
        auto const known = std::ranges::find(owner->sub_profiles, name, [](auto const& sub) { return sub.object.name; });
        if (known != owner->sub_profiles.end()) {
            owner = &*known;
            continue;
        }
        IdentifiedObject object{.identifier = main.object.identifier + "." + name,
                                .code_space = main.object.code_space,
                                .name = name,
                                .description = {},
                                .meta_data = {}};
        owner = &owner->sub_profiles.emplace_back();
        owner->object = std::move(object);
        owner->parameters = parameters_of_sub_engine(main, name);
    }
    return *owner;
}

// Sets these parameters in the profiles of sub engines; others stay.
void describe_engines(EngineProfile& main, std::map<std::string, std::vector<ParameterProfile>> const& engines) {
    for (auto& sub : main.sub_profiles) {
        describe_engines(sub, engines);
        auto const found = engines.find(sub.object.name);
        if (found == engines.end()) continue;
        for (auto const& parameter : found->second) {
            std::erase_if(sub.parameters, [&](auto const& each) { return each.name == parameter.name; });
            sub.parameters.push_back(parameter);
        }
    }
}

void list(EngineProfile& main, std::string const& engine, std::string const& ref) {
    auto& owner = engine == main.object.name ? main : profile_of(main, engine);
    owner.components.push_back(ref);
}

using Names = std::set<std::string_view>;

void unlist(EngineProfile& engine, Names const& refs) {
    std::erase_if(engine.components, [&](std::string const& ref) { return refs.contains(ref); });
    for (auto& sub : engine.sub_profiles) unlist(sub, refs);
}

// Removes the sub engines without components and sub engines, except these.
void remove_empty(EngineProfile& engine, Names const& kept = {}) {
    for (auto& sub : engine.sub_profiles) remove_empty(sub, kept);
    std::erase_if(engine.sub_profiles, [&](EngineProfile const& sub) {
        return sub.components.empty() && sub.sub_profiles.empty() && !kept.contains(sub.object.name);
    });
}

// Returns why the area of a place is invalid, or nullopt. Messages have only boxes.
std::optional<std::string> why_not(NamedPlace const& place) {
    auto const& [name, area] = place;
    bool valid = area.dimensions == 2 || area.dimensions == 3;
    for (std::size_t axis = 0; axis < area.low.size(); ++axis) valid = valid && area.low[axis] <= area.high[axis];
    if (valid) return {};
    return "the place " + quoted(name, 200) + " has an invalid area: expected its lowest and its highest coordinates";
}

Names engines_of(std::map<std::string, Belongings> const& all) {
    Names names;
    for (auto const& [provider, brought] : all)
        for (auto const& [name, parameters] : brought.engines) names.insert(name);
    return names;
}

auto all_space_of(Belongings const& brought) { return std::tie(brought.frames, brought.places, brought.space); }

Provider::Runs runs(bool returns_at_once) {
    return returns_at_once ? Provider::Runs::on_callers_thread : Provider::Runs::on_own_thread;
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
    auto hosted = std::make_shared<HostedComponent>(std::move(component),
                                                    provider(description.provider, runs(description.returns_at_once)));
    return std::make_shared<RegisteredComponent>(description, std::move(hosted), std::move(whole), std::move(engine), agenda_,
                                                 places_.frames);
}

// Returns the provider with this name, or a new one. With an empty name it is always a new one.
std::shared_ptr<Provider> Engine::Core::provider(std::string const& name, Provider::Runs runs) {
    auto made = name.empty() ? nullptr : providers_[name].lock();
    if (made && made->has_own_thread() != (runs == Provider::Runs::on_own_thread))
        throw std::runtime_error("all components of the provider " + quoted(name) + " must return at once, or none");
    if (made) return made;
    std::erase_if(providers_, [](auto const& known) { return known.second.expired(); });
    made = std::make_shared<Provider>(runs, inbox_, to_run_);
    if (!name.empty()) providers_[name] = made;
    return made;
}

void Engine::Core::add(std::shared_ptr<Device> device, std::string const& name, bool returns_at_once) {
    auto state = std::make_shared<DeviceState>();
    state->device = std::move(device);
    state->provider = provider(name, runs(returns_at_once));
    expect_providers(registry_.all().size() + devices_.size() + 1);
    devices_.push_back(std::move(state));
}

// For applications: without sub engines that have no components.
std::shared_ptr<EngineProfile const> Engine::Core::profile() const {
    if (!shared_profile_) {
        auto shown = profile_;
        remove_empty(shown);
        shared_profile_ = std::make_shared<EngineProfile const>(std::move(shown));
    }
    return shared_profile_;
}

EngineProfile Engine::Core::without_members() const {
    auto shown = profile_;
    Names members;
    for (auto const* component : registry_.logical()) members.insert(component->members().begin(), component->members().end());
    unlist(shown, members);
    return shown;
}

// For applications whose condition names no member.
std::shared_ptr<EngineProfile const> Engine::Core::profile_without_members() const {
    if (registry_.logical().empty()) return profile();
    if (!shared_profile_without_members_) {
        auto shown = without_members();
        remove_empty(shown);
        shared_profile_without_members_ = std::make_shared<EngineProfile const>(std::move(shown));
    }
    return shared_profile_without_members_;
}

// Without the sub engines of which the client sees no component.
std::shared_ptr<EngineProfile const> Engine::Core::profile_seen_by(Rights const* rights,
                                                                   std::shared_ptr<EngineProfile const> const& profile) const {
    if (may_see_everything(rights)) return profile;
    Names hidden;
    for (auto const& [ref, component] : registry_.all())
        if (!rights->sees(ref)) hidden.insert(ref);
    auto shown = *profile;
    unlist(shown, hidden);
    remove_empty(shown);
    return std::make_shared<EngineProfile const>(std::move(shown));
}

// For other engines: with all sub engines, because they find loops by them.
std::shared_ptr<EngineProfile const> Engine::Core::profile_for_engines(bool with_members) const {
    return std::make_shared<EngineProfile const>(with_members ? profile_ : without_members());
}

void Engine::Core::enter(SharedComponent const& component) {
    auto const& entry = registry_.add(component).entry();
    registry_.mark_members();
    list(profile_, entry.engine, entry.ref);
    forget_shared();
    expect_providers(registry_.all().size() + devices_.size());
    component->hosted().attach();
}

// The component is no longer in the registry. The next tick retries a step that fails.
void Engine::Core::leave(SharedComponent const& component, Instant now) {
    component->is_member = false;  // a state that it has reported before is not passed on
    Attempts attempts;
    attempts([&] { executor_.part(*component, now); });
    if (auto* session = std::exchange(component->bound_to, nullptr)) {
        session->bound.erase(component.get());
        recorder_.changed(*session);
        attempts([&] { trace_->released(session->number, component->ref().code); });
    }
    attempts([&] { forget_in_sessions_of_engines(*component, now); });
    attempts([&] { questions_.fail_all(*component, now); });
    attempts([&] { settle(now); });
    attempts([&] { component->depart(); });
    attempts.rethrow();
}

void Engine::Core::add(std::unique_ptr<Component> component) { enter(made(std::move(component), profiles_of(belongings_))); }

std::vector<ComponentProfile> Engine::Core::profiles_of(BelongingsOf const& belongings) {
    std::vector<ComponentProfile> all;
    for (auto const& [provider, brought] : belongings) all.insert(all.end(), brought.profiles.begin(), brought.profiles.end());
    return all;
}

Places Engine::Core::places_of(BelongingsOf const& belongings) const {
    auto all = own_places_;
    std::vector<Frame> frames;
    for (auto const& [provider, brought] : belongings) {
        frames.insert(frames.end(), brought.frames.begin(), brought.frames.end());
        for (auto const& place : brought.places) {
            if (all.find(place.name) != nullptr)
                throw std::runtime_error("there are two places with the name " + quoted(place.name));
            all.all.push_back(place);
        }
    }
    if (!frames.empty()) all.frames = all.frames.with(std::move(frames));
    return all;
}

// Adds the frames and places of all sub engines, except invalid ones, those whose name is taken, and those in a frame that is
// left out. Returns why those of `provider` are left out.
std::vector<std::string> Engine::Core::add_space(Places& all, BelongingsOf const& belongings, std::string const& provider) {
    std::vector<std::string> left_out;
    std::set<std::string> names;
    for (auto const& place : all.all) names.insert(place.name);
    for (auto const& [owner, brought] : belongings) {
        auto const leave_out = [&, is_meant = owner == provider](std::string why) {
            if (is_meant) left_out.push_back(std::move(why));
        };
        std::set<std::string> missing;
        auto const why_missing = [&](std::string const& what, std::string const& crs) -> std::optional<std::string> {
            if (missing.empty() || !missing.contains(lower_case(crs))) return {};
            return what + " is in the frame " + quoted(crs, 200) + ", which is left out";
        };
        for (auto const& frame : brought.space.frames) {
            auto why = why_missing("the frame " + quoted(frame.crs, 200), frame.base);
            if (!why) why = all.frames.include(frame);
            if (!why) continue;
            missing.insert(lower_case(frame.crs));
            leave_out(std::move(*why));
        }
        for (auto const& place : brought.space.places) {
            auto why = why_missing("the place " + quoted(place.name, 200), place.area.crs);
            if (!why) why = why_not(place);
            if (why)
                leave_out(std::move(*why));
            else if (!names.insert(place.name).second)
                leave_out("there are two places with the name " + quoted(place.name, 200));
            else
                all.all.push_back(place);
        }
    }
    return left_out;
}

namespace {

// Removes the frames and places of an engine, whose names begin with its own (`prefix`).
void leave_out(Space& space, std::string const& prefix) {
    std::erase_if(space.frames, [&](Frame const& frame) {
        return std::string_view{frame.crs}.substr(frame.crs.rfind(':') + 1).starts_with(prefix);
    });
    std::erase_if(space.places, [&](NamedPlace const& place) { return place.name.starts_with(prefix); });
}

}  // namespace

// The frames and places for another engine. Places that are not boxes are left out: messages have no form for them.
Places const& Engine::Core::places_seen_by(Rights const* rights) const {
    if (may_see_everything(rights)) return places_;
    if (auto const known = places_seen_.find(rights->seen()); known != places_seen_.end()) return known->second;
    auto seen = belongings_;
    auto const sees_one = [&](auto const& is_meant) {
        return std::ranges::any_of(registry_.all(),
                                   [&](auto const& each) { return is_meant(*each.second) && rights->sees(each.first); });
    };
    std::erase_if(seen, [&](auto const& each) {
        return !each.first.empty() && !sees_one([&](auto const& component) { return component.provider() == each.first; });
    });
    for (auto& [provider, brought] : seen)
        for (auto const& [engine, parameters] : brought.engines) {
            auto const prefix = engine + ".";
            if (!sees_one([&](auto const& component) { return component.ref().code.starts_with(prefix); }))
                leave_out(brought.space, prefix);
        }
    Places places;
    try {
        places = places_of(seen);
    } catch (std::invalid_argument const&) {
        places = own_places_;  // they are placed in frames that the client does not see
    }
    add_space(places, seen, {});
    return places_seen_.emplace(rights->seen(), std::move(places)).first->second;
}

Space Engine::Core::space(Rights const* rights) const {
    auto const& places = places_seen_by(rights);
    Space space{.frames = places.frames.others(), .places = {}};
    for (auto const& place : places.all) {
        if (place.area.shape != Geometry::Shape::box) continue;
        auto& area = space.places.emplace_back(place).area;
        if (area.crs.empty()) area.crs = places.frames.own();
    }
    return space;
}

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
std::vector<std::string> Engine::Core::change(ComponentChange change, Instant now) {
    check(change);
    settle(now);
    auto registry = registry_;
    auto profile = profile_;
    auto belongings = belongings_;
    auto& brought = belongings[change.provider];
    bool const has_new_space = all_space_of(brought) != all_space_of(change.belongings);
    brought = std::move(change.belongings);
    auto const known = profiles_of(belongings);
    auto places = places_of(belongings);
    auto left_out = add_space(places, belongings, change.provider);
    std::vector<SharedComponent> going, coming;
    for (auto const& ref : change.going) registry.remove(*going.emplace_back(registry_.find(ref)->shared_from_this()));
    unlist(profile, {change.going.begin(), change.going.end()});
    for (auto& component : change.coming) {
        coming.push_back(made(std::move(component), known));
        auto const& entry = registry.add(coming.back()).entry();
        list(profile, entry.engine, entry.ref);
    }
    for (auto const& [name, parameters] : brought.engines) profile_of(profile, name);
    describe_engines(profile, brought.engines);
    remove_empty(profile, engines_of(belongings));
    expect_providers(registry.all().size() + going.size() + devices_.size());

    std::swap(registry_, registry);
    registry_.mark_members();
    std::swap(profile_, profile);
    std::swap(belongings_, belongings);
    std::swap(places_, places);
    forget_shared();
    if (going.empty() && coming.empty() && !has_new_space && profile == profile_) return left_out;
    Attempts attempts;
    for (auto const& component : going) attempts([&] { leave(component, now); });
    for (auto const& component : coming) attempts([&] { component->hosted().attach(); });
    for (auto const& component : coming)
        attempts([&] { executor_.halt(*component, CompletedStatus::abort, "it was just added", now); });
    bool const concerns_all = has_new_space || (going.empty() && coming.empty());
    attempts([&] { note_profile_change(going, coming, concerns_all ? &change.provider : nullptr); });
    attempts([&] { restore_absent(now); });
    attempts([&] { report_profile_change(now); });
    attempts([&] { settle(now); });
    if (attempts.failure()) unsettled_ = attempts.failure();
    return left_out;
}

// `whole_provider`: the change concerns all of its components, such as their places; null: only those that come or go.
void Engine::Core::note_profile_change(std::vector<SharedComponent> const& going, std::vector<SharedComponent> const& coming,
                                       std::string const* whole_provider) {
    profile_change_unreported_ = true;
    for (auto const* list : {&going, &coming})
        for (auto const& component : *list) changed_refs_.insert(component->ref().code);
    if (whole_provider == nullptr) return;
    for (auto const& [ref, component] : registry_.all())
        if (component->provider() == *whole_provider) changed_refs_.insert(ref);
}

// At most once a second: components may come and go often. A tick reports a later change. Sessions that see none of the changed
// components learn nothing.
void Engine::Core::report_profile_change(Instant now) {
    if (!profile_change_unreported_) return;
    if (profile_change_reported_ && now.steady - *profile_change_reported_ < std::chrono::seconds{1}) return;
    auto const notification = std::make_shared<OutgoingNotification const>(ProfileChanged{});
    Attempts attempts;
    for (auto const& [id, session] : sessions_) {
        auto const* rights = session->rights.get();
        auto const is_seen = [&](std::string const& ref) { return rights->sees(ref); };
        if (may_see_everything(rights) || std::ranges::any_of(changed_refs_, is_seen))
            attempts([&, &to = *session] { notifier_.notify(to, notification); });
    }
    changed_refs_.clear();
    profile_change_reported_ = now.steady;
    profile_change_unreported_ = false;
    attempts.rethrow();
}

}  // namespace rois
