#include "choosing/acting.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "types/text/texts.hpp"

namespace rois::choosing {

namespace {

using namespace std::chrono_literals;

constexpr auto between_switches = 5s;  // of a command, at least

Identifier identifier(std::string const& ref) { return {ref, {}, {}, {}}; }

Condition is_member(std::string const& ref) {
    return {PropertyComparison{Comparator::equal, {ValueReference{"component_ref"}}, {Literal{ref}}}};
}

Outcome outcome_of(Reply const* reply) {
    if (reply == nullptr) return {ReturnCode::error, "the engine could not perform the operation"};
    return std::visit([](Outcome const& outcome) { return outcome; }, *reply);
}

// The arguments for what is left to do.
ParameterList rest_of(ParameterList parameters, std::size_t reached) {
    for (auto& parameter : parameters) {
        if (!equal_ignoring_case(parameter.name, "target_position")) continue;
        auto const done = static_cast<std::ptrdiff_t>(std::min(reached, parameter.values.size()));
        parameter.values.erase(parameter.values.begin(), parameter.values.begin() + done);
    }
    return parameters;
}

Execute execution(std::string const& ref, std::string const& type, ParameterList const& arguments, bool check_only = false) {
    return {.command_unit_list = {{{{}, CommandMessage{identifier(ref), type, {}, arguments}}}}, .check_only = check_only};
}

Completed failure(Outcome const& why) {
    Completed completed;
    completed.status = why.return_code == ReturnCode::timeout ? CompletedStatus::timeout : CompletedStatus::error;
    completed.reason = why.reason;
    return completed;
}

}  // namespace

Acting::Acting(ComponentDescription description, std::shared_ptr<Roster> roster)
    : description_{std::move(description)}, name_{description_.ref.code}, roster_{std::move(roster)} {}

void Acting::attach(ComponentPort& port) {
    port_ = &port;
    show();
}

void Acting::session_began(Instant) {
    for (auto const& action : std::vector{actions_})
        finish(action, {{}, CompletedStatus::abort, {}, "its session has ended", {}});
    for (auto* member : roster_->members_of(name_)) forget(*member);
    running_.clear();
    subscribed_.clear();
    current_.clear();
    learn_space();
}

// --- Binding ---

void Acting::bind(Ticket ticket, Binding const& binding, Instant) {
    auto const members = roster_->members_of(name_);
    bool const is_possible = binding.session == binding_.session || std::ranges::any_of(members, &Member::can_act);
    if (!is_possible) return port_->answered(ticket, Refused{"none of its members is free and READY"});
    binding_ = binding;
    port_->answered(ticket, Done{});
}

// Members that have not confirmed a halt are given back when they have.
void Acting::released(Instant) {
    for (auto const* member : roster_->members_of(name_))
        if (member->is_bound && !halting_.contains(member->ref)) give_back(member->ref);
    roster_->use(binding_.session, name_, {});
    binding_ = {};
    current_.clear();
    show();
}

void Acting::ask(Operation operation, Answered then) {
    port_->ask(std::move(operation), [then = std::move(then)](Reply const* reply) { then(outcome_of(reply)); });
}

void Acting::use(std::string const& ref, Answered then) {
    auto const* member = roster_->find(ref);
    if (member->is_bound) return then({});
    ask(Bind{identifier(ref)}, [this, ref, then = std::move(then)](Outcome const& outcome) {
        if (outcome.return_code == ReturnCode::ok) roster_->find(ref)->is_bound = true;
        then(outcome);
    });
}

void Acting::give_back(std::string const& ref) {
    roster_->find(ref)->is_bound = false;
    ask(Release{identifier(ref)}, [](Outcome const&) {});
}

// It has left, and its binding has ended.
void Acting::forget(Member& member) {
    member.is_bound = false;
    halting_.erase(member.ref);
}

bool Acting::is_used(std::string const& ref) const {
    return ref == current_ || std::ranges::any_of(actions_, [&](auto const& each) { return each->member == ref; });
}

// The one that was chosen before is given back, unless another command still runs on it.
void Acting::note_current(std::string const& ref) {
    auto const before = std::exchange(current_, ref);
    if (!before.empty() && !is_used(before) && roster_->find(before)->is_bound) give_back(before);
    roster_->use(binding_.session, name_, roster_->find(ref)->engine);
    show();
}

// --- Choosing ---

std::vector<Member*> Acting::best_members(ParameterList const& parameters) {
    Occasion occasion{.session = binding_.session, .order = binding_.order, .target = {}, .current = current_};
    auto const* targets = find(parameters, "target_position");
    if (targets != nullptr && !targets->values.empty()) occasion.target = roster_->position_of(targets->values.front());
    return in_order(roster_->members_of(name_), occasion, *roster_);
}

void Acting::choose(SharedAction const& action, Chosen chosen) {
    std::vector<std::string> candidates;
    for (auto const* member : best_members(rest_of(action->parameters, action->reached)))
        if (!action->failed.contains(member->ref)) candidates.push_back(member->ref);
    try_next(action, std::move(candidates), {}, std::move(chosen));
}

// `why_not`: the objection to report if no other candidate accepts the command.
void Acting::try_next(SharedAction const& action, std::vector<std::string> candidates, std::optional<Outcome> why_not,
                      Chosen chosen) {
    if (candidates.empty() || action->is_over)
        return chosen({{}, why_not.value_or(Outcome{ReturnCode::error, "none of its members is free and READY"})});
    auto const ref = candidates.front();
    candidates.erase(candidates.begin());
    auto const judge = [this, action, ref, candidates, why_not, chosen](Outcome const& outcome) {
        if (outcome.return_code == ReturnCode::ok && !action->is_over) return chosen({ref, {}});
        if (roster_->find(ref)->is_bound && !is_used(ref)) give_back(ref);
        // BAD_PARAMETER only if all say so.
        bool const counts = !why_not || outcome.return_code != ReturnCode::bad_parameter;
        try_next(action, candidates, counts ? Outcome{outcome.return_code, ref + ": " + outcome.reason} : why_not, chosen);
    };
    use(ref, [this, action, ref, judge](Outcome const& bound) {
        if (bound.return_code != ReturnCode::ok) return judge(bound);
        ask(execution(ref, action->type, rest_of(action->parameters, action->reached), true), judge);
    });
}

// --- Commands ---

// The member that accepts the command now need not be the one that carries it out: the command may begin later.
void Acting::prepare(Ticket ticket, std::string_view command_type, ParameterList const& parameters, Instant) {
    auto const action = std::make_shared<Action>(Action{.type = std::string{command_type}, .parameters = parameters});
    choose(action, [this, action, ticket](Choice const& choice) {
        if (choice.ref.empty() && choice.why.return_code == ReturnCode::bad_parameter)
            return port_->answered(ticket, Refused{choice.why.reason});
        if (choice.ref.empty()) return port_->answered(ticket, Failed{choice.why.reason});
        if (!is_used(choice.ref)) give_back(choice.ref);
        port_->answered(ticket, [this, action](CommandHandle handle, Instant) {
            action->handle = handle;
            begin(action);
        });
    });
}

void Acting::begin(SharedAction const& action) {
    actions_.push_back(action);
    is_suspended_ = false;
    choose(action, [this, action](Choice const& choice) {
        if (choice.ref.empty()) return finish(action, failure(choice.why));
        carry_out(action, choice.ref);
    });
}

// From here on the member carries out the command, or what is left of it.
void Acting::carry_out(SharedAction const& action, std::string const& ref) {
    action->member = ref;
    note_current(ref);
    auto const begun = [this, action](Outcome const& outcome) {
        if (outcome.return_code != ReturnCode::ok) return ended(action, failure(outcome), {});
        if (!action->is_over) port_->started(action->handle);
    };
    auto const over = [this, action](Completed const& completed, Instant now) { ended(action, completed, now); };
    command(ref, action->type, rest_of(action->parameters, action->reached), begun, over);
}

void Acting::command(std::string const& ref, std::string const& type, ParameterList const& arguments, Answered begun,
                     Ended ended) {
    port_->ask(execution(ref, type, arguments), [this, begun = std::move(begun), ended = std::move(ended)](Reply const* reply) {
        auto const outcome = outcome_of(reply);
        if (outcome.return_code == ReturnCode::ok) {
            auto const& units = std::get<Execute::Reply>(*reply).command_unit_list.command_unit_list;
            running_[std::get<CommandMessage>(units.front().unit).command_id.text] = ended;
        }
        begun(outcome);
    });
}

void Acting::stop(std::string const& ref, std::function<void(bool stands)> then) {
    auto const begun = [then](Outcome const& outcome) {
        if (outcome.return_code != ReturnCode::ok) then(false);
    };
    command(ref, "stop", {}, begun,
            [then](Completed const& completed, Instant) { then(completed.status == CompletedStatus::ok); });
}

// The member's command has ended, which was not asked for.
void Acting::ended(SharedAction const& action, Completed const& completed, Instant now) {
    if (action->is_over || action->is_leaving) return;
    bool const is_good = completed.status == CompletedStatus::ok;
    if (is_good || action->type != "start" || binding_.switching == Switching::none) return finish(action, completed);
    action->failed.insert(action->member);
    // With ABORT its engine has stopped it, or it is lost and its engine has given up our session: it stands still.
    if (completed.status == CompletedStatus::abort) return go_on_with_another(action, completed, now);
    leave(action, completed, now);
}

// Stops the member first. `as`: how the command ends if no other member goes on.
void Acting::leave(SharedAction const& action, Completed const& as, Instant now) {
    action->is_leaving = true;
    stop(action->member, [this, action, as, now](bool stands) {
        action->is_leaving = false;
        if (action->is_over) return;
        if (stands) return go_on_with_another(action, as, now);
        auto last = as;
        last.reason += "; " + action->member + " has not confirmed that it stands still";
        finish(action, last);
    });
}

void Acting::leave_outside(Instant now) {
    if (binding_.switching == Switching::none) return;
    for (auto const& action : std::vector{actions_}) {
        auto const* member = roster_->find(action->member);
        bool const acts = member != nullptr && action->type == "start" && !action->is_leaving;
        bool const is_early = action->switched && now.steady < *action->switched + between_switches;
        if (acts && member->is_outside && !is_early)
            leave(action, {{}, CompletedStatus::abort, {}, member->ref + " has left its area", {}}, now);
    }
}

void Acting::go_on_with_another(SharedAction const& action, Completed const& completed, Instant now) {
    auto const end = [this, action, completed](std::string const& why) {
        auto last = completed;
        last.status = CompletedStatus::abort;
        last.reason += why;
        finish(action, last);
    };
    if (binding_.switching == Switching::abort) return end({});
    if (is_suspended_) return end("; no other component goes on, because the application has suspended it");
    if (action->switched && now.steady < *action->switched + between_switches)
        return end("; it was switched less than " + in_seconds(between_switches) + " ago");
    auto const from = std::exchange(action->member, {});
    action->switched = now.steady;
    choose(action, [this, action, completed, from, end](Choice const& choice) {
        if (action->is_over) {  // stopped meanwhile
            if (!choice.ref.empty() && !is_used(choice.ref)) give_back(choice.ref);
            return;
        }
        if (choice.ref.empty()) return end("; no other component can go on: " + choice.why.reason);
        port_->switched(from, choice.ref, completed.reason);
        carry_out(action, choice.ref);
    });
}

void Acting::finish(SharedAction const& action, Completed const& completed) {
    if (std::exchange(action->is_over, true)) return;
    std::erase(actions_, action);
    auto const afterwards = !completed.active ? Afterwards::as_before : *completed.active ? Afterwards::active : Afterwards::idle;
    port_->completed(action->handle, completed.status, completed.results ? *completed.results : Results{}, afterwards,
                     completed.reason);
}

// All members that are bound may be moving: during a switch, these are two.
void Acting::halt(Ticket ticket, Instant) {
    for (auto const& action : actions_) action->is_over = true;
    actions_.clear();
    is_suspended_ = false;
    auto const moving = std::make_shared<std::size_t>(1);
    auto const one_less = [this, moving, ticket] {
        if (--*moving == 0) port_->halted(ticket);
    };
    for (auto const* member : roster_->members_of(name_)) {
        if (!member->is_bound) continue;
        ++*moving;
        halting_.insert(member->ref);
        stop(member->ref, [this, one_less, ref = member->ref](bool stands) {
            if (!stands) return;  // the engine calls `halt` again
            bool const is_first = halting_.erase(ref) > 0;
            if (is_first && binding_.session == 0 && roster_->find(ref)->is_bound) give_back(ref);
            one_less();
        });
    }
    one_less();
}

void Acting::suspend(Ticket ticket, Instant) {
    is_suspended_ = true;
    pause(ticket, "suspend");
}

void Acting::resume(Ticket ticket, Instant) {
    is_suspended_ = false;
    pause(ticket, "resume");
}

void Acting::pause(Ticket ticket, std::string const& command_type) {
    if (current_.empty()) return port_->answered(ticket, Done{});
    command(
        current_, command_type, {},
        [this, ticket](Outcome const& outcome) {
            if (outcome.return_code != ReturnCode::ok) port_->answered(ticket, Failed{outcome.reason});
        },
        [this, ticket](Completed const& completed, Instant) {
            if (completed.status == CompletedStatus::ok) return port_->answered(ticket, Done{});
            port_->answered(ticket, Failed{completed.reason});
        });
}

void Acting::query(Ticket ticket, std::string_view query_type, Instant) {
    auto ref = current_;
    if (auto const best = best_members(); ref.empty() && !best.empty()) ref = best.front()->ref;
    if (ref.empty()) return port_->answered(ticket, std::vector<Results>{});
    port_->ask(Query{std::string{query_type}, is_member(ref)}, [this, ticket](Reply const* reply) {
        std::vector<Results> rows;
        if (auto const* answer = reply == nullptr ? nullptr : std::get_if<Query::Reply>(reply);
            answer != nullptr && answer->return_code == ReturnCode::ok) {
            rows.push_back(answer->results);
            rows.insert(rows.end(), answer->other_rows.begin(), answer->other_rows.end());
        }
        port_->answered(ticket, std::move(rows));
    });
}

// --- What the members report ---

void Acting::notified(Notification const& notification, Instant now) {
    if (auto const* completed = std::get_if<Completed>(&notification)) notified_of(*completed, now);
    if (auto const* event = std::get_if<ReceiveEvent>(&notification)) notified_of(*event);
    if (auto const* changed = std::get_if<ComponentChanged>(&notification)) notified_of(*changed, now);
    if (std::holds_alternative<ProfileChanged>(notification)) learn_space();
    if (auto const* error = std::get_if<ReceiveError>(&notification); error != nullptr && error->component_ref)
        if (error->component_ref->code == current_) port_->error(error->error_type, current_ + ": " + error->text.value_or(""));
}

void Acting::notified_of(Completed const& completed, Instant now) {
    auto const found = running_.find(completed.command_id.text);
    if (found == running_.end()) return;
    auto const over = std::move(found->second);
    running_.erase(found);
    over(completed, now);
}

void Acting::notified_of(ReceiveEvent const& event) {
    auto const& ref = event.component_ref.code;
    if (ref != current_ || event.results == nullptr) return;
    if (event.event_type == "reached_target")
        for (auto const& action : actions_)
            if (action->member == ref) ++action->reached;
    port_->event(event.event_type, *event.results);
}

void Acting::notified_of(ComponentChanged const& changed, Instant now) {
    auto const& ref = changed.component_ref.code;
    auto* member = roster_->find(ref);
    if (member == nullptr) return;
    roster_->note(*member, changed.status, changed.results);
    if (member->is_there())
        subscribe_to(ref);
    else
        forget(*member);
    leave_outside(now);
    show();
}

void Acting::learn_space() {
    port_->ask(GetProfile{is_member(name_)}, [this](Reply const* reply) {
        auto const* known = reply == nullptr ? nullptr : std::get_if<GetProfile::Reply>(reply);
        if (known == nullptr || known->profile == nullptr) return;
        auto const* crs = find_parameter(known->profile->parameters, "crs");
        roster_->know(known->space, crs == nullptr ? std::string{} : crs->default_value.value_or(""));
    });
}

void Acting::subscribe_to(std::string const& ref) {
    if (!subscribed_.insert(ref).second) return;
    for (auto const& message : description_.profile->messages)
        if (message.kind == MessageKind::event) ask(Subscribe{message.name, is_member(ref), true}, [](Outcome const&) {});
}

// The status is the best of the members'. An application that has bound a member does not change it.
void Acting::show() {
    ComponentState state;
    auto const has = [members = roster_->members_of(name_)](ComponentStatus status) {
        return std::ranges::find(members, status, [](Member const* each) { return each->status; }) != members.end();
    };
    using Status = ComponentStatus;
    if (has(Status::ready) || has(Status::busy))
        state.status = Status::ready;
    else if (has(Status::warning) || has(Status::error))
        state.status = has(Status::warning) ? Status::warning : Status::error;
    auto const* shown = roster_->find(current_);
    if (auto const best = best_members(); shown == nullptr && !best.empty()) shown = best.front();
    if (shown != nullptr) {
        state.location = shown->location;
        state.parameters = shown->parameters;
    }
    if (shown_ == state) return;
    shown_ = state;
    port_->changed(std::move(state));
}

}  // namespace rois::choosing
