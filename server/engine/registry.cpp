#include "engine/registry.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "engine/commands/parameters.hpp"
#include "engine/session.hpp"
#include "types/data_type.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// The parameters of set_parameter, and the other parameters of the profile.
std::vector<ParameterProfile> settable_of(ComponentProfile const& profile) {
    std::vector<ParameterProfile> settable;
    if (auto const* message = find_message(profile, MessageKind::command, "set_parameter")) settable = message->arguments;
    for (auto const& parameter : profile.parameters) {
        auto const known = std::ranges::find_if(
            settable, [&](ParameterProfile const& p) { return equal_ignoring_case(p.name, parameter.name); });
        if (known == settable.end()) {
            settable.push_back(parameter);
        } else if (!known->default_value) {
            known->default_value = parameter.default_value;
        }
    }
    return settable;
}

// Returns `list` with the members of `others` that it lacks.
std::vector<ParameterProfile> with_others(std::vector<ParameterProfile> list, std::vector<ParameterProfile> const& others) {
    for (auto const& other : others)
        if (find_parameter(list, other.name) == nullptr) list.push_back(other);
    return list;
}

// Adds or completes the messages set_parameter and get_parameter, which every component with parameters has. Some published
// profiles list only the parameters.
void add_parameter_messages(ComponentProfile& profile, std::vector<ParameterProfile> const& settable) {
    if (settable.empty()) return;
    auto const message = [&](MessageKind kind, std::string_view name) -> MessageProfile& {
        auto const there = std::ranges::find_if(
            profile.messages, [&](MessageProfile const& each) { return each.kind == kind && each.name == name; });
        if (there != profile.messages.end()) return *there;
        return profile.messages.emplace_back(
            MessageProfile{.kind = kind, .name = std::string{name}, .results = {}, .arguments = {}, .timeout = {}});
    };
    auto& set = message(MessageKind::command, "set_parameter");
    set.arguments = with_others(std::move(set.arguments), settable);
    auto& get = message(MessageKind::query, "get_parameter");
    get.results = with_others(std::move(get.results), settable);
}

// The arguments of the profile's own `start` that are not stored parameters, or have another type.
std::vector<ParameterProfile> start_arguments_of(ComponentProfile const& profile, std::vector<ParameterProfile> const& settable) {
    std::vector<ParameterProfile> arguments;
    auto const* message = find_message(profile, MessageKind::command, "start");
    if (message == nullptr) return arguments;
    for (auto const& argument : message->arguments) {
        auto const* stored = find_parameter(settable, argument.name);
        if (stored == nullptr || !(DataType::of(stored->data_type_ref) == DataType::of(argument.data_type_ref)))
            arguments.push_back(argument);
    }
    return arguments;
}

Codebooks const* codebooks_for(std::vector<Codebooks> const& all, std::string_view parameter) {
    auto const found =
        std::ranges::find_if(all, [&](Codebooks const& each) { return equal_ignoring_case(each.parameter, parameter); });
    return found == all.end() ? nullptr : &*found;
}

// Declares the default codebook of each identifier parameter whose profile declares none.
void declare_codebooks(std::vector<ParameterProfile>& profiles, std::vector<Codebooks> const& codebooks) {
    for (auto& profile : profiles) {
        auto const* found = codebooks_for(codebooks, profile.name);
        auto& declared = profile.data_type_ref.codebook_ref;
        if (found != nullptr && !found->known.empty() && declared.empty()) declared = found->known.front();
    }
}

void declare_codebooks(ComponentProfile& profile, std::vector<Codebooks> const& codebooks) {
    declare_codebooks(profile.parameters, codebooks);
    for (auto& message : profile.messages) {
        declare_codebooks(message.arguments, codebooks);
        if (message.kind == MessageKind::query && message.name == "get_parameter") declare_codebooks(message.results, codebooks);
    }
}

bool is_among(std::vector<std::string> const& known, std::string_view name) {
    return std::ranges::any_of(known, [&](std::string const& each) { return equal_ignoring_case(each, name); });
}

