#include "engine/commands/executor.hpp"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <utility>

#include "engine/commands/parameters.hpp"
#include "engine/commands/sequence_check.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// The commands of a session that have not finished, in the order in which they were given.
std::vector<std::shared_ptr<Command>> live_commands(Session const& session) {
    std::vector<std::shared_ptr<Command>> live;
    for (auto const& [id, command] : session.commands)
        if (!command->finished) live.push_back(command);
    std::ranges::sort(live, {}, [](auto const& command) { return command->handle; });
    return live;
}

// An ended session has no lease.
bool is_proven_alive(Session const* session, Instant now) { return session != nullptr && now.steady < session->lease.end(); }

// The `completed` of a command. Other engines also receive its results.
Completed notice_of(Command const& command) {
    Completed notice{command.id, command.status};
    if (!command.session->is_engine) return notice;
    notice.results = std::make_shared<Results const>(command.results);
    notice.reason = command.reason;
    notice.active = command.component && command.component->activity == RegisteredComponent::Activity::active;
    return notice;
}

}  // namespace

// A command and its sequence and component refer to each other. Breaks these cycles for the commands that still run.
Executor::~Executor() {
    for (auto const& [handle, command] : live_) {
        command->execution.reset();
        command->component->start.reset();
        command->component->functions.clear();
        command->component->halting.reset();
    }
}

CommandId Executor::fresh_id(Session const& session, std::set<CommandId> const& taken) {
    while (true) {
        CommandId id{"c-" + std::to_string(++last_id_)};
        if (!taken.contains(id) && !session.commands.contains(id)) return id;
    }
}

Executor::SharedCommand Executor::make(Session& session, CommandMessage const& message, Preparation&& prepared) {
    auto command = std::make_shared<Command>();
    auto const& component = prepared.component;
    auto const& profiles = *arguments_of(*component, message.command_type);
    command->handle = CommandHandle{++last_handle_};
    command->id = message.command_id;
    command->type = message.command_type;
    command->ref = component->ref().code;
    command->stops = prepared.stops;
    command->session = &session;
    command->session_number = session.number;
    command->hold = component->answer = session.notifications->current();
    command->component = component;
    command->arguments = normalized(profiles, message.arguments);
    if (!stores_arguments(message.command_type)) command->arguments = with_defaults(profiles, command->arguments);
    command->begin = std::move(prepared.begin);
    command->prepared_for = std::move(prepared.parameters);
    live_.emplace(last_handle_, command);
    session.commands.emplace(command->id, command);
    recorder_.changed(command);
    return command;
}

std::shared_ptr<Execution> Executor::make(Session& session, CommandUnitSequence const& sequence,
                                          std::vector<Preparation> prepared) {
    auto const before = last_handle_;
    // When the sequence ends, cancels the delays that are not over.
    auto const give_up = [this](Execution* over) {
        for (auto const& delay : over->delays) deadlines_.cancel(delay);
        delete over;
    };
    std::shared_ptr<Execution> execution;
    try {
        auto next = prepared.begin();
        auto made = std::make_unique<Execution>(
            sequence, [&](CommandMessage const& message) { return make(session, message, std::move(*next++)); });
        execution = {made.release(), give_up};
    } catch (...) {
        forget_made(session, before);
        throw;
    }
    for (auto const& command : execution->commands()) command->execution = execution;
    return execution;
}

void Executor::begin(std::shared_ptr<Execution> const& execution, Instant now) {
    try {
        give_turns(execution, execution->begin(0), now);
    } catch (...) {
        give_up_waiting(*execution);
        throw;
    }
    run_ready(now);
}

void Executor::restore(Session& session, SharedCommand const& command, Instant now) {
    session.commands.emplace(command->id, command);
    command->reported = command->notified;
    finish(command, now);
}

void Executor::ended_there(SharedCommand const& command, CommandEnded&& ended, Instant now) {
    if (command->component) command->component->accept(ended);
    end(command, ended.status, ended.reason, now, std::move(ended.results));
}

void Executor::drop(Session& session, Execution const& execution) {
    Attempts attempts;
    for (auto const& command : execution.commands())
        if (command->state != Command::State::ended) attempts([&] { recorder_.forgot(session, command); });
    take_back(&session, execution);
    attempts.rethrow();
}

void Executor::give_turns(std::shared_ptr<Execution> const& execution, std::vector<Execution::Turn> const& turns, Instant now) {
    for (auto const& turn : turns) {
        if (turn.delay.count() == 0) {
            ready_.emplace_back(execution, turn.node);
            continue;
        }
        auto const action = [this, waiting = std::weak_ptr{execution}, node = turn.node](Instant then) {
            auto const alive = waiting.lock();
            if (!alive) return;
            ready_.emplace_back(alive, node);
            run_ready(then);
        };
        execution->delays.push_back(deadlines_.add(now.steady + turn.delay, action));
    }
}

