#include "choosing/acting.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "types/text/texts.hpp"

namespace rois::choosing {

namespace {

using namespace std::chrono_literals;

constexpr auto between_switches = 5s;  // of a command, at least

// The arguments without the targets that are reached.
ParameterList rest_of(ParameterList parameters, std::size_t reached) {
    for (auto& parameter : parameters) {
        if (!equal_ignoring_case(parameter.name, "target_position")) continue;
        auto const done = static_cast<std::ptrdiff_t>(std::min(reached, parameter.values.size()));
        parameter.values.erase(parameter.values.begin(), parameter.values.begin() + done);
    }
    return parameters;
}

Completed failure(Outcome const& why) {
    Completed completed;
    completed.status = why.return_code == ReturnCode::timeout ? CompletedStatus::timeout : CompletedStatus::error;
    completed.reason = why.reason;
    return completed;
}

}  // namespace

Acting::Acting(ComponentDescription description, std::shared_ptr<Roster> roster, std::shared_ptr<Sightings> sightings)
    : Logical{std::move(description), std::move(roster)}, sightings_{std::move(sightings)} {}

bool Acting::acts(std::string const& ref) const {
    return std::ranges::any_of(actions_, [&](auto const& each) { return each->member == ref; });
}

bool Acting::is_used(std::string const& ref) const { return ref == current_ || acts(ref); }

// Releases the previous member, unless another command still runs on it.
void Acting::note_current(std::string const& ref) {
    auto const before = std::exchange(current_, ref);
    if (!before.empty()) release_unused(before);
    roster().note_engine_in_use(name(), binding().session, roster().find(ref)->engine);
    show();
}

// --- Choosing ---

std::vector<std::string> Acting::candidates(ParameterList const& parameters) {
    if (auto const* current = roster().find(current_); is_active_ && current != nullptr && current->can_act()) return {current_};
    Occasion occasion{
        .session = binding().session, .order = binding().order, .target = {}, .current = current_, .now = sightings_->now()};
    if (auto const* targets = find(parameters, "target_position"); targets != nullptr && !targets->values.empty())
        occasion.target = roster().position_of(targets->values.front());
    if (auto const* person = find(parameters, "target_object_ref"); person != nullptr && !person->values.empty())
        occasion.target = sightings_->position_of(person->values.front());
    std::vector<std::string> refs;
    for (auto const* member : in_order(members(), occasion, roster())) refs.push_back(member->ref);
    return refs;
}

// Replaces fused names of persons by the member's own. Returns nullopt if the member does not sense the person.
std::optional<ParameterList> Acting::arguments_for(ParameterList const& parameters, Member const& member) const {
    auto arguments = parameters;
    for (auto& parameter : arguments) {
        bool const is_fused = parameter.data_type_ref.codebook_ref == fused_codebook && parameter.values.size() == 1;
        if (!is_fused) continue;
        auto const own = sightings_->translated(parameter.values.front(), member.engine);
        if (!own) return {};
        parameter.values.front() = own->code;
        parameter.data_type_ref.codebook_ref = own->codebook_ref;
    }
    return arguments;
}

void Acting::let_go_of(std::string const& failed) {
    if (failed != current_ || acts(failed)) return;
    current_.clear();
    release_unused(failed);
}

// In a parallel unit the commands of other components begin before this one has chosen again.
void Acting::planned(std::string const& ref) {
    if (auto const* current = roster().find(current_); current != nullptr && !current->can_act()) let_go_of(current->ref);
    if (description().moves) roster().note_plan(name(), binding().session, roster().find(ref)->engine, sightings_->now());
}

void Acting::choose_for(SharedAction const& action, Chosen const& chosen) {
    auto const parameters = rest_of(action->parameters, action->reached);
    auto refs = candidates(parameters);
    std::erase_if(refs, [&](std::string const& ref) { return action->failed.contains(ref); });
    choose(std::move(refs), action->type, parameters, [action, chosen](Choice const& choice) {
        if (choice.ref.empty() || !action->is_over) return chosen(choice);
        chosen({{}, {ReturnCode::error, "the command was stopped while a member was being chosen"}});
    });
}

// --- Commands ---

void Acting::begin(std::string const& command_type, ParameterList const& parameters, CommandHandle command) {
    auto const action = std::make_shared<Action>(Action{.type = command_type, .parameters = parameters, .handle = command});
    actions_.push_back(action);
    end_suspension();
    start_began();
    choose_for(action, [this, action](Choice const& choice) {
        if (!choice.ref.empty()) return carry_out(action, choice.ref);
        finish(action, failure(choice.why));
        start_ended();
    });
}

// From here on the member carries out the command, or the rest of it.
void Acting::carry_out(SharedAction const& action, std::string const& ref) {
    action->member = ref;
    action->began_low = roster().find(ref)->has_low_battery;
    note_current(ref);
    auto const engine = roster().find(ref)->engine;
    auto const begun = [this, action, engine](Outcome const& outcome) {
        if (outcome.return_code == ReturnCode::ok) {
            if (!action->is_over) port().started(action->handle);
        } else {
            note_speech(*action, engine, false);
            ended(action, failure(outcome));
        }
        start_ended();
    };
    auto const over = [this, action, engine](Completed const& completed) {
        note_speech(*action, engine, false);
        ended(action, completed);
    };
    note_speech(*action, engine, true);
    auto const arguments = arguments_for(rest_of(action->parameters, action->reached), *roster().find(ref));
    if (!arguments) return begun({ReturnCode::error, ref + ": it does not sense the target now"});
    command(ref, action->type, *arguments, begun, over);
}

void Acting::note_speech(Action const& action, std::string const& engine, bool speaks) const {
    if (action.type == "start" && find_parameter(description().profile->parameters, "speech_text") != nullptr)
        roster().note_speech(engine, speaks, sightings_->now());
}

// The member's command has ended without a `stop` from here.
void Acting::ended(SharedAction const& action, Completed const& completed) {
    if (action->is_over || action->is_leaving) return;
    bool const is_good = completed.status == CompletedStatus::ok;
    auto const* member = roster().find(action->member);
    // The member has not failed if the application's own time limit has passed. A member that does not answer has the status
    // ERROR.
    bool const is_over = completed.status == CompletedStatus::timeout && find(action->parameters, "time_limit") != nullptr &&
                         member != nullptr && member->can_act();
    bool const may_switch = action->type == "start" && binding().switching != Switching::none;
    if (is_good || is_over || !may_switch) return finish(action, completed);
    action->failed.insert(action->member);
    // ABORT: the member stands still. Either its engine has stopped it, or its engine was lost and has ended our session.
    if (completed.status == CompletedStatus::abort) return go_on_with_another(action, completed);
    leave(action, completed);
}

// Stops the member first. `as`: how the command ends if no other member goes on.
void Acting::leave(SharedAction const& action, Completed const& as) {
    action->is_leaving = true;
    stop(action->member, [this, action, as](bool stands) {
        action->is_leaving = false;
        if (action->is_over) return;
        if (stands) return go_on_with_another(action, as);
        auto last = as;
        last.reason += "; " + action->member + " has not confirmed that it stands still";
        finish(action, last);
    });
}

// Returns why the member should not go on with the action. With a low battery it goes on if no other member can take over.
std::optional<std::string> Acting::why_leave(Action const& action, Member const& member) const {
    if (member.is_outside) return member.ref + " has left its area";
    if (!member.has_low_battery || action.began_low) return {};
    bool const has_other = std::ranges::any_of(members(), [&](Member const* each) {
        return each != &member && each->can_act() && !each->has_low_battery && !action.failed.contains(each->ref);
    });
    if (binding().switching == Switching::restart && !has_other) return {};
    return "the battery of " + member.ref + " is low";
}

void Acting::leave_unsuitable() {
    if (binding().switching == Switching::none) return;
    for (auto const& action : std::vector{actions_}) {
        auto const* member = roster().find(action->member);
        bool const acts = member != nullptr && action->type == "start" && !action->is_leaving;
        if (!acts || was_switched_just_now(*action)) continue;
        if (auto const why = why_leave(*action, *member)) leave(action, {{}, CompletedStatus::abort, {}, *why, {}});
    }
}

bool Acting::was_switched_just_now(Action const& action) const {
    return action.switched && sightings_->now() < *action.switched + between_switches;
}

void Acting::go_on_with_another(SharedAction const& action, Completed const& completed) {
    auto const end = [this, action, completed](std::string const& why) {
        auto last = completed;
        last.status = CompletedStatus::abort;
        last.reason += why;
        finish(action, last);
    };
    if (binding().switching == Switching::abort) return end({});
    if (is_suspended()) return end("; no other component goes on, because the application has suspended it");
    if (was_switched_just_now(*action)) return end("; it was switched less than " + in_seconds(between_switches) + " ago");
    auto const from = std::exchange(action->member, {});
    action->switched = sightings_->now();
    start_began();
    choose_for(action, [this, action, completed, from, end](Choice const& choice) {
        if (choice.ref.empty()) {
            end("; no other component can go on: " + choice.why.reason);
            return start_ended();
        }
        port().switched(from, choice.ref, completed.reason);
        carry_out(action, choice.ref);
    });
}

void Acting::finish(SharedAction const& action, Completed const& completed) {
    if (std::exchange(action->is_over, true)) return;
    std::erase(actions_, action);
    if (completed.active && action->member == current_) is_active_ = *completed.active;
    auto const afterwards = !completed.active ? Afterwards::as_before : *completed.active ? Afterwards::active : Afterwards::idle;
    port().completed(action->handle, completed.status, completed.results ? *completed.results : Results{}, afterwards,
                     completed.reason);
}

void Acting::forget_commands() {
    for (auto const& action : actions_) action->is_over = true;
    actions_.clear();
    is_active_ = false;
}

void Acting::abort_commands() {
    for (auto const* member : members()) roster().note_speech(member->engine, false, sightings_->now());
    for (auto const& action : std::vector{actions_})
        finish(action, {{}, CompletedStatus::abort, {}, "its session has ended", {}});
    use_none();
}

void Acting::use_none() {
    current_.clear();
    is_active_ = false;
}

void Acting::changed(Member const& member) {
    if (member.ref == current_ && !member.can_act()) is_active_ = false;
    leave_unsuitable();
}

void Acting::happened(ReceiveEvent const& event, Member const& member, Instant) {
    if (member.ref != current_) return;
    if (event.event_type == "reached_target")
        for (auto const& action : actions_)
            if (action->member == member.ref) ++action->reached;
    port().event(event.event_type, *event.results);
}

Member const* Acting::shown() {
    if (auto const* current = roster().find(current_)) return current;
    auto const first = std::ranges::find_if(members(), &Member::can_act);
    return first == members().end() ? nullptr : *first;
}

}  // namespace rois::choosing
