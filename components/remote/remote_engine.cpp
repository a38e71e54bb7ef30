// The components of a sub engine: how they come and go with its profile, and what they report.
#include "remote/remote_engine.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "remote/remote_component.hpp"
#include "remote/times.hpp"
#include "types/identifier_length.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::remote {

namespace {

constexpr std::size_t most_states = 100'000;  // of components that may be in the next profile
constexpr int deepest = 8;                    // levels of engines
constexpr std::chrono::seconds between_restores{1};
// Names that a component's profile declares. The engine compares them with one another, while all applications wait.
constexpr std::size_t most_names = 500;
constexpr std::size_t most_engines = 500;  // with robots

// The instance of a robot begins with that of its engine ("e1.robot2"). Robots do not count as a level.
void collect(EngineProfile const& profile, int level, std::string const& instance_above, std::vector<std::string>& instances) {
    auto const* parameter = find_parameter(profile.parameters, "instance");
    auto const instance = parameter == nullptr ? std::string{} : parameter->default_value.value_or("");
    bool const is_robot =
        (instance == instance_above || instance.starts_with(instance_above + ".")) && profile.sub_profiles.empty();
    if (!is_robot) ++level;
    if (level > deepest) throw std::runtime_error("its engines have more than " + std::to_string(deepest) + " levels");
    if (!instance.empty()) instances.push_back(instance);
    for (auto const& sub : profile.sub_profiles) collect(sub, level, instance, instances);
}

// Adds `instance` and `crs` of the sub engine and of its own sub engines: engines above this one find loops by the instances.
void add_engines(EngineProfile const& profile, Translation const& translation,
                 std::map<std::string, std::vector<ParameterProfile>>& engines) {
    auto& parameters = engines[translation.engine_here(profile.object.name)];
    for (auto each : profile.parameters) {
        if (each.name == "crs" && each.default_value) translation.to_here(*each.default_value);
        if (each.name == "crs" || each.name == "instance") parameters.push_back(std::move(each));
    }
    for (auto const& sub : profile.sub_profiles) add_engines(sub, translation, engines);
}

std::size_t count_names(ComponentProfile const& profile) {
    auto count = profile.parameters.size() + profile.messages.size();
    for (auto const& message : profile.messages) count += message.arguments.size() + message.results.size();
    return count;
}

// Throws std::runtime_error if this engine cannot have such a component. A ref with a dot must begin with the name of the
// component's engine, or of an engine that contains it: "robot.navigation" may belong to the engine "robot.arm".
void check(ComponentEntry const& entry, std::string const& name) {
    auto const& ref = entry.ref;
    auto const dot = ref.rfind('.');
    auto const prefix = dot == std::string::npos ? std::string_view{} : std::string_view{ref}.substr(0, dot);
    auto const code = dot == std::string::npos ? std::string_view{ref} : std::string_view{ref}.substr(dot + 1);
    bool const is_of_prefix =
        prefix.empty() ? dot == std::string::npos : (entry.engine + ".").starts_with(std::string{prefix} + ".");
    auto const refuse = [&](std::string const& why) {
        throw std::runtime_error("its component " + quoted(ref, 100) + " " + why);
    };
    if (code.empty() || trimmed(code) != code) refuse("has no name, or one that begins or ends with white space");
    if (!is_of_prefix) refuse("has a dot in its name, and is not of an engine with such a name");
    if (name.size() + 1 + ref.size() > longest_identifier)
        refuse("has a name of " + std::to_string(ref.size()) + " characters: expected at most " +
               std::to_string(longest_identifier - name.size() - 1));
    if (!entry.profile || !entry.traits) refuse("lacks its profile or its traits (decision 41)");
    if (auto const names = count_names(*entry.profile); names > most_names)
        refuse("has " + std::to_string(names) + " messages, arguments, results and parameters: expected at most " +
               std::to_string(most_names));
}

}  // namespace

