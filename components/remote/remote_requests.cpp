// What this engine asks of the components of a sub engine: each question or command becomes one request.
#include <algorithm>
#include <utility>

#include "remote/remote_engine.hpp"
#include "types/asking.hpp"
#include "types/text/texts.hpp"

namespace rois::remote {

namespace {

constexpr std::chrono::milliseconds between_questions{50};  // whether everything stands still
constexpr std::chrono::milliseconds between_stops{500};     // of a component that does not answer
constexpr std::size_t most_stops = 4;                       // whose end may still confirm a halt

CompletedStatus status_of_refusal(ReturnCode code) {
    if (code == ReturnCode::out_of_resources) return CompletedStatus::out_of_resources;
    return code == ReturnCode::timeout ? CompletedStatus::timeout : CompletedStatus::error;
}

CommandUnit unit_of(std::string const& ref, std::string type, std::string id, ParameterList arguments) {
    CommandMessage message{.component_ref = {}, .command_type = std::move(type), .command_id = {std::move(id)}, .arguments = {}};
    message.component_ref.code = ref;
    message.arguments = std::move(arguments);
    return {.delay_time = {}, .unit = std::move(message)};
}

}  // namespace

std::string RemoteEngine::why_no_answer() const {
    return refusal_.empty() ? "its engine is lost" : "its engine refuses it: " + refusal_;
}

void RemoteEngine::attach(std::shared_ptr<ComponentRecord> const& record) {
    auto const state = states_.find(record->entry.ref);
    if (state != states_.end()) report_state(*record, state->second);
}

void RemoteEngine::bind(std::shared_ptr<ComponentRecord> const& record, Ticket ticket, Binding const& binding) {
    if (!is_open_) return record->answer(ticket, Failed{why_no_answer()});
    if (!std::exchange(record->is_wanted, true)) record->stored.clear();  // of an earlier application
    if (!binding.parameters.empty()) record->store(binding.parameters);
    bool const is_same = std::exchange(record->switching, binding.switching) == binding.switching;
    if (record->is_held && record->binds_asked == 0 && is_same) return record->answer(ticket, Done{});
    bool const restores = !binding.parameters.empty();
    bind_there(record, [self = shared_from_this(), record, ticket, restores](Reply const* reply) {
        if (reply == nullptr) return record->answer(ticket, Failed{self->why_no_answer()});
        auto const outcome = outcome_of(*reply);
        if (record->is_held && restores) self->restore_parameters(record);
        if (outcome.return_code == ReturnCode::ok) return record->answer(ticket, Done{});
        auto reason = "in the engine " + quoted(self->settings_.name) + ": " + outcome.reason;
        if (outcome.return_code == ReturnCode::out_of_resources) return record->answer(ticket, Refused{std::move(reason)});
        record->answer(ticket, Failed{std::move(reason)});
    });
}

void RemoteEngine::bind_there(std::shared_ptr<ComponentRecord> const& record, Then const& then) {
    ++record->binds_asked;
    ask(Bind{{.code = record->entry.ref}, record->switching}, [self = shared_from_this(), record, then](Reply const* reply) {
        --record->binds_asked;
        record->is_held = reply != nullptr && outcome_of(*reply).return_code == ReturnCode::ok;
        then(reply);
        self->release_unwanted(record);
    });
}

void RemoteEngine::released(std::shared_ptr<ComponentRecord> const& record) {
    record->is_wanted = false;
    record->stored.clear();
    release_unwanted(record);
}

// Releases a binding that no application wants any more, such as one whose answer was late. Keeps it until the component stands
// still: without it, a `stop` that failed could not be repeated.
void RemoteEngine::release_unwanted(std::shared_ptr<ComponentRecord> const& record) {
    if (record->is_wanted || record->binds_asked > 0 || record->halt || !std::exchange(record->is_held, false)) return;
    ask(Release{{.code = record->entry.ref}}, [record](Reply const* reply) {
        if (reply != nullptr && !record->is_held && record->binds_asked == 0) record->end_activity();
    });
}

void RemoteEngine::confirm_halt(std::shared_ptr<ComponentRecord> const& record) {
    record->confirm_halt();
    release_unwanted(record);
}

void RemoteEngine::end_activity(std::shared_ptr<ComponentRecord> const& record) {
    record->end_activity();
    release_unwanted(record);
}

// `start` takes the stored parameters as arguments: they may have been stored while the sub engine was lost.
void RemoteEngine::prepare(std::shared_ptr<ComponentRecord> const& record, Ticket ticket, std::string const& command_type,
                           ParameterList const& parameters) {
    if (!is_open_) return record->answer(ticket, Failed{why_no_answer()});
    auto unit = unit_of(record->entry.ref, command_type, {}, translation_.to_there(parameters, record->entry));
    Execute check{.command_unit_list = {{std::move(unit)}}, .check_only = true};
    ask(std::move(check), [self = shared_from_this(), record, ticket, command_type, parameters](Reply const* reply) {
        if (reply == nullptr) return record->answer(ticket, Failed{self->why_no_answer()});
        auto const outcome = outcome_of(*reply);
        if (outcome.return_code == ReturnCode::bad_parameter)
            return record->answer(ticket, Refused{reason_of_only_command(outcome)});
        if (outcome.return_code != ReturnCode::ok) return record->answer(ticket, Failed{reason_of_only_command(outcome)});
        record->answer(ticket, [self, record, command_type, parameters](CommandHandle command, Instant) {
            self->run([=](RemoteEngine& engine) {
                try {
                    engine.begin(record, command, command_type, parameters);
                } catch (...) {
                    record->report(CommandEnded{.command = command, .status = CompletedStatus::error});
                    throw;
                }
            });
        });
    });
}

void RemoteEngine::begin(std::shared_ptr<ComponentRecord> const& record, CommandHandle command, std::string const& command_type,
                         ParameterList const& parameters) {
    auto const id = id_of(command);
    auto end = [self = shared_from_this(), record, command, command_type, parameters](Completed const& completed) {
        CommandEnded ended{
            .command = command, .status = completed.status, .results = {}, .afterwards = {}, .reason = completed.reason};
        if (completed.results) ended.results = *completed.results;
        self->translation_.to_here(ended.results);
        --record->running;
        // Only a success: a command that was aborted, or has failed, completes before the component stands still.
        bool const has_ended = completed.active == false && completed.status == CompletedStatus::ok;
        if (record->running == 0 && has_ended) self->end_activity(record);
        if (command_type == "set_parameter" && completed.status == CompletedStatus::ok) record->store(parameters);
        if (completed.active) ended.afterwards = *completed.active ? Afterwards::active : Afterwards::idle;
        record->report(std::move(ended));
    };
    commands_.emplace(id, std::move(end));
    record->may_act = true;
    if (command_type != "set_parameter") record->stops.clear();
    ++record->running;
    auto unit = unit_of(record->entry.ref, command_type, id, translation_.to_there(parameters, record->entry));
    ++record->begins_asked;
    ask(Execute{{{std::move(unit)}}},
        [self = shared_from_this(), record, command, id, command_type, parameters](Reply const* reply) {
            if (--record->begins_asked == 0)
                for (auto const& next : std::exchange(record->after_begins, {})) next();
            bool const is_accepted = reply != nullptr && outcome_of(*reply).return_code == ReturnCode::ok;
            if (is_accepted && command_type == "start") record->store(parameters);
            auto const known = self->commands_.find(id);
            if (known == self->commands_.end()) return;  // it has completed
            if (is_accepted) return record->report(CommandStarted{command});
            self->commands_.erase(known);
            --record->running;
            auto const status = reply == nullptr ? CompletedStatus::abort : status_of_refusal(outcome_of(*reply).return_code);
            auto const reason = reply == nullptr ? self->why_no_answer() : reason_of_only_command(outcome_of(*reply));
            record->report(CommandEnded{.command = command, .status = status, .results = {}, .afterwards = {}, .reason = reason});
        },
        {id});
}

// Stops the component, also one that is believed to be idle. The halt is confirmed by the end of `stop`, by the answer to a
// `release` that was sent before, or by the end of the session there: only the sub engine knows whether its component stands
// still.
void RemoteEngine::halt(std::shared_ptr<ComponentRecord> const& record, Ticket ticket) {
    record->halt = ticket;
    bool const can_be_asked = record->can_be_stopped && record->is_held && is_open_;
    if (!record->may_act && !can_be_asked) return host_->everything_is_stopped() ? ask_to_stop() : record->confirm_halt();
    if (!record->is_held || is_given_up_) return;
    if (!record->can_be_stopped) return halt_by_release(record);
    auto& stops = record->stops;
    auto const now = host_->now();
    if (!stops.empty() && now < record->stopped_at + between_stops) return;
    if (stops.size() == most_stops) {
        commands_.erase(stops.front());
        stops.pop_front();
    }
    record->stopped_at = now;
    auto const id = fresh_id();
    stops.push_back(id);
    command(record, "stop", {}, id, [self = shared_from_this(), record, id](CompletedStatus status, std::string const&) {
        bool const is_current = std::erase(record->stops, id) > 0;
        if (!is_current) return;
        if (status == CompletedStatus::error) return self->judge_failed_halt(record);
        if (status != CompletedStatus::ok) return;
        record->stops.clear();
        self->confirm_halt(record);
    });
}

// The halt has failed there, or another session there has taken the component over.
void RemoteEngine::judge_failed_halt(std::shared_ptr<ComponentRecord> const& record) {
    check_binding(record, [record] { record->fail_halt(); });
}

// `bind` changes nothing if the binding is still that of this engine. Otherwise the sub engine has ended what acted for it.
void RemoteEngine::check_binding(std::shared_ptr<ComponentRecord> const& record, std::function<void()> const& if_held) {
    ask(Bind{{.code = record->entry.ref}, record->switching}, [record, if_held](Reply const* reply) {
        if (reply == nullptr || outcome_of(*reply).return_code != ReturnCode::out_of_resources) return if_held();
        record->is_held = false;
        record->end_activity();
    });
}

// For a component without the command `stop`. It is bound again if an application still wants it.
void RemoteEngine::halt_by_release(std::shared_ptr<ComponentRecord> const& record) {
    record->is_held = false;
    ask(Release{{.code = record->entry.ref}}, [self = shared_from_this(), record](Reply const* reply) {
        if (reply == nullptr) return;
        record->end_activity();
        if (record->is_wanted) self->restore(record);
    });
}

// Until then, the halts of components that this engine does not command wait for the sub engine's answer.
void RemoteEngine::clear_stop() {
    clear_stop_there();
    for (auto const& [ref, record] : records_)
        if (!record->may_act && !record->is_held) record->confirm_halt();
}

// Repeated in the next session if this one ends before the answer.
void RemoteEngine::clear_stop_there() {
    if (host_->everything_is_stopped() || !stop_there_ || stop_is_asked_) return;
    ask(ClearStop{*stop_there_}, [self = shared_from_this()](Reply const* reply) {
        if (reply != nullptr) self->note_stop_there({});
    });
}

// After a restart, this engine has to know what it must clear there.
void RemoteEngine::note_stop_there(std::optional<std::uint64_t> stop) {
    if (std::exchange(stop_there_, stop) != stop) host_->stopped_there(settings_.name, stop);
}

// Asks until all components there stand still. A component program does not know this request: it has no other applications.
void RemoteEngine::ask_to_stop() {
    if (!host_->everything_is_stopped() || !is_open_ || std::exchange(stop_is_asked_, true)) return;
    ask(StopEverything{}, [self = shared_from_this()](Reply const* reply) {
        self->stop_is_asked_ = false;
        auto const* stopped = reply == nullptr ? nullptr : std::get_if<StopEverything::Reply>(reply);
        if (stopped == nullptr) return;
        self->note_stop_there(stopped->stop);
        if (!self->host_->everything_is_stopped()) return self->clear_stop_there();
        if (stopped->return_code != ReturnCode::ok && stopped->return_code != ReturnCode::unsupported) return;
        bool is_waiting = false;
        for (auto const& [ref, record] : self->records_) {
            if (record->may_act || !record->halt) continue;
            auto const& moving = stopped->not_halted;
            if (std::ranges::find(moving, ref) == moving.end())
                self->confirm_halt(record);
            else
                is_waiting = true;
        }
        if (is_waiting) self->host_->at(self->host_->now() + between_questions, [self] { self->ask_to_stop(); });
    });
    if (!stop_there_) note_stop_there(ClearStop::own);
}

void RemoteEngine::pause(std::shared_ptr<ComponentRecord> const& record, Ticket ticket, std::string const& command_type) {
    if (record->begins_asked > 0) {
        record->after_begins.emplace_back([=, self = shared_from_this()] { self->pause(record, ticket, command_type); });
        return;
    }
    command(record, command_type, {}, fresh_id(),
            [record, ticket, command_type](CompletedStatus status, std::string const& reason) {
                if (status == CompletedStatus::ok)
                    record->answer(ticket, Done{});
                else
                    record->answer(ticket, Failed{command_type + ": " + std::string{to_text(status)} + ": " + reason});
            });
}

// Runs a command. Calls `then` once, with the end.
void RemoteEngine::command(std::shared_ptr<ComponentRecord> const& record, std::string const& command_type,
                           ParameterList arguments, std::string const& id,
                           std::function<void(CompletedStatus, std::string const& reason)> const& then) {
    commands_.emplace(id, [then](Completed const& completed) { then(completed.status, completed.reason); });
    ask(Execute{{{unit_of(record->entry.ref, command_type, id, std::move(arguments))}}},
        [self = shared_from_this(), then, id](Reply const* reply) {
            if (reply != nullptr && outcome_of(*reply).return_code == ReturnCode::ok) return;
            if (self->commands_.erase(id) > 0)
                reply == nullptr ? then(CompletedStatus::abort, self->why_no_answer())
                                 : then(CompletedStatus::error, reason_of_only_command(outcome_of(*reply)));
        },
        {id});
}

void RemoteEngine::query(std::shared_ptr<ComponentRecord> const& record, Ticket ticket, std::string const& query_type) {
    if (!is_open_) return record->answer(ticket, std::vector<Results>{});
    Query asked{.query_type = query_type, .condition = {}};
    asked.condition.filter = is_component(record->entry.ref);
    ask(std::move(asked), [self = shared_from_this(), record, ticket](Reply const* reply) {
        auto rows = rows_of(reply);
        for (auto& row : rows) self->translation_.to_here(row);
        record->answer(ticket, std::move(rows));
    });
}

}  // namespace rois::remote
