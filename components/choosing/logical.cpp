#include "choosing/logical.hpp"

#include <algorithm>
#include <utility>

namespace rois::choosing {

namespace {

Condition is_component(std::string const& ref) {
    return {PropertyComparison{Comparator::equal, {ValueReference{"component_ref"}}, {Literal{ref}}}};
}

}  // namespace

Identifier identifier(std::string const& ref) { return {ref, {}, {}, {}}; }

Outcome outcome_of(Reply const* reply) {
    if (reply == nullptr) return {ReturnCode::error, "the engine could not perform the operation"};
    return std::visit([](Outcome const& outcome) { return outcome; }, *reply);
}

Execute execution(std::string const& ref, std::string const& type, ParameterList const& arguments, bool check_only) {
    return {.command_unit_list = {{{{}, CommandMessage{identifier(ref), type, {}, arguments}}}}, .check_only = check_only};
}

Logical::Logical(ComponentDescription description, std::shared_ptr<Roster> roster)
    : description_{std::move(description)}, roster_{std::move(roster)} {}

void Logical::attach(ComponentPort& port) {
    port_ = &port;
    show();
}

void Logical::session_began(Instant now) {
    abort_commands(now);
    for (auto* member : members()) forget(*member);
    running_.clear();
    subscribed_.clear();
    beginning_ = 0;
    waiting_.clear();
    learn_space();
}

// --- Binding ---

void Logical::bind(Ticket ticket, Binding const& binding, Instant) {
    bool const is_possible = binding.session == binding_.session || std::ranges::any_of(members(), &Member::can_act);
    if (!is_possible) return port_->answered(ticket, Refused{"none of its members is free and READY"});
    binding_ = binding;
    port_->answered(ticket, Done{});
}

// Members that have not confirmed a halt are given back when they have.
void Logical::released(Instant) {
    for (auto const* member : members())
        if (member->is_bound && !halting_.contains(member->ref)) give_back(member->ref);
    roster_->use(binding_.session, name(), {});
    binding_ = {};
    is_free();
    show();
}

void Logical::ask(Operation operation, Answered then) {
    port_->ask(std::move(operation), [then = std::move(then)](Reply const* reply) { then(outcome_of(reply)); });
}

void Logical::use(std::string const& ref, Answered then) {
    ask(Bind{identifier(ref)}, [this, ref, then = std::move(then)](Outcome const& outcome) {
        if (outcome.return_code == ReturnCode::ok) roster_->find(ref)->is_bound = true;
        then(outcome);
    });
}

void Logical::give_back(std::string const& ref) {
    roster_->find(ref)->is_bound = false;
    ask(Release{identifier(ref)}, [](Outcome const&) {});
}

// It has left, and its binding has ended.
void Logical::forget(Member& member) {
    member.is_bound = false;
    halting_.erase(member.ref);
}

// --- Commands ---

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
    command(ref, "stop", {}, begun,
            [then](Completed const& completed, Instant) { then(completed.status == CompletedStatus::ok); });
}

// All members that are bound may be moving: during a switch, these are two.
void Logical::halt(Ticket ticket, Instant now) {
    forget_commands(now);
    auto const moving = std::make_shared<std::size_t>(1);
    auto const one_less = [this, moving, ticket] {
        if (--*moving == 0) port_->halted(ticket);
    };
    for (auto const* member : members()) {
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

void Logical::suspend(Ticket ticket, Instant) { pause(ticket, "suspend"); }

void Logical::resume(Ticket ticket, Instant) { pause(ticket, "resume"); }

void Logical::has_begun() {
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
    auto const one_less = [this, left, ticket](Completed const& completed, Instant) {
        if (*left == 0) return;
        if (completed.status != CompletedStatus::ok) {
            *left = 0;
            return port_->answered(ticket, Failed{completed.reason});
        }
        if (--*left == 0) port_->answered(ticket, Done{});
    };
    for (auto const* member : members()) {
        if (!member->is_bound) continue;
        ++*left;
        auto const begun = [one_less](Outcome const& outcome) {
            if (outcome.return_code != ReturnCode::ok) one_less({{}, CompletedStatus::error, {}, outcome.reason, {}}, {});
        };
        command(member->ref, command_type, {}, begun, one_less);
    }
    one_less({}, {});
}

void Logical::query(Ticket ticket, std::string_view query_type, Instant) {
    if (shown_member_.empty()) return port_->answered(ticket, std::vector<Results>{});
    port_->ask(Query{std::string{query_type}, is_component(shown_member_)}, [this, ticket](Reply const* reply) {
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

void Logical::notified(Notification const& notification, Instant now) {
    if (auto const* completed = std::get_if<Completed>(&notification)) notified_of(*completed, now);
    if (auto const* change = std::get_if<ComponentChanged>(&notification)) notified_of(*change, now);
    if (std::holds_alternative<ProfileChanged>(notification)) learn_space();
    if (auto const* event = std::get_if<ReceiveEvent>(&notification); event != nullptr && event->results != nullptr)
        if (auto const* member = roster_->find(event->component_ref.code)) happened(*event, *member, now);
    auto const* error = std::get_if<ReceiveError>(&notification);
    if (error == nullptr || !error->component_ref || binding_.session == 0) return;
    auto const& ref = error->component_ref->code;
    if (auto const* member = roster_->find(ref); member != nullptr && member->is_bound)
        port_->error(error->error_type, ref + ": " + error->text.value_or(""));
}

void Logical::notified_of(Completed const& completed, Instant now) {
    auto const found = running_.find(completed.command_id.text);
    if (found == running_.end()) return;
    auto const over = std::move(found->second);
    running_.erase(found);
    over(completed, now);
}

void Logical::notified_of(ComponentChanged const& change, Instant now) {
    auto const& ref = change.component_ref.code;
    auto* member = roster_->find(ref);
    if (member == nullptr) return;
    roster_->note(*member, change.status, change.results);
    if (member->is_there())
        subscribe_to(ref);
    else
        forget(*member);
    changed(*member, now);
    show();
}

void Logical::learn_space() {
    port_->ask(GetProfile{is_component(name())}, [this](Reply const* reply) {
        auto const* known = reply == nullptr ? nullptr : std::get_if<GetProfile::Reply>(reply);
        if (known == nullptr || known->profile == nullptr) return;
        auto const* crs = find_parameter(known->profile->parameters, "crs");
        roster_->know(known->space, crs == nullptr ? std::string{} : crs->default_value.value_or(""));
    });
}

void Logical::subscribe_to(std::string const& ref) {
    if (!subscribed_.insert(ref).second) return;
    for (auto const& message : description_.profile->messages)
        if (message.kind == MessageKind::event) ask(Subscribe{message.name, is_component(ref), true}, [](Outcome const&) {});
}

// The status is the best of the members'. An application that has bound a member does not change it.
void Logical::show() {
    ComponentState state;
    auto const has = [all = members()](ComponentStatus status) {
        return std::ranges::find(all, status, [](Member const* each) { return each->status; }) != all.end();
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
