#include "choosing/logical.hpp"

#include <algorithm>
#include <utility>

#include "types/asking.hpp"

namespace rois::choosing {

Identifier identifier(std::string const& ref) { return {ref, {}, {}, {}}; }

Outcome outcome_of(Reply const* reply) {
    if (reply == nullptr) return {ReturnCode::error, "the engine could not perform the operation"};
    auto const& outcome = rois::outcome_of(*reply);
    return {outcome.return_code, reason_of_only_command(outcome)};
}

Execute execution(std::string const& ref, std::string const& type, ParameterList const& arguments, bool check_only) {
    return {.command_unit_list = {{{{}, CommandMessage{identifier(ref), type, {}, arguments}}}}, .check_only = check_only};
}

Logical::Logical(ComponentDescription description, std::shared_ptr<Roster> roster)
    : description_{std::move(description)}, roster_{std::move(roster)}, members_{roster_->members_of(description_.ref.code)} {}

// The component may replace one of the same name that was in use.
void Logical::attach(ComponentPort& port) {
    port_ = &port;
    roster_->forget_engine_in_use(name());
    roster_->note_bound(name(), false);
    show();
}

void Logical::session_began(Instant) {
    abort_commands();
    for (auto* member : members_) forget(*member);
    running_.clear();
    on_trial_.clear();
    subscribed_.clear();
    beginning_ = 0;
    waiting_.clear();
    learn_space();
}

void Logical::member_freed(std::string const& ref) {
    if (auto* member = roster_->find(ref)) forget(*member);
}

// --- Binding ---

void Logical::bind(Ticket ticket, Binding const& binding, Instant) {
    bool const is_possible = binding.session == binding_.session || std::ranges::any_of(members_, &Member::can_act);
    if (!is_possible) return port_->answered(ticket, Refused{none_is_free()});
    binding_ = binding;
    roster_->note_bound(name(), true);
    port_->answered(ticket, Done{});
}

void Logical::released(Instant) {
    roster_->forget_engine_in_use(name());
    roster_->note_bound(name(), false);
    binding_ = {};
    members_released();
    for (auto const* member : members_) release_unused(member->ref);
    show();
}

void Logical::ask(Operation operation, Answered then) {
    port_->ask(std::move(operation), [then = std::move(then)](Reply const* reply) { then(outcome_of(reply)); });
}

void Logical::bind_member(std::string const& ref, Answered then) {
    ask(Bind{identifier(ref)}, [this, ref, then = std::move(then)](Outcome const& outcome) {
        if (outcome.return_code == ReturnCode::ok) roster_->find(ref)->is_bound = true;
        then(outcome);
    });
}

void Logical::release_member(std::string const& ref) {
    roster_->find(ref)->is_bound = false;
    ask(Release{identifier(ref)}, [](Outcome const&) {});
}

// A member that has not confirmed a halt yet is released when it does: until then it may move.
void Logical::release_unused(std::string const& ref) {
    bool const is_needed = is_used(ref) || halting_.contains(ref) || on_trial_.contains(ref);
    if (roster_->find(ref)->is_bound && !is_needed) release_member(ref);
}

void Logical::give_back(std::string const& ref) {
    halting_.erase(ref);
    release_unused(ref);
}

// The member has left, which ended its binding.
void Logical::forget(Member& member) {
    member.is_bound = false;
    halting_.erase(member.ref);
}

// --- Commands ---

// Only checks: `begin` chooses again, because the command may begin later.
void Logical::prepare(Ticket ticket, std::string_view command_type, ParameterList const& parameters, Instant) {
    if (auto why = why_never(command_type)) return port_->answered(ticket, Refused{std::move(*why)});
    auto const type = std::string{command_type};
    choose(candidates(parameters), type, parameters, [this, type, parameters, ticket](Choice const& choice) {
        if (choice.ref.empty() && choice.why.return_code == ReturnCode::bad_parameter)
            return port_->answered(ticket, Refused{choice.why.reason});
        if (choice.ref.empty()) return port_->answered(ticket, Failed{choice.why.reason});
        if (type == "start") planned(choice.ref);
        port_->answered(ticket, [this, type, parameters](CommandHandle command, Instant) { begin(type, parameters, command); });
    });
}

// `why_not`: the reason to report if no other member accepts the command; BAD_PARAMETER only if all members answered that.
void Logical::choose(std::vector<std::string> refs, std::string const& type, ParameterList const& parameters,
                     Chosen const& chosen, std::optional<Outcome> const& why_not) {
    if (refs.empty()) return chosen({{}, why_not.value_or(Outcome{ReturnCode::error, none_is_free()})});
    auto const ref = refs.front();
    refs.erase(refs.begin());
    on_trial_.insert(ref);
    auto const judge = [this, ref, refs, type, parameters, chosen, why_not](Outcome const& outcome) {
        if (auto const trial = on_trial_.find(ref); trial != on_trial_.end()) on_trial_.erase(trial);
        bool const is_chosen = outcome.return_code == ReturnCode::ok;
        if (is_chosen) chosen({ref, {}});
        release_unused(ref);
        if (is_chosen) return;
        bool const counts = !why_not || outcome.return_code != ReturnCode::bad_parameter;
        choose(refs, type, parameters, chosen, counts ? Outcome{outcome.return_code, ref + ": " + outcome.reason} : why_not);
    };
    bind_member(ref, [this, ref, type, parameters, judge](Outcome const& bound) {
        if (bound.return_code != ReturnCode::ok) {
            could_not_bind(ref);
            return judge(bound);
        }
        auto const arguments = arguments_for(parameters, *roster_->find(ref));
        if (!arguments) return judge({ReturnCode::error, "it does not sense the target now"});
        ask(execution(ref, type, *arguments, true), judge);
    });
}

void Logical::command(std::string const& ref, std::string const& type, ParameterList const& arguments, Answered begun,
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

void Logical::stop(std::string const& ref, std::function<void(bool stands)> const& then) {
    auto const begun = [then](Outcome const& outcome) {
        if (outcome.return_code != ReturnCode::ok) then(false);
    };
    command(ref, "stop", {}, begun, [then](Completed const& completed) { then(completed.status == CompletedStatus::ok); });
}

// All members that are bound may be moving: during a switch, these are two.
void Logical::halt(Ticket ticket, Instant) {
    forget_commands();
    is_suspended_ = false;
    auto const moving = std::make_shared<std::size_t>(1);
    auto const one_less = [this, moving, ticket] {
        if (--*moving == 0) port_->halted(ticket);
    };
    for (auto const* member : members_) {
        if (!member->is_bound) continue;
        ++*moving;
        halting_.insert(member->ref);
        stop(member->ref, [this, one_less, ref = member->ref](bool stands) {
            if (!stands) return;  // the engine calls `halt` again
            if (halting_.erase(ref) > 0) release_unused(ref);
            one_less();
        });
    }
    one_less();
}

void Logical::suspend(Ticket ticket, Instant) {
    is_suspended_ = true;
    pause(ticket, "suspend");
}

void Logical::resume(Ticket ticket, Instant) {
    is_suspended_ = false;
    pause(ticket, "resume");
}

void Logical::start_ended() {
    if (beginning_ == 0) return;
    --beginning_;
    if (beginning_ > 0) return;
    for (auto const& what : std::exchange(waiting_, {})) what();
}

// Suspends or resumes all members that are bound. A failure of one is the answer.
void Logical::pause(Ticket ticket, std::string const& command_type) {
    if (beginning_ > 0) {
        waiting_.emplace_back([this, ticket, command_type] { pause(ticket, command_type); });
        return;
    }
    auto const left = std::make_shared<std::size_t>(1);
    auto const one_less = [this, left, ticket](Completed const& completed) {
        if (*left == 0) return;
        if (completed.status != CompletedStatus::ok) {
            *left = 0;
            return port_->answered(ticket, Failed{completed.reason});
        }
        if (--*left == 0) port_->answered(ticket, Done{});
    };
    for (auto const* member : members_) {
        if (!member->is_bound) continue;
        ++*left;
        auto const begun = [one_less](Outcome const& outcome) {
            if (outcome.return_code != ReturnCode::ok) one_less({{}, CompletedStatus::error, {}, outcome.reason, {}});
        };
        command(member->ref, command_type, {}, begun, one_less);
    }
    one_less({});
}

void Logical::query(Ticket ticket, std::string_view query_type, Instant) {
    if (shown_member_.empty()) return port_->answered(ticket, std::vector<Results>{});
    port_->ask(Query{std::string{query_type}, is_component(shown_member_)},
               [this, ticket](Reply const* reply) { port_->answered(ticket, rows_of(reply)); });
}

// --- What the members report ---

void Logical::notified(Notification const& notification, Instant now) {
    if (auto const* completed = std::get_if<Completed>(&notification)) notified_of(*completed);
    if (auto const* change = std::get_if<ComponentChanged>(&notification)) notified_of(*change);
    if (std::holds_alternative<ProfileChanged>(notification)) learn_space();
    if (auto const* event = std::get_if<ReceiveEvent>(&notification); event != nullptr && event->results != nullptr)
        if (auto const* member = roster_->find(event->component_ref.code)) happened(*event, *member, now);
    auto const* error = std::get_if<ReceiveError>(&notification);
    if (error == nullptr || !error->component_ref || binding_.session == 0) return;
    auto const& ref = error->component_ref->code;
    if (auto const* member = roster_->find(ref); member != nullptr && member->is_bound)
        port_->error(error->error_type, ref + ": " + error->text.value_or(""));
}

void Logical::notified_of(Completed const& completed) {
    auto const found = running_.find(completed.command_id.text);
    if (found == running_.end()) return;
    auto const over = std::move(found->second);
    running_.erase(found);
    over(completed);
}

void Logical::notified_of(ComponentChanged const& change) {
    auto const& ref = change.component_ref.code;
    auto* member = roster_->find(ref);
    if (member == nullptr) return;
    roster_->note(*member, change.status, change.results);
    if (member->is_there())
        subscribe_to(ref);
    else
        forget(*member);
    changed(*member);
    show();
}

void Logical::learn_space() {
    port_->ask(GetProfile{is_component(name())}, [this](Reply const* reply) {
        auto const* known = reply == nullptr ? nullptr : std::get_if<GetProfile::Reply>(reply);
        if (known == nullptr || known->profile == nullptr) return;
        auto const* crs = find_parameter(known->profile->parameters, "crs");
        roster_->set_space(known->space, crs == nullptr ? std::string{} : crs->default_value.value_or(""));
    });
}

void Logical::subscribe_to(std::string const& ref) {
    if (!subscribed_.insert(ref).second) return;
    for (auto const& message : description_.profile->messages)
        if (message.kind == MessageKind::event) ask(Subscribe{message.name, is_component(ref), true}, [](Outcome const&) {});
}

// The status is the best of the members'. BUSY, which means bound by an application, counts as READY.
void Logical::show() {
    ComponentState state;
    auto const has = [this](ComponentStatus status) {
        return std::ranges::any_of(members_, [&](Member const* each) { return each->status == status; });
    };
    using Status = ComponentStatus;
    if (has(Status::ready) || has(Status::busy))
        state.status = has_warning() ? Status::warning : Status::ready;
    else if (has(Status::warning) || has(Status::error))
        state.status = has(Status::warning) ? Status::warning : Status::error;
    auto const* member = shown();
    shown_member_ = member == nullptr ? std::string{} : member->ref;
    if (member != nullptr) {
        state.location = member->location;
        state.parameters = member->parameters;
    }
    if (shown_ == state) return;
    shown_ = state;
    port_->changed(std::move(state));
}

}  // namespace rois::choosing