RemoteEngine::RemoteEngine(SubEngine settings, std::shared_ptr<RemoteEngineHost> host)
    : settings_{std::move(settings)}, host_{std::move(host)} {
    state_.name = settings_.name;
    state_.link = settings_.url.empty() ? "joins as " + settings_.joins : settings_.url;
}

// --- Its profile ---

void RemoteEngine::ask_profile() {
    profile_changed_ = profile_asked_;
    if (std::exchange(profile_asked_, true)) return;
    host_->at(host_->now() + time_for_attempt, [self = shared_from_this(), era = era_] {
        if (self->era_ == era && self->profile_asked_) self->reject("no answer to get_profile within " + shown(time_for_attempt));
    });
    ask(GetProfile{}, [self = shared_from_this()](Reply const* reply) {
        self->profile_asked_ = false;
        auto const* profile = reply == nullptr ? nullptr : std::get_if<GetProfile::Reply>(reply);
        if (profile == nullptr) return;
        self->take_profile(*profile);
        if (std::exchange(self->profile_changed_, false)) self->ask_profile();
    });
}

void RemoteEngine::take_profile(GetProfile::Reply const& reply) {
    try {
        if (reply.return_code != ReturnCode::ok || !reply.profile)
            throw std::runtime_error("get_profile failed: " + reply.reason);
        std::vector<std::string> instances;
        collect(*reply.profile, 1, {}, instances);
        if (auto const why = host_->why_loop(settings_, instances)) throw std::runtime_error(*why);
        enter(reply);
    } catch (std::exception const& problem) {
        leave(problem.what());
        return give_up_link(problem.what());
    }
    if (lost_at_ && !last_error_.empty()) host_->report(settings_.name, "present again");
    lost_at_.reset();
    failures_ = 0;
    last_error_.clear();
    is_present_ = true;
    note_missing();
    show();
    subscribe();
    restore();
}

void RemoteEngine::note_missing() {
    std::vector<std::string> missing;
    for (auto const& ref : settings_.components)
        if (!record_of(ref)) missing.push_back(ref);
    bool const has_engine = settings_.engine.empty() || !records_.empty();
    if (!has_engine) missing = {settings_.engine};
    if (std::exchange(missing_, missing) == missing || missing.empty()) return;
    note("it lacks " + listed(missing) + ", which the engines file names in \"" + (has_engine ? "components" : "engine") + "\"");
}

