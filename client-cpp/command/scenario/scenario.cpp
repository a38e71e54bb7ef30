// The command scenario: runs the state machine of a robot scenario.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <ranges>
#include <set>
#include <utility>

#include "command/context.hpp"
#include "command/input/arguments.hpp"
#include "command/input/input.hpp"
#include "command/output/terminal.hpp"
#include "command/scenario/scenario_file.hpp"
#include "command/scenario/variables.hpp"
#include "command/sequences.hpp"
#include "rois/condition.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"
#include "xml/profiles/document.hpp"

namespace rois::command {

namespace {

using Clock = std::chrono::steady_clock;

class Machine {
public:
    Machine(Context& context, RobotScenario scenario, Variables variables)
        : context_{context}, scenario_{std::move(scenario)}, variables_{std::move(variables)} {}

    void run() {
        bind();
        subscribe();
        context_.keep_recording();
        next_ = scenario_.start;
        while (next_ || !state_->is_end) {
            if (next_) {
                enter(*std::exchange(next_, {}));
            } else {
                wait_for_update();
            }
        }
        if (state_->failed) throw Trouble{Exit::error, ""};
    }

private:
    void bind() {
        for (auto const& component : scenario_.components) {
            auto ref = component.ref;
            if (ref.empty()) {
                ref = context_.ok(BindAny{QueryExpression{conditions::type == component.type}, component.switching})
                          .component_ref.code;
            } else {
                context_.ok(Bind{{ref, {}, {}, {}}, component.switching});
            }
            bound_.emplace(component.name, context_.component(ref));
        }
    }

    void subscribe() {
        std::set<std::string> types;
        for (auto const& [name, state] : scenario_.states)
            for (auto const& trigger : state.triggers)
                if (trigger.kind == Trigger::Kind::event) types.insert(trigger.event_type);
        for (auto const& type : types) subscriptions_.insert(context_.ok(Subscribe{type, {}, true}).subscribe_id);
    }

    void enter(std::string const& name) {
        state_ = &scenario_.states.at(name);
        pending_.clear();
        status_ = CompletedStatus::ok;
        std::vector<std::string> printed;
        variables_.take(state_->steps, nullptr, printed);
        print(printed);
        drop_old_news();
        entered_ = Clock::now();
        pending_ = execute(state_->commands);
        if (state_->query && fire(Trigger::Kind::answered, ask(*state_->query), "answered")) return;
        fire(Trigger::Kind::at_once, {}, "at once");
    }

    // Notifications from before a state was entered do not count as triggers in it.
    void drop_old_news() {
        while (auto const update = context_.session().next_update(Clock::now())) check(*update);
        check_interrupted();
    }

    std::vector<CommandId> execute(std::vector<ScenarioCommand> const& commands) {
        CommandUnitSequence sequence;
        std::vector<CommandId> ids;
        for (auto const& command : commands) {
            auto const& component = bound_.at(command.component);
            auto const id = ids.emplace_back(fresh_command_id());
            sequence.command_unit_list.push_back(
                {command.delay, CommandMessage{{component.ref, {}, {}, {}}, command.type, id, arguments(command, component)}});
        }
        if (!ids.empty()) context_.ok(Execute{std::move(sequence)});
        return ids;
    }

    ParameterList arguments(ScenarioCommand const& command, ComponentEntry const& component) const {
        std::vector<std::string> given;
        given.reserve(command.arguments.size());
        for (auto const& argument : command.arguments) given.push_back(argument.name + "=" + variables_.filled(argument.text));
        try {
            return read_arguments(*component.profile, command.type, given);
        } catch (Trouble const& trouble) {
            throw Trouble{trouble.exit(), command.place + ": " + trouble.what()};
        }
    }

    Results ask(ScenarioQuery const& query) {
        QueryExpression condition;
        if (!query.component.empty()) condition = conditions::component_ref == bound_.at(query.component).ref;
        return context_.ok(Query{query.type, std::move(condition)}).results;
    }

    void wait_for_update() {
        auto const due = next_timer();
        auto const update = context_.session().next_update(due);
        check_interrupted();
        if (update) {
            take(*update);
        } else if (due && Clock::now() >= *due) {
            fire_timers();
        } else {
            throw Trouble{Exit::no_answer, "the connection has closed"};
        }
    }