// Begins all units whose turn has come, also those whose turn comes meanwhile. A loop, not a recursion, because sequences can be
// long.
void Executor::run_ready(Instant now) {
    if (std::exchange(running_ready_, true)) return;
    Attempts attempts;
    while (!ready_.empty()) {
        auto const [execution, node] = std::move(ready_.front());
        ready_.pop_front();
        if (auto const& command = execution->command_at(node)) {
            attempts([&] { attempt(command, [&] { run(command, now); }); });
        } else if (!attempts([&] { give_turns(execution, execution->begin(node), now); })) {
            give_up_waiting(*execution);
        }
    }
    running_ready_ = false;
    attempts.rethrow();
}

void Executor::run(SharedCommand const& command, Instant now) {
    if (command->state != Command::State::waiting || command->given_up) return;
    if (command->binding_lost || command->component->bound_to != command->session)
        return end(command, CompletedStatus::abort, "the component was released before the command's turn came", now);
    command->state = Command::State::running;
    trace_->command_begun(*command);
    if (command->component->moves() && begins_action(command->type) && !is_proven_alive(command->session, now))
        return end(command, CompletedStatus::abort, "the application gave no sign of life before the command's turn came", now);
    if (command->type == "set_parameter") return run_set_parameter(command, now);
    if (command->type == "start") return run_start(command, now);
    if (command->type == "stop") return run_stop(command, now);
    if (command->type == "suspend") return run_suspend(command, now);
    if (command->type == "resume") return run_resume(command, now);
    run_function(command, now);
}

void Executor::run_set_parameter(SharedCommand const& command, Instant now) {
    auto& component = *command->component;
    store_arguments(*command);
    await_start(command, now);
    begin(command, component.parameters, now);
}

void Executor::run_start(SharedCommand const& command, Instant now) {
    store_arguments(*command);
    go_on_with_start(command, now);
}

void Executor::store_arguments(Command const& command) {
    auto& component = *command.component;
    bool const is_stored = command.session != nullptr && recorder_.stores(*command.session);
    auto const before = is_stored ? component.parameters : ParameterList{};
    component.parameters = component.merged(std::move(component.parameters), command.arguments);
    if (is_stored && component.parameters != before) recorder_.changed(*command.session);
}

void Executor::go_on_with_start(SharedCommand const& command, Instant now) {
    auto& component = *command->component;
    if (command->state != Command::State::running) return;
    if (component.activity != RegisteredComponent::Activity::idle)
        end_action(component, CompletedStatus::abort, "another start replaced it", now);
    if (component.halting) return wait_for_halt(command, now);
    component.activity = RegisteredComponent::Activity::running;
    component.start = command;
    component.note_begin();
    await_start(command, now);
    begin(command, component.for_start(component.parameters, command->arguments), now);
}

// If another command has changed the stored parameters since the command was prepared, it is prepared again.
void Executor::begin(SharedCommand const& command, ParameterList parameters, Instant now) {
    if (parameters == command->prepared_for) return begin(command, now);
    auto& component = *command->component;
    auto then = [this, command](std::optional<ComponentAnswer>& answer, Instant when) {
        if (command->state != Command::State::running || !answer) return;
        if (auto* prepared = std::get_if<Begin>(&*answer)) {
            command->begin = std::move(*prepared);
            return begin(command, when);
        }
        auto const* refused = std::get_if<Refused>(&*answer);
        begin_failed(command, refused == nullptr ? "the component failed" : refused->reason, when);
        run_ready(when);
    };
    auto const due = now.steady + settings_.question_deadline;
    auto const ticket =
        questions_.ask(component, due, "the component did not answer whether a command is possible", std::move(then));
    auto changed = component.in_own_frame(parameters);
    component.hosted().prepare(ticket, command->type, changed ? std::move(*changed) : std::move(parameters), now);
}

void Executor::begin(SharedCommand const& command, Instant now) {
    command->component->hosted().begin(command->handle, std::exchange(command->begin, {}), now);
}

void Executor::begin_failed(SharedCommand const& command, std::string_view reason, Instant now) {
    auto& component = *command->component;
    if (component.start == command) {
        component.activity = RegisteredComponent::Activity::idle;
        component.start = nullptr;
    }
    std::erase(component.functions, command);
    Attempts attempts;
    if (command->type != "set_parameter") attempts([&] { halt_if_it_moves(component, now); });
    attempts([&] { end(command, CompletedStatus::error, reason, now); });
    attempts.rethrow();
}

void Executor::failed(CommandHandle handle, Instant now) {
    auto const found = live_.find(static_cast<std::uint64_t>(handle));
    if (found == live_.end() || found->second->state != Command::State::running) return;
    auto const command = found->second;
    begin_failed(command, "the component failed", now);
    run_ready(now);
}