// Positions without a frame are in the engine's: the profile says so (decision 40).
void declare_frame(std::vector<ParameterProfile>& profiles, std::vector<std::string> const& positions, std::string const& frame) {
    for (auto& profile : profiles) {
        auto& declared = profile.data_type_ref.codebook_ref;
        if (declared.empty() && is_among(positions, profile.name)) declared = frame;
    }
}

// The published examples' component_ref has this codebook for every component: "urn:...:ComponentType" (Annex B.2).
bool is_codebook_of_all_components(std::string_view codebook) {
    return equal_ignoring_case(codebook.substr(codebook.rfind(':') + 1), "ComponentType");
}

std::vector<ParameterProfile> results_of_get_parameter(ComponentProfile const& profile) {
    auto const* message = find_message(profile, MessageKind::query, "get_parameter");
    return message == nullptr ? std::vector<ParameterProfile>{} : message->results;
}

}  // namespace

RegisteredComponent::RegisteredComponent(ComponentDescription const& description, std::shared_ptr<HostedComponent> hosted,
                                         ComponentProfile profile, std::string engine, Agenda& agenda, Frames const& frames)
    : hosted_{std::move(hosted)},
      provider_{description.provider},
      ref_{description.ref},
      agenda_{agenda},
      frames_{frames},
      crs_{description.crs},
      moves_{description.moves},
      positions_{description.positions},
      codebooks_{description.codebooks},
      alternatives_{description.alternatives},
      status_when_stopped_{description.status_when_stopped},
      confirms_binding_{description.confirms_binding},
      members_{description.members} {
    declare_codebooks(profile, codebooks_);
    declare_frame(profile.parameters, positions_, frames_.own());
    for (auto& message : profile.messages) declare_frame(message.arguments, positions_, frames_.own());
    settable_ = settable_of(profile);
    add_parameter_messages(profile, settable_);
    start_arguments_ = start_arguments_of(profile, settable_);
    startable_ = with_others(start_arguments_, settable_);
    readable_ = with_others(settable_, results_of_get_parameter(profile));
    auto const prefix = description.engine + ".";
    if (prefix.size() > 1 && ref_.code.starts_with(prefix)) code_begin_ = prefix.size();
    auto type = profile.object.identifier;
    type_key_ = folded_name(type);
    entry_ = {.ref = ref_.code,
              .type = std::move(type),
              .engine = std::move(engine),
              .profile = std::make_shared<ComponentProfile const>(std::move(profile))};
    for (auto const& message : entry_.profile->messages) results_.emplace_back(message.results);
    defaults_ = with_defaults(settable_, {});
    parameters = defaults_;
    hosted_->registered = this;
}

std::shared_ptr<ComponentTraits const> RegisteredComponent::traits() const {
    return std::make_shared<ComponentTraits const>(ComponentTraits{.positions = positions_,
                                                                   .codebooks = codebooks_,
                                                                   .alternatives = alternatives_,
                                                                   .status_when_stopped = status_when_stopped_,
                                                                   .moves = moves_});
}

void RegisteredComponent::depart() {
    has_departed_ = true;
    hosted_->depart();
}

ComponentStatus RegisteredComponent::status_for(Session const* asker) const {
    if (has_failed_to_halt()) return ComponentStatus::error;
    if (bound_to != nullptr && bound_to != asker) return ComponentStatus::busy;
    return failed_ || is_silent_ ? ComponentStatus::error : state_.status;
}

void RegisteredComponent::report_failure(std::string_view problem, Report each) {
    failed_ = true;
    report(ErrorType::component_internal_error, std::string{problem}, each);
}

void RegisteredComponent::report_silence(std::string_view what, Steady now) {
    is_silent_ = true;
    report_no_response(std::string{what}, Report::once, now);
}

void RegisteredComponent::report_no_response(std::string text, Report each, Steady now) {
    constexpr std::chrono::milliseconds same_silence{300};
    if (found_silent_ && now < *found_silent_ + same_silence) return;
    found_silent_ = now;
    report(ErrorType::component_not_responding, std::move(text), each);
}

void RegisteredComponent::report(ErrorType type, std::string text, Report each) {
    if (each == Report::once && reported_once_.contains(type)) return;
    agenda_.add({shared_from_this(), type, std::move(text)});
    reported_once_.insert(type);
}