    void take(Update const& update) {
        check(update);
        auto const* const news = std::get_if<News>(&update);
        if (news == nullptr) return;
        if (auto const* const event = std::get_if<ReceiveEvent>(&news->notification)) take_event(*event);
        if (auto const* const completed = std::get_if<Completed>(&news->notification)) take_completed(*completed);
    }

    void take_event(ReceiveEvent const& event) {
        if (!subscriptions_.contains(event.subscribe_id)) return;  // of another program in this session
        auto const results = event.results ? *event.results : Results{};
        auto const is_meant = [&](Trigger const& trigger) {
            return trigger.kind == Trigger::Kind::event && trigger.event_type == event.event_type &&
                   (trigger.component.empty() || bound_.at(trigger.component).ref == event.component_ref.code);
        };
        fire_if(is_meant, &results, event.event_type + " " + values_of(results));
    }

    void take_completed(Completed const& completed) {
        auto const found = std::ranges::find(pending_, completed.command_id);
        if (found == pending_.end()) return;
        pending_.erase(found);
        if (status_ == CompletedStatus::ok) {
            status_ = completed.status;
            decisive_ = completed.command_id;
        }
        if (!pending_.empty()) return;
        auto const is_meant = [&](Trigger const& trigger) {
            return trigger.kind == Trigger::Kind::completed && (!trigger.status || *trigger.status == status_);
        };
        if (fire_if(is_meant, nullptr, "completed " + std::string{to_text(status_)}) || waits_for_more()) return;
        auto const reason = reason_of(context_, decisive_);
        auto const exit = status_ == CompletedStatus::ok ? Exit::error : exit_of(status_);
        throw Trouble{exit, state_->place + ": the commands of " + rois::quoted(state_->name) + " ended with " +
                                std::string{to_text(status_)} + ", and no trigger expects that" +
                                (reason.empty() ? "" : ": " + reason)};
    }

    bool waits_for_more() const {
        return std::ranges::any_of(state_->triggers, [](Trigger const& trigger) {
            return trigger.kind == Trigger::Kind::event || trigger.kind == Trigger::Kind::after;
        });
    }

    Clock::time_point due(Trigger const& trigger) const {
        auto const text = variables_.filled(trigger.seconds);
        auto const seconds = to_double(text);
        bool const possible = seconds && *seconds >= 0 && *seconds < 1e9;
        if (!possible) throw Trouble{Exit::usage, state_->place + ": " + rois::quoted(text) + " is not a number of seconds"};
        return entered_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{*seconds});
    }

    Until next_timer() const {
        Until next;
        for (auto const& trigger : state_->triggers) {
            if (trigger.kind != Trigger::Kind::after || fired_.contains(&trigger)) continue;
            auto const at = due(trigger);
            if (!next || at < *next) next = at;
        }
        return next;
    }

    // Tries each timer once in a state, even if its conditions do not hold.
    void fire_timers() {
        auto const now = Clock::now();
        for (auto const& trigger : state_->triggers) {
            if (trigger.kind != Trigger::Kind::after || fired_.contains(&trigger) || due(trigger) > now) continue;
            fired_.insert(&trigger);
            if (fire_if([&](Trigger const& one) { return &one == &trigger; }, nullptr,
                        "after " + variables_.filled(trigger.seconds) + " s"))
                return;
        }
    }

    bool fire(Trigger::Kind kind, Results const& results, std::string const& by) {
        return fire_if([&](Trigger const& trigger) { return trigger.kind == kind; }, &results, by);
    }

    // Leaves the state by the first trigger that `is_meant` accepts and whose steps hold.
    template <class IsMeant>
    bool fire_if(IsMeant const& is_meant, Results const* results, std::string const& by) {
        for (auto const& trigger : state_->triggers) {
            std::vector<std::string> printed;
            if (!is_meant(trigger) || !variables_.take(trigger.steps, results, printed)) continue;
            leave(trigger.to, by, printed);
            return true;
        }
        return false;
    }