void Executor::run_stop(SharedCommand const& command, Instant now) {
    auto& component = *command->component;
    auto const status_of_start = component.status_when_stopped();
    halt(component, status_of_start, status_of_start == CompletedStatus::ok ? "" : "it was stopped", now);
    if (component.halting) return wait_for_halt(command, now);
    end(command, CompletedStatus::ok, {}, now);
}

void Executor::run_function(SharedCommand const& command, Instant now) {
    auto& component = *command->component;
    if (command->state != Command::State::running) return;
    if (component.halting) return wait_for_halt(command, now);
    component.functions.push_back(command);
    component.note_begin();
    await_start(command, now);
    begin(command, now);
}

std::chrono::milliseconds Executor::time_to_start(Command const& command) const {
    auto const* message = find_message(command.component->profile(), MessageKind::command, command.type);
    return message->timeout.value_or(settings_.start_timeout);
}

void Executor::await_start(SharedCommand const& command, Instant now) {
    command->start_deadline = deadlines_.add(now.steady + time_to_start(*command),
                                             [this, handle = command->handle](Instant then) { start_timed_out(handle, then); });
}

void Executor::start_timed_out(CommandHandle handle, Instant now) {
    auto const found = live_.find(static_cast<std::uint64_t>(handle));
    if (found == live_.end() || found->second->state != Command::State::running) return;
    auto const command = found->second;
    auto& component = *command->component;
    auto const reason = "the component " + quoted(component.ref().code) + " did not start the command " + quoted(command->type) +
                        " within " + in_seconds(time_to_start(*command));
    agenda_.add({command->component, ErrorType::component_not_responding, reason});
    command->start_deadline.reset();
    bool const is_start = component.start == command;
    std::erase(component.functions, command);
    Attempts attempts;
    attempts([&] { halt(component, is_start ? CompletedStatus::timeout : CompletedStatus::abort, reason, now); });
    attempts([&] { end(command, CompletedStatus::timeout, reason, now); });
    attempts([&] { run_ready(now); });
    attempts.rethrow();
}

void Executor::started(CommandHandle handle) {
    auto const found = live_.find(static_cast<std::uint64_t>(handle));
    if (found == live_.end() || found->second->state != Command::State::running) {
        ++stray_answers_;
        return;
    }
    if (auto const deadline = std::exchange(found->second->start_deadline, {})) deadlines_.cancel(*deadline);
}

void Executor::completed(CommandEnded& report, Instant now) {
    auto const found = live_.find(static_cast<std::uint64_t>(report.command));
    if (found == live_.end() || found->second->state != Command::State::running) {
        ++stray_answers_;
        return;
    }
    auto const command = found->second;
    auto& component = *command->component;
    component.accept(report);
    if (component.check(MessageKind::command, command->type, report.results) == RegisteredComponent::Fit::wrong) {
        report.status = CompletedStatus::error;
        report.results = {};
        report.reason = "its results do not fit the profile";
    }
    if (report.status == CompletedStatus::ok) component.clear_failure();
    std::erase(component.functions, command);
    follow_up(component, command, report.status == CompletedStatus::ok ? report.afterwards : Afterwards::as_before);
    end(command, report.status, report.reason, now, std::move(report.results));
    run_ready(now);
}

// A `start` halts any running action first, so nothing was active before it. The end of another command does not affect a running
// `start`.
void Executor::follow_up(RegisteredComponent& component, SharedCommand const& command, Afterwards afterwards) {
    using Activity = RegisteredComponent::Activity;
    bool const starts = component.start == command;
    if (starts) component.start = nullptr;
    if (component.start) return;
    bool const active = afterwards == Afterwards::active ||
                        (afterwards == Afterwards::as_before && !starts && component.activity == Activity::active);
    component.activity = active ? Activity::active : Activity::idle;
    if (!active && component.functions.empty()) component.suspended = Suspended::nothing;
}

// Sets the command's state first. If a later step fails, the next tick finishes it.
void Executor::end(SharedCommand const& command, CompletedStatus status, std::string_view reason, Instant now, Results results) {
    if (command->state == Command::State::ended) return;
    command->state = Command::State::ended;
    command->status = status;
    command->results = std::move(results);
    command->ended_at = now.steady;
    command->ended_utc = now.utc;
    if (command->start_deadline) deadlines_.cancel(*command->start_deadline);
    ++completed_by_status_.at(static_cast<std::size_t>(status));
    attempt(command, [&] {
        command->reason = reason;
        finish(command, now);
    });
}