void RegisteredComponent::clear_failure() {
    failed_ = false;
    reported_once_.clear();
}

TypedProfiles const* RegisteredComponent::results_of(MessageKind kind, std::string_view message) const {
    auto const* found = find_message(profile(), kind, message);
    return found == nullptr ? nullptr : &results_[static_cast<std::size_t>(found - profile().messages.data())];
}

RegisteredComponent::Fit RegisteredComponent::check(MessageKind kind, std::string_view message, Results const& results,
                                                    Report report) {
    auto const* profiles = results_of(kind, message);
    auto const problem = profiles == nullptr ? "it is not in the profile" : profiles->why_not(results.parameters);
    if (!problem) return Fit::right;
    report_failure("invalid results of " + quoted(message) + ": " + *problem, report);
    return Fit::wrong;
}

std::vector<Results> RegisteredComponent::accepted(std::string_view query_type, std::vector<Results> rows) {
    for (auto& row : rows) {
        if (check(MessageKind::query, query_type, row, Report::once) == Fit::wrong) return {};
        if (!to_engine_frame(row, query_type, Report::once)) return {};
    }
    return rows;
}

std::shared_ptr<Results const> RegisteredComponent::accepted(EventOccurred const& event) {
    if (check(MessageKind::event, event.event_type, *event.results, Report::once) == Fit::wrong) return {};
    if (frames_.are_one()) return event.results;
    auto results = *event.results;
    if (!to_engine_frame(results, event.event_type, Report::once)) return {};
    return std::make_shared<Results const>(std::move(results));
}

void RegisteredComponent::accept(CommandEnded& ended) {
    if (to_engine_frame(ended.results, "a command", Report::each)) return;
    ended.status = CompletedStatus::error;
    ended.results = {};
    ended.reason = "its results are in a frame that cannot be converted";
}

// Parameters outside of the profile are left out.
void RegisteredComponent::accept(ComponentState state) {
    if (state.location && !frames_.are_one())
        if (auto const problem = frames_.change(*state.location, frames_.own())) {
            report_failure("invalid location: " + *problem, Report::once);
            state.location.reset();
        }
    if (state.location && is_logical()) state.location->ref = entry_.engine;  // it stands for several robots
    std::erase_if(state.parameters, [&](Parameter const& each) { return profile_for(readable_, each.name) == nullptr; });
    auto const problem = why_not(readable_, state.parameters);
    if (problem) report_failure("invalid parameters: " + *problem, Report::once);
    fits_ = !problem;
    Results readable;
    if (fits_) readable.parameters = normalized(readable_, state.parameters);
    frames_.change_to_own(readable);
    state.parameters = std::move(readable.parameters);
    state_ = std::move(state);
    ++reported_states_;
}

Results RegisteredComponent::reported() const {
    Results results;
    if (fits_) results.parameters = state_.parameters;
    if (state_.location) results.located.push_back(*state_.location);
    return results;
}

ParameterList const& RegisteredComponent::parameters_for(Session const* asker) const {
    return asker != nullptr && asker == bound_to ? parameters : defaults_;
}

void RegisteredComponent::restore_defaults(Instant now) {
    if (parameters == defaults_) return;
    parameters = defaults_;
    notify_of_parameters(now);
}

ParameterList RegisteredComponent::changed_parameters() const { return parameters == defaults_ ? ParameterList{} : parameters; }

void RegisteredComponent::restore_parameters(ParameterList const& earlier, Instant now) {
    if (earlier.empty() || why_not(settable_, earlier) || why_no_frame(earlier, frames_) || why_no_codebook(settable_, earlier))
        return;
    parameters = merged(std::move(parameters), earlier);
    notify_of_parameters(now);
}

void RegisteredComponent::notify_of_parameters(Instant now) {
    auto changed = in_own_frame(parameters);
    hosted_->parameters_changed(changed ? std::move(*changed) : parameters, now);
}

std::optional<ParameterList> RegisteredComponent::all_parameters(Session const* asker) const {
    if (!fits_) return {};
    auto const& stored = parameters_for(asker);
    bool const bound_by_asker = &stored == &parameters;
    auto all = state_.parameters;
    std::erase_if(all, [&](Parameter const& each) {
        return find(stored, each.name) != nullptr || (!bound_by_asker && find_parameter(settable_, each.name) != nullptr);
    });
    all.insert(all.end(), stored.begin(), stored.end());
    return all;
}