// Components whose profile has changed leave, and come again.
void RemoteEngine::enter(GetProfile::Reply const& reply) {
    auto const& profile = *reply.profile;
    auto const* crs = find_parameter(profile.parameters, "crs");
    auto const frame = crs == nullptr ? std::string{} : crs->default_value.value_or("");
    Translation const translation{settings_.name, profile.object.name,
                                  frame,          !settings_.placement,
                                  reply.space,    {.there = settings_.engine, .here = host_->own_name()}};
    ComponentChange change{.going = {}, .coming = {}, .belongings = {}, .provider = settings_.name};
    if (settings_.placement && !frame.empty()) {
        auto const& [position, orientation, covariance] = *settings_.placement;
        change.belongings.frames.push_back({.crs = translation.frame_here(),
                                            .base = {},
                                            .position = position,
                                            .orientation = orientation,
                                            .covariance = covariance});
    }
    std::vector<std::string> left_out, refused;
    change.belongings.space = translation.to_here(reply.space, left_out);
    if (settings_.engine.empty()) add_engines(profile, translation, change.belongings.engines);
    if (change.belongings.engines.size() > most_engines)
        throw std::runtime_error("it has more than " + std::to_string(most_engines) + " engines and robots");
    Records records;
    auto const is_taken = [&](ComponentEntry const& entry) {
        if (!settings_.engine.empty() && entry.engine != settings_.engine) return false;
        return settings_.components.empty() || std::ranges::find(settings_.components, entry.ref) != settings_.components.end();
    };
    for (auto const& entry : reply.components) {
        if (!is_taken(entry)) continue;
        check(entry, settings_.name);
        if (records.size() >= settings_.most_components)
            throw std::runtime_error("it has more than " + std::to_string(settings_.most_components) + " components");
        auto const known = record_of(entry.ref);
        bool const stays = known && *known->entry.profile == *entry.profile && *known->entry.traits == *entry.traits &&
                           known->entry.engine == entry.engine;
        auto& record = records[entry.ref];
        if (record) throw std::runtime_error("it has two components with the ref " + quoted(entry.ref));
        record = stays ? known : std::make_shared<ComponentRecord>(entry, translation.component_here(entry.ref));
        if (stays) continue;
        auto description = description_of(entry, *record, translation);
        change.coming.push_back(std::make_unique<RemoteComponent>(std::move(description), record, shared_from_this()));
    }
    for (auto const& [ref, record] : records_) {
        auto const found = records.find(ref);
        if (found != records.end() && found->second == record) continue;
        change.going.push_back(record->ref);
    }
    translation_ = translation;
    auto const before = std::exchange(records_, std::move(records));
    bool const changes = !change.going.empty() || !change.coming.empty();
    bool const differs = changes || before.empty() || profile != profile_ || reply.space != space_;
    try {
        if (differs) refused = host_->change(std::move(change));
    } catch (...) {
        records_ = before;
        throw;
    }
    if (!std::exchange(earlier_.commands, {}).empty()) {
        for (auto& each : ended_) translation.to_here(each.results);
        host_->commands_ended(settings_.name, std::exchange(ended_, {}));
    }
    for (auto const& [ref, record] : before)
        if (record_of(ref) != record && record->is_held) ask(Release{{.code = ref}}, [](Reply const*) {});
    profile_ = profile;
    space_ = reply.space;
    left_out.insert(left_out.end(), refused.begin(), refused.end());
    if (differs) report_left_out(left_out);
    if (changes || !is_present_)
        host_->report(settings_.name,
                      "present with " + std::to_string(records_.size()) + (records_.size() == 1 ? " component" : " components"));
}

// One line for all frames and places that are left out: the sub engine is used without them.
void RemoteEngine::report_left_out(std::vector<std::string> const& left_out) const {
    if (left_out.empty()) return;
    auto const others = left_out.size() - 1;
    host_->report(settings_.name,
                  "left out: " + left_out.front() + (others == 0 ? "" : ", and " + std::to_string(others) + " more"));
}

ComponentDescription RemoteEngine::description_of(ComponentEntry const& entry, ComponentRecord const& record,
                                                  Translation const& translation) const {
    auto shown = *entry.profile;
    shown.sub_components.clear();  // their messages are in it
    translation.to_here(shown);
    ComponentDescription description;
    description.ref = {
        .code = record.ref, .authority = shown.object.code_space, .codebook_ref = shown.object.identifier, .version = {}};
    description.engine = translation.engine_here(entry.engine);
    description.profile = std::make_shared<ComponentProfile const>(std::move(shown));
    description.provider = settings_.name;
    description.returns_at_once = true;
    description.crs = translation.frame_here();
    description.positions = entry.traits->positions;
    description.codebooks = entry.traits->codebooks;
    description.alternatives = entry.traits->alternatives;
    description.status_when_stopped = entry.traits->status_when_stopped;
    description.moves = entry.traits->moves;
    description.confirms_binding = true;
    return description;
}

// All events, whether an application here wants them or not: so no subscription here has to wait for the sub engine.
void RemoteEngine::subscribe() {
    for (auto const& [ref, record] : records_) {
        for (auto const& message : record->entry.profile->messages) {
            if (message.kind != MessageKind::event || !subscribed_.insert(message.name).second) continue;
            ask(Subscribe{.event_type = message.name, .condition = {}, .inline_results = true}, [](Reply const*) {});
        }
    }
}

// The components that applications here have bound are bound again, with their parameters: in a new session, and after each
// change of the profile, because a component may have left and returned.
void RemoteEngine::restore() {
    for (auto const& [ref, record] : records_)
        if (record->is_wanted) restore(record);
}