    void leave(std::string const& to, std::string const& by, std::vector<std::string> const& printed) {
        auto const from = state_->name;
        print(printed);
        auto const ends = execute(state_->leaving);
        wait_for_all(ends);
        print_transition(from, to, by);
        fired_.clear();
        next_ = to;
    }

    void wait_for_all(std::vector<CommandId> ids) {
        while (!ids.empty()) {
            auto const update = context_.session().next_update();
            check_interrupted();
            if (!update) throw Trouble{Exit::no_answer, "the connection has closed"};
            check(*update);
            auto const* const news = std::get_if<News>(&*update);
            auto const* const completed = news == nullptr ? nullptr : std::get_if<Completed>(&news->notification);
            if (completed != nullptr) std::erase(ids, completed->command_id);
        }
    }

    // Throws Trouble if the session has ended. Reports errors.
    void check(Update const& update) {
        if (auto const* const gap = std::get_if<Gap>(&update); gap != nullptr && gap->why == Gap::Why::new_session)
            throw Trouble{Exit::no_answer, "the session has ended, and its commands with it"};
        if (auto const* const news = std::get_if<News>(&update);
            news != nullptr && std::holds_alternative<ReceiveError>(news->notification) && !context_.options().quiet)
            report_error(context_, *news);
    }

    void check_interrupted() {
        if (context_.session().interrupted()) throw Trouble{Exit::interrupted, ""};
    }

    static std::string values_of(Results const& results) {
        std::string text;
        for (auto const& parameter : results.parameters)
            if (parameter.name != "timestamp")
                text += (text.empty() ? "" : " ") + parameter.name + "=" + listed(parameter.values);
        return text;
    }

    void print(std::vector<std::string> const& printed) {
        for (auto const& line : printed) context_.printer().line(harmless(line), "print", Json{{"print", line}});
    }

    void print_transition(std::string const& from, std::string const& to, std::string const& by) {
        if (context_.options().quiet) return;
        auto& printer = context_.printer();
        auto const time = to_text(std::chrono::system_clock::now());
        bool const coloured = printer.coloured();
        printer.line(painted(time.substr(11, 12), Colour::quiet, coloured) + "  " + painted(from, Colour::name, coloured) +
                         " -> " + painted(to, Colour::name, coloured) + "  " + painted(by, Colour::quiet, coloured),
                     "transition", Json{{"time", time}, {"from", from}, {"to", to}, {"by", by}});
    }

    Context& context_;
    RobotScenario scenario_;
    Variables variables_;
    std::map<std::string, ComponentEntry> bound_;
    std::set<SubscribeId> subscriptions_;
    ScenarioState const* state_ = nullptr;
    Clock::time_point entered_;
    std::vector<CommandId> pending_;
    CompletedStatus status_ = CompletedStatus::ok;
    CommandId decisive_;  // the first command that failed
    std::set<Trigger const*> fired_;
    std::optional<std::string> next_;  // entered next
};

Variables variables_of(RobotScenario const& scenario, std::vector<std::string> const& given) {
    Variables variables{scenario.variables};
    for (auto const& text : given) {
        auto const sign = text.find('=');
        auto const name = text.substr(0, sign);
        if (sign == std::string::npos) throw Trouble{Exit::usage, rois::quoted(text) + " is not NAME=VALUE"};
        if (!variables.has(name))
            throw Trouble{Exit::usage, "the scenario has no variable " + rois::quoted(name) + "; there are " +
                                           listed(std::views::keys(scenario.variables))};
        variables.set(name, text.substr(sign + 1));
    }
    return variables;
}

RobotScenario read(Context& context) {
    auto const& file = context.options().file;
    auto text = text_of_file(file);
    try {
        return read_robot_scenario(context.schemas(), file == "-" ? "standard input" : file, std::move(text));
    } catch (xml::BadDocument const& bad) {
        throw Trouble{Exit::usage, bad.what()};
    }
}

}  // namespace

void scenario(Context& context) {
    auto read_scenario = read(context);
    auto variables = variables_of(read_scenario, context.options().words);
    if (context.options().check) {
        context.printer().line("scenario ok", "scenario", Json{{"scenario", "ok"}});
        return;
    }
    Machine{context, std::move(read_scenario), std::move(variables)}.run();
}

}  // namespace rois::command