bool RegisteredComponent::has_parameter(std::string_view name) const { return profile_for(readable_, name) != nullptr; }

bool RegisteredComponent::has_result(std::string_view name) const {
    return std::ranges::any_of(profile().messages, [&](MessageProfile const& message) {
        return message.kind != MessageKind::command && find_parameter(message.results, name) != nullptr;
    });
}

bool RegisteredComponent::to_engine_frame(Results& results, std::string_view message, Report report) {
    auto const problem = frames_.change_to_own(results);
    if (!problem) return true;
    report_failure("invalid results of " + quoted(message) + ": " + *problem, report);
    return false;
}

bool RegisteredComponent::is_position(std::string_view parameter) const { return is_among(positions_, parameter); }

std::optional<std::string> RegisteredComponent::why_no_frame(ParameterList const& normalized, Frames const& known) const {
    if (known.own().empty()) return {};
    for (auto const& parameter : normalized) {
        auto const& crs = parameter.data_type_ref.codebook_ref;
        if (is_position(parameter.name) && !known.know(crs))
            return "parameter " + quoted(parameter.name) + ": the frame " + quoted(crs, 200) +
                   " is not known here; expected one of " + first_listed(known.names());
    }
    return {};
}

std::optional<std::string> RegisteredComponent::why_no_codebook(std::vector<ParameterProfile> const& profiles,
                                                                ParameterList const& normalized) const {
    for (auto const& parameter : normalized) {
        auto const* profile = find_parameter(profiles, parameter.name);
        auto const& codebook = parameter.data_type_ref.codebook_ref;
        if (codebook.empty() || DataType::of(profile->data_type_ref).base != BaseType::identifier) continue;
        auto const* described = codebooks_for(codebooks_, parameter.name);
        auto known = described == nullptr ? std::vector<std::string>{} : described->known;
        auto const& declared = profile->data_type_ref.codebook_ref;
        if (!declared.empty() && !is_among(known, declared)) known.insert(known.begin(), declared);
        if (is_among(known, codebook)) continue;
        return "parameter " + quoted(parameter.name) + ": " + quoted(listed(parameter.values), 100) + " is from the codebook " +
               quoted(codebook, 200) + ", which is unknown here; " +
               (known.empty() ? "the component has no codebook for it: leave codebook_ref out"
                              : "expected one of " + listed(known));
    }
    return {};
}

std::optional<ParameterList> RegisteredComponent::in_own_frame(ParameterList const& list) const {
    auto const has_a_frame = [&](Parameter const& parameter) {
        return !parameter.data_type_ref.codebook_ref.empty() || is_position(parameter.name);
    };
    if (frames_.are_one() || std::ranges::none_of(list, has_a_frame)) return {};
    auto changed = list;
    for (auto& parameter : changed)
        if (has_a_frame(parameter)) frames_.change(parameter, crs_, Frames::Rounding::millionth);
    return changed;
}

ParameterList RegisteredComponent::merged(ParameterList stored, ParameterList const& arrived) const {
    if (start_arguments_.empty()) {
        merge(stored, arrived, settable_);
    } else {
        auto kept = arrived;
        std::erase_if(kept, [&](Parameter const& each) { return find_parameter(start_arguments_, each.name) != nullptr; });
        merge(stored, kept, settable_);
    }
    replace_alternatives(stored, arrived);
    return stored;
}

void RegisteredComponent::replace_alternatives(ParameterList& stored, ParameterList const& arrived) const {
    for (auto const& group : alternatives_) {
        auto const has_arrived = [&](std::string const& name) {
            return std::ranges::any_of(arrived, [&](Parameter const& each) { return equal_ignoring_case(each.name, name); });
        };
        if (std::ranges::none_of(group, has_arrived)) continue;
        std::erase_if(stored, [&](Parameter const& each) { return is_among(group, each.name) && !has_arrived(each.name); });
    }
}

std::optional<std::string> RegisteredComponent::why_no_start(ParameterList const& normalized) const {
    return why_incomplete(start_arguments_, normalized);
}