// Repeated until it succeeds: the component's own engine may return later.
void RemoteEngine::restore(std::shared_ptr<ComponentRecord> const& record) {
    bind_there(record, [self = shared_from_this(), record, era = era_](Reply const* reply) {
        if (record->is_held && !record->stored.empty()) self->restore_parameters(record);
        if (record->is_held || reply == nullptr) return;
        self->host_->at(self->host_->now() + between_restores, [self, record, era] {
            bool const is_missing = record->is_wanted && !record->is_held && record->binds_asked == 0;
            if (is_missing && self->era_ == era && self->record_of(record->entry.ref) == record) self->restore(record);
        });
    });
}

// Sets them only if they differ: the component may be acting.
void RemoteEngine::restore_parameters(std::shared_ptr<ComponentRecord> const& record) {
    ask(GetParameter{{.code = record->entry.ref}}, [self = shared_from_this(), record](Reply const* reply) {
        auto const* there = reply == nullptr ? nullptr : std::get_if<GetParameter::Reply>(reply);
        auto stored = self->translation_.to_there(record->stored, record->entry);
        auto const is_set = [&](Parameter const& each) {
            auto const* known = there == nullptr ? nullptr : find(there->parameters, each.name);
            return known != nullptr && known->values == each.values;
        };
        if (reply != nullptr && !std::ranges::all_of(stored, is_set))
            self->command(record, "set_parameter", std::move(stored), self->fresh_id(),
                          [](CompletedStatus, std::string const&) {});
    });
}

std::shared_ptr<ComponentRecord> RemoteEngine::record_of(std::string_view ref) const {
    auto const found = records_.find(ref);
    return found == records_.end() ? nullptr : found->second;
}

// --- What it reports ---

void RemoteEngine::operator()(ReceiveEvent const& event) {
    auto const record = record_of(event.component_ref.code);
    if (!record || !event.results) return;
    auto results = *event.results;
    translation_.to_here(results);
    record->report(EventOccurred{event.event_type, std::make_shared<Results const>(std::move(results))});
}

void RemoteEngine::operator()(ReceiveError const& error) {
    auto const text = error.text.value_or("an error without a text");
    auto const record = error.component_ref ? record_of(error.component_ref->code) : nullptr;
    bool const may_be_taken = error.error_type == ErrorType::user_defined_error && record && record->is_held;
    if (may_be_taken) check_binding(record, [] {});
    if (record) return record->report(ErrorOccurred{error.error_type, text});
    if (!error.component_ref) note(text);  // else it is of a component that is not used here
}

void RemoteEngine::operator()(ComponentChanged const& changed) {
    auto const& ref = changed.component_ref.code;
    auto const record = record_of(ref);
    bool const is_new = !record && !states_.contains(ref);
    if (is_new && states_.size() >= most_states) return;  // no engine has so many components
    auto const& known = states_[ref] = changed;
    if (record) report_state(*record, known);
}

void RemoteEngine::report_state(ComponentRecord& record, ComponentChanged const& changed) const {
    ComponentState state{.status = changed.status, .location = {}, .parameters = changed.results.parameters};
    translation_.to_here(state.parameters);
    if (!changed.results.located.empty()) {
        auto& location = state.location.emplace(changed.results.located.front());
        translation_.to_here(location);
        location.ref = translation_.engine_here(location.ref);
    }
    record.report(std::make_shared<ComponentState const>(std::move(state)));
}

// A component that is logical in the sub engine goes on with another of its members.
void RemoteEngine::operator()(Switched const& switched) {
    if (auto const record = record_of(switched.component_ref.code))
        record->report(MemberSwitched{translation_.component_here(switched.from), translation_.component_here(switched.to),
                                      switched.reason});
}

void RemoteEngine::operator()(Completed const& completed) {
    auto const found = commands_.find(completed.command_id.text);
    if (found == commands_.end()) return;  // it ended before, or never began
    auto command = commands_.extract(found);
    try {
        command.mapped()(completed);
    } catch (...) {
        commands_.insert(std::move(command));  // `recover` ends it
        throw;
    }
}

}  // namespace rois::remote
