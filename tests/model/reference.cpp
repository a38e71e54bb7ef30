#include "model/reference.hpp"

#include <algorithm>
#include <utility>

namespace rois::model {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

std::string Reference::take(Step const& step) {
    std::string answer = "happened";
    auto& session = sessions_[at(step.session)];
    bool const is_an_operation = step.kind < Kind::finish;
    if (is_an_operation && step.kind != Kind::connect && !session) return "no_session";
    switch (step.kind) {
        case Kind::connect:
            return connect(step.session);
        case Kind::disconnect:
            return disconnect(step.session);
        case Kind::bind:
            return bind(step.session, step.component);
        case Kind::release:
            answer = release(step.session, step.component);
            break;
        case Kind::get_parameter:
        case Kind::set_parameter:
            return parameters(step);
        case Kind::query_parameters:
            return parameters_by_query(step);
        case Kind::execute:
            answer = execute(step.session, step.plan);
            break;
        case Kind::get_command_result:
            return state_of(*session, step.name);
        case Kind::component_status: {
            if (step.component == nobody) return "UNSUPPORTED";
            auto const owner = components_[at(step.component)].bound_to;
            return owner != -1 && owner != step.session ? "BUSY" : "READY";
        }
        case Kind::subscribe:
            session->subscriptions = is(Flaw::subscribing_twice_notifies_twice) ? session->subscriptions + 1 : 1;
            return "OK";
        case Kind::unsubscribe:
            session->subscriptions = 0;
            return "OK";
        case Kind::finish:
            if (auto const start = components_[at(step.component)].start) end(start, step.number % 2 == 0 ? "OK" : "ERROR");
            break;
        case Kind::fire:
            for (int i = 0; i < session_count; ++i)
                for (int n = sessions_[at(i)] ? sessions_[at(i)]->subscriptions : 0; n > 0; --n)
                    notify(i, "person_detected detection");
            break;
        case Kind::pass:
            pass(step.number);
            break;
    }
    settle();
    return answer;
}

std::optional<std::vector<std::string>> Reference::received(int session) {
    auto& one = sessions_[at(session)];
    if (!one) return {};
    return std::exchange(one->notifications, {});
}

std::string Reference::connect(int session) {
    if (!sessions_[at(session)]) sessions_[at(session)].emplace();
    return "OK";
}

// Ends the session's commands without notifications.
std::string Reference::disconnect(int session) {
    for (auto& component : components_) {
        if (component.bound_to != session) continue;
        component.start = nullptr;
        component.waiting.clear();
        component.is_active = component.is_suspended = false;
        end_binding(component);
    }
    std::erase_if(due_, [&](Due const& due) { return due.command->session == session; });
    sessions_[at(session)].reset();
    return "OK";
}

std::string Reference::bind(int session, int component) {
    if (component == nobody) return "BAD_PARAMETER";
    auto& owner = components_[at(component)].bound_to;
    if (owner != -1 && owner != session && !is(Flaw::binding_is_shared)) return "OUT_OF_RESOURCES";
    owner = session;
    return "OK";
}

std::string Reference::release(int session, int component) {
    if (component == nobody) return "BAD_PARAMETER";
    auto& released = components_[at(component)];
    if (released.bound_to != session) return "OK";
    for (auto const& [name, command] : sessions_[at(session)]->known)
        if (command->component == component && command->state == "WAITING") command->binding_lost = true;
    end_binding(released);
    if (!is(Flaw::release_lets_run_on)) halt(released, "ABORT");
    return "OK";
}

void Reference::end_binding(Component& component) const {
    component.bound_to = -1;
    if (!is(Flaw::values_outlive_the_binding)) component.value = component.default_value;
}

// Answers the query get_parameter.
std::string Reference::parameters_by_query(Step const& step) const {
    if (step.component == nobody || step.component == detection) return "UNSUPPORTED";
    auto const& component = components_[at(step.component)];
    bool const is_shown = component.bound_to == step.session || is(Flaw::anybody_reads_stored_values);
    return "OK " + (is_shown ? component.value : component.default_value);
}

std::string Reference::parameters(Step const& step) {
    if (step.component == nobody) return "BAD_PARAMETER";
    auto& component = components_[at(step.component)];
    if (component.bound_to != step.session) return "ERROR";
    if (step.kind == Kind::get_parameter) return "OK " + component.value;
    if (step.number < 0 && !is(Flaw::bad_values_are_stored)) return "BAD_PARAMETER";
    component.value = std::to_string(step.number);
    auto& session = *sessions_[at(step.session)];
    notify(step.session, "completed c OK");
    session.ended.push_back('-');
    forget_old(session);
    return "OK";
}

// Returns the first objection in document order.
std::string Reference::objection(int session, Plan const& plan) const {
    std::string names;
    auto const& known = sessions_[at(session)]->known;
    for (auto const& unit : plan)
        for (auto const& branch : unit)
            for (auto const& order : branch) {
                bool const is_taken = known.contains(order.name) || names.find(order.name) != names.npos;
                if (is_taken && !is(Flaw::a_name_may_come_again)) return "BAD_PARAMETER";
                names += order.name;
                if (order.component == nobody) return "BAD_PARAMETER";
                if (components_[at(order.component)].bound_to != session) return "ERROR";
                if (order.type == "dance") return "BAD_PARAMETER";
            }
    return "";
}

std::string Reference::execute(int session, Plan const& plan) {
    if (auto const refused = objection(session, plan); !refused.empty()) return refused;
    auto* const execution = executions_.emplace_back(std::make_unique<Execution>()).get();
    for (std::size_t u = 0; u < plan.size(); ++u) {
        auto& unit = execution->units.emplace_back();
        for (std::size_t b = 0; b < plan[u].size(); ++b) {
            auto& branch = unit.emplace_back();
            for (auto const& order : plan[u][b]) {
                branch.push_back(std::make_shared<Command>(Command{order.name, std::string{order.type}, order.component,
                                                                   order.delay, session, execution, u, b, branch.size()}));
                sessions_[at(session)]->known[order.name] = branch.back();
            }
        }
        if (is(Flaw::branches_run_in_sequence) && unit.size() == 2) {
            for (auto const& command : std::exchange(unit[1], {})) {
                command->branch = 0;
                command->place = unit[0].size();
                unit[0].push_back(command);
            }
            unit.pop_back();
        }
    }
    begin(*execution, 0);
    return "OK";
}

std::string Reference::state_of(Session const& session, char name) const {
    auto const found = session.known.find(name);
    return found == session.known.end() ? "BAD_PARAMETER" : found->second->state;
}

void Reference::begin(Execution& execution, std::size_t unit) {
    if (unit == execution.units.size()) return;
    execution.failed = false;
    execution.open_branches = execution.units[unit].size();
    for (auto const& branch : execution.units[unit]) give_turn(branch.front());
}

void Reference::give_turn(SharedCommand const& command) {
    if (command->delay == 0) {
        turns_.push_back(command);
    } else {
        due_.push_back({time_ + command->delay + (is(Flaw::a_delay_is_a_tick_longer) ? 1 : 0), command});
    }
}

void Reference::run(SharedCommand const& command) {
    if (command->state != "WAITING" || !sessions_[at(command->session)]) return;
    auto& component = components_[at(command->component)];
    if (command->binding_lost || component.bound_to != command->session) return end(command, "ABORT");
    command->state = "RUNNING";
    bool const is_busy = component.start || component.is_active;
    if (command->type == "start") return start(command);
    if (command->type == "stop") {
        halt(component, is(Flaw::stop_completes_start_with_ok) ? "OK" : "ABORT");
        component.waiting.push_back(command);
        return;
    }
    bool const suspends = command->type == "suspend";
    if (suspends ? !is_busy || component.is_suspended : !component.is_suspended) return end(command, "ERROR");
    reports_.push_back({suspends ? Report::Of::suspend : Report::Of::resume, command->component, component.halts, command});
}

void Reference::start(SharedCommand const& command) {
    auto& component = components_[at(command->component)];
    if (component.start || component.is_active) halt(component, "ABORT");
    if (component.unconfirmed_halt != 0) return component.waiting.push_back(command);
    component.start = command;
    if (command->component == detection) reports_.push_back({Report::Of::start, command->component, component.halts, command});
}

void Reference::halt(Component& component, std::string const& status_of_start) {
    component.is_active = component.is_suspended = false;
    ++component.halts;
    if (component.unconfirmed_halt == 0) component.unconfirmed_halt = component.halts;
    reports_.push_back({Report::Of::halt, static_cast<int>(&component - components_.data()), component.halts, nullptr});
    if (auto const running = std::exchange(component.start, nullptr)) end(running, status_of_start);
    for (auto const& command : component.waiting)
        if (command->type != "stop") abort(command);
}

void Reference::take(Report const& report) {
    auto& component = components_[at(report.component)];
    if (report.of == Report::Of::halt) {
        if (component.unconfirmed_halt == 0 || report.halt < component.unconfirmed_halt) return;
        component.unconfirmed_halt = 0;
        for (auto const& command : std::exchange(component.waiting, {})) {
            if (command->state != "RUNNING") continue;
            if (command->type == "stop")
                end(command, "OK");
            else
                start(command);
        }
        return;
    }
    if (report.command->state != "RUNNING") return;
    if (report.of == Report::Of::start) {
        bool const was_suspended = component.is_suspended;
        end(report.command, "OK");
        component.is_active = true;
        component.is_suspended = was_suspended;
        return;
    }
    if (component.halts == report.halt) component.is_suspended = report.of == Report::Of::suspend;
    end(report.command, "OK");
}

void Reference::abort(SharedCommand const& command) {
    if (!command->is_over()) end(command, "ABORT");
}

// Ends a command, notifies its session, and continues its sequence.
void Reference::end(SharedCommand const& command, std::string const& status) {
    auto& component = components_[at(command->component)];
    if (component.start == command) {
        component.start = nullptr;
        component.is_suspended = false;
    }
    command->state = status;
    auto& session = *sessions_[at(command->session)];
    notify(command->session, std::string{"completed "} + command->name + " " + status);
    session.ended.push_back(command->name);
    forget_old(session);

    auto* const execution = std::exchange(command->execution, nullptr);
    if (!execution) return;
    auto const& branch = execution->units[command->unit][command->branch];
    bool const goes_on = status == "OK" || is(Flaw::a_failure_ends_nothing);
    if (goes_on && command->place + 1 < branch.size()) return give_turn(branch[command->place + 1]);
    if (!goes_on) {
        execution->failed = true;
        for (std::size_t i = command->place + 1; i < branch.size(); ++i) branch[i]->execution = nullptr;
        for (std::size_t i = command->place + 1; i < branch.size(); ++i) abort(branch[i]);
    }
    if (--execution->open_branches > 0) return;
    if (!execution->failed) return begin(*execution, command->unit + 1);
    for (std::size_t u = command->unit + 1; u < execution->units.size(); ++u)
        for (auto const& others : execution->units[u])
            for (auto const& other : others) {
                other->execution = nullptr;
                abort(other);
            }
}

void Reference::settle() {
    while (!turns_.empty() || !reports_.empty()) {
        if (!turns_.empty()) {
            auto const command = turns_.front();
            turns_.pop_front();
            run(command);
            continue;
        }
        auto const report = reports_.front();
        reports_.pop_front();
        take(report);
    }
}

void Reference::pass(int ticks) {
    for (int i = 0; i < ticks; ++i) {
        ++time_;
        while (true) {
            auto const next = std::ranges::find_if(due_, [&](Due const& due) { return due.time <= time_; });
            if (next == due_.end()) break;
            auto const command = next->command;
            due_.erase(next);
            turns_.push_back(command);
            settle();
        }
    }
}

void Reference::notify(int session, std::string const& what) {
    auto& one = *sessions_[at(session)];
    one.notifications.push_back(std::to_string(++one.sequence) + " " + what);
}

void Reference::forget_old(Session& session) const {
    while (session.ended.size() > kept_results && !is(Flaw::results_are_kept_for_ever)) {
        session.known.erase(session.ended.front());
        session.ended.pop_front();
    }
}

}  // namespace rois::model