// Notifies the session, keeps the results, and continues the sequence.
void Executor::finish(SharedCommand const& command, Instant now) {
    if (!command->reported) {
        trace_->command_ended(*command);
        recorder_.changed(command);
        if (command->session != nullptr) notifier_.notify(*command->session, notice_of(*command), command->hold);
        command->reported = true;
    }
    ParameterList{}.swap(command->arguments);  // from now on, only its results are needed
    ParameterList{}.swap(command->prepared_for);
    command->begin = {};
    if (command->session != nullptr) remember(command, now);
    if (auto const execution = std::exchange(command->execution, nullptr)) {
        try {
            go_on_in_sequence(execution, *command, now);
        } catch (...) {
            give_up_waiting(*execution);
            throw;
        }
    }
    command->finished = true;
    live_.erase(static_cast<std::uint64_t>(command->handle));
}

void Executor::go_on_in_sequence(std::shared_ptr<Execution> const& execution, Command const& ended, Instant now) {
    auto const turns = execution->command_ended(ended.node, ended.status);
    for (auto const& aborted : execution->take_aborted())
        end(aborted, CompletedStatus::abort,
            "the command " + quoted(ended.id.text) + " of its sequence ended with " + std::string{to_text(ended.status)}, now);
    give_turns(execution, turns, now);
}

void Executor::remember(SharedCommand const& command, Instant now) {
    auto& session = *command->session;
    if (!command->kept) {
        session.ended.push_back(command);
        command->kept = true;
        if (session.ended.size() == 1) by_age_.emplace(command->ended_at, &session);
    }
    forget_old_results(session, now);
}

void Executor::forget_old_results(Session& session, Instant now) {
    auto const is_old = [&](Command const& command) {
        return session.ended.size() > settings_.max_command_results || command.ended_at + settings_.command_results <= now.steady;
    };
    forget_while(session, is_old);
}

void Executor::keep_results(Session& session, std::size_t most) {
    forget_while(session, [&](Command const&) { return session.ended.size() > most; });
}

// Removes the oldest results of the session while `is_old` returns true.
void Executor::forget_while(Session& session, std::function<bool(Command const&)> const& is_old) {
    if (session.ended.empty() || !is_old(*session.ended.front())) return;
    forget(session);
    while (!session.ended.empty() && is_old(*session.ended.front())) {
        recorder_.forgot(session, session.ended.front());
        session.commands.erase(session.ended.front()->id);
        session.ended.pop_front();
    }
    if (!session.ended.empty()) by_age_.emplace(session.ended.front()->ended_at, &session);
}

void Executor::forget_old_results(Instant now) {
    while (!by_age_.empty() && by_age_.begin()->first + settings_.command_results <= now.steady)
        forget_old_results(*by_age_.begin()->second, now);
}

void Executor::forget(Session& session) {
    if (!session.ended.empty()) by_age_.erase({session.ended.front()->ended_at, &session});
}

// An engine stops its component before it releases it: halting it once more would delay the next binding. A component of another
// engine is halted there if it does not stand still.
void Executor::release(Session& session, RegisteredComponent& component, Instant now, std::string_view reason) {
    bool const is_halted_elsewhere = session.is_engine || component.confirms_binding();
    if (!is_halted_elsewhere || !component.stands_still) halt(component, CompletedStatus::abort, reason, now);
    for (auto const& command : live_commands(session))
        if (command->component.get() == &component) command->binding_lost = true;
    run_ready(now);
}

void Executor::part(RegisteredComponent& component, Instant now) {
    Attempts attempts;
    attempts([&] { halt(component, CompletedStatus::abort, "its component was removed", now); });
    attempts([&] { forget_halt(component, now); });
    for (auto const& [handle, command] : live_)
        if (command->component.get() == &component) command->binding_lost = true;
    attempts([&] { run_ready(now); });
    attempts.rethrow();
}

void Executor::abort_all(Session& session, Instant now) {
    Attempts attempts;
    for (auto const& command : live_commands(session)) {
        bool const ended = command->state == Command::State::ended;
        attempts([&] { ended ? finish(command, now) : end(command, CompletedStatus::abort, "its session has ended", now); });
    }
    attempts([&] { run_ready(now); });
    attempts.rethrow();
}

void Executor::stop_all(std::string_view reason, Instant now) {
    Attempts attempts;
    for (auto const& [ref, component] : registry_.all()) attempts([&] { halt(*component, CompletedStatus::abort, reason, now); });
    // The others wait for the journal, and have no answer yet: those that begin an action will be refused.
    auto begun = live_ | std::views::values |
                 std::views::filter([](auto const& each) { return !each->execution || each->execution->has_begun(); });
    std::vector<SharedCommand> live;
    bool const listed = attempts([&] { std::ranges::copy(begun, std::back_inserter(live)); });
    if (listed) attempts([&] { end_each(live, CompletedStatus::abort, reason, now); });
    if (!listed)
        for (auto const& command : begun) give_up(*command);
    attempts.rethrow();
}

void Executor::detach_commands(Session& session) {
    for (auto const& command : live_commands(session)) command->session = nullptr;
}

}  // namespace rois