ParameterList RegisteredComponent::for_start(ParameterList stored, ParameterList const& arrived) const {
    if (start_arguments_.empty()) return stored;
    auto own = arrived;
    std::erase_if(own, [&](Parameter const& each) { return find_parameter(start_arguments_, each.name) == nullptr; });
    own = with_defaults(start_arguments_, own);
    std::erase_if(stored, [&](Parameter const& each) { return find(own, each.name) != nullptr; });
    own.insert(own.end(), stored.begin(), stored.end());
    return own;
}

RegisteredComponent& Registry::add(std::shared_ptr<RegisteredComponent> component) {
    auto const& ref = component->ref().code;
    auto const [place, added] = components_.try_emplace(ref, nullptr);
    if (!added) throw std::runtime_error("there are two components with the ref " + quoted(ref));
    place->second = std::move(component);
    auto& registered = *place->second;
    parameters_.clear();
    index_.add(registered);
    if (registered.moves()) moving_.push_back(&registered);
    if (registered.is_logical()) logical_.push_back(&registered);
    for (auto const& message : registered.profile().messages) change(message).components.add(registered);
    return registered;
}

void Registry::remove(RegisteredComponent const& component) {
    index_.remove(component);
    std::erase(moving_, &component);
    std::erase(logical_, &component);
    for (auto const& message : component.profile().messages) change(message).components.remove(component);
    components_.erase(component.ref().code);
    parameters_.clear();
}

void Registry::mark_members() noexcept {
    for (auto const& [ref, component] : components_) component->is_member = false;
    for (auto const* component : logical_)
        for (auto const& ref : component->members())
            if (auto* member = find(ref)) member->is_member = true;
}

// Forgets the collected results of the message.
Registry::Providers& Registry::change(MessageProfile const& message) {
    auto& providers = by_message_[message.kind][message.name];
    providers.results.clear();
    return providers;
}

Registry::Providers const& Registry::providers(MessageKind kind, std::string_view message) const {
    static Providers const none;
    auto const by_name = by_message_.find(kind);
    if (by_name == by_message_.end()) return none;
    auto const found = by_name->second.find(message);
    return found == by_name->second.end() ? none : found->second;
}

RegisteredComponent* Registry::find(std::string_view ref) const {
    auto const found = components_.find(ref);
    return found == components_.end() ? nullptr : found->second.get();
}

Registry::Lookup Registry::meant(Identifier const& ref, Session const& asker) const {
    auto* const component = find(ref.code);
    if (component == nullptr || !may_see(asker.rights.get(), ref.code)) return {nullptr, "unknown component " + quoted(ref.code)};
    auto const& own = component->ref();
    auto const foreign = [&](std::string_view what, std::string const& given, std::vector<std::string> const& known) {
        return Lookup{nullptr, "the component_ref " + quoted(ref.code) + " has the " + std::string{what} + " " +
                                   quoted(given, 200) + ", which is not the component's; expected one of " + listed(known)};
    };
    std::vector<std::string> const codebooks{own.codebook_ref.empty() ? component->entry().type : own.codebook_ref};
    bool const known_codebook = ref.codebook_ref.empty() || is_among(codebooks, ref.codebook_ref);
    if (!known_codebook && !is_codebook_of_all_components(ref.codebook_ref))
        return foreign("codebook_ref", ref.codebook_ref, codebooks);
    if (ref.authority.empty() || own.authority.empty() || equal_ignoring_case(ref.authority, own.authority))
        return {component, {}};
    return foreign("authority", ref.authority, {own.authority});
}

Registry::Bound Registry::bind(RegisteredComponent& component, Session& session, Instant now) {
    if (component.bound_to != nullptr && component.bound_to != &session) return Bound::taken;
    if (component.has_failed_to_halt()) return Bound::not_halted;
    if (component.bound_to == nullptr) {
        component.forget_reported_errors();
        component.restore_defaults(now);  // commands of an ended session may still run (on_session_end), and have set parameters
        component.answer = 0;
    }
    session.bound.insert(&component);
    component.bound_to = &session;
    return Bound::ok;
}

}  // namespace rois
