// Command interface (7.4.2, table 3): finding, binding and commanding components.
#include <algorithm>
#include <utility>

#include "engine/commands/sequence_check.hpp"
#include "engine/core.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// Names the holder by the number of its session, as the log and the metrics do. The session's id is a secret.
std::string held(RegisteredComponent const& component) {
    return "the component " + quoted(component.ref().code) + " is bound by another session, number " +
           std::to_string(component.bound_to->number);
}

std::string why_not_halted(RegisteredComponent const& component) {
    return "the component " + quoted(component.ref().code) +
           " has not confirmed that it stands still; it can be bound once it has";
}

std::string not_bound(std::string const& ref) { return "the component " + quoted(ref) + " is not bound by this session"; }

std::string why_not_free(RegisteredComponent const& component) {
    return component.bound_to == nullptr ? why_not_halted(component) : held(component);
}

// Also a binding that the session has already: `switching` may be another one, or a sub engine has lost the binding.
bool must_confirm(RegisteredComponent const& component, Session const& session) {
    if (!component.confirms_binding() || component.has_failed_to_halt()) return false;
    return component.is_free() || component.bound_to == &session;
}

std::string did_not_answer(RegisteredComponent const& component, std::chrono::milliseconds deadline) {
    return "the component " + quoted(component.ref().code) + " did not answer within " + in_seconds(deadline);
}

// Returns why the command cannot begin, or nullopt. Sets what the component has prepared.
std::optional<Objection> why_not_prepared(Preparation& command, std::optional<ComponentAnswer>& answer, Session const& session,
                                          std::chrono::milliseconds deadline) {
    auto const& component = *command.component;
    auto const objection = [&](ReturnCode code, std::string const& reason) {
        return Objection{code, command.path.empty() ? reason : command.path + ": " + reason};
    };
    if (!answer) return objection(ReturnCode::timeout, did_not_answer(component, deadline) + "; no command has begun");
    if (auto const* refused = std::get_if<Refused>(&*answer)) return objection(ReturnCode::bad_parameter, refused->reason);
    auto* begin = std::get_if<Begin>(&*answer);
    if (begin == nullptr) {
        auto const* failed = std::get_if<Failed>(&*answer);
        auto const why = failed == nullptr || failed->reason.empty() ? std::string{} : ": " + failed->reason;
        return objection(ReturnCode::error, "the component " + quoted(component.ref().code) + " failed" + why);
    }
    command.begin = std::move(*begin);
    if (component.bound_to != &session) return objection(ReturnCode::error, not_bound(component.ref().code));
    if (begins_action(command.command_type) && component.stops != command.stops)
        return objection(ReturnCode::error,
                         "the component " + quoted(component.ref().code) + " was stopped before the command could begin");
    return {};
}

// The results that the command may have. After a restart its component may be absent, or have another profile: then those that
// it has.
std::vector<ParameterProfile> results_of(Command const& command) {
    auto const* message =
        command.component ? find_message(command.component->profile(), MessageKind::command, command.type) : nullptr;
    if (message != nullptr) return message->results;
    std::vector<ParameterProfile> results;
    for (auto const& each : command.results.parameters)
        results.push_back({.name = each.name, .data_type_ref = each.data_type_ref, .default_value = {}, .description = {}});
    return results;
}

// Gives an id to each command that has none.
class IdFiller {
public:
    IdFiller(Executor& executor, Session const& session, std::set<CommandId> taken)
        : executor_{executor}, session_{session}, taken_{std::move(taken)} {}

    void fill(std::vector<CommandUnit>& units) {
        for (auto& unit : units) std::visit(*this, unit.unit);
    }

    void operator()(DelayOnly&) {}
    void operator()(CommandMessage& message) {
        if (message.command_id.text.empty()) message.command_id = executor_.fresh_id(session_, taken_);
    }
    void operator()(ConcurrentCommands& concurrent) {
        for (auto& branch : concurrent.branches) fill(branch.command_list);
    }
    void operator()(SequentialCommandUnit& sequential) { fill(sequential.command_unit_list); }
    void operator()(ParallelCommandUnit& parallel) { fill(parallel.command_unit_list); }

private:
    Executor& executor_;
    Session const& session_;
    std::set<CommandId> taken_;
};

}  // namespace

Reply Engine::Core::perform(Session& session, Search const& search, Instant) {
    auto selection = Selection::compile(search.condition, vocabulary(session));
    if (auto* problem = std::get_if<std::string>(&selection))
        return refused<Search::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    Search::Reply reply;
    for (auto const* component : select(std::get<Selection>(selection), session))
        reply.component_ref_list.push_back(component->ref());
    return reply;
}

Reply Engine::Core::bind(Session& session, ToBindNow const& wanted, Instant now) {
    auto& component = *wanted.component;
    if (registry_.find(component.ref().code) != &component)
        return refused<Bind::Reply>(ReturnCode::error, "the component " + quoted(component.ref().code) + " has left");
    bool const mine = component.bound_to == &session;
    switch (Registry::bind(component, session, now)) {
        case Registry::Bound::ok:
            component.switching = wanted.as.switching;
            component.preference = component.is_logical() ? wanted.condition : nullptr;
            recorder_.changed(session);
            forget_absent(session, component.ref().code);
            if (!mine) trace_->bound(session.number, component.ref().code);
            return Bind::Reply{};
        case Registry::Bound::not_halted:
            return refused<Bind::Reply>(ReturnCode::error, why_not_halted(component));
        case Registry::Bound::taken:
            break;
    }
    return refused<Bind::Reply>(ReturnCode::out_of_resources, held(component));
}

Engine::Core::Later Engine::Core::perform(Session& session, Bind const& bind_, SharedAsked const& asked, Instant now) {
    auto [component, problem] = registry_.meant(bind_.component_ref, session);
    if (component == nullptr) return refused<Bind::Reply>(ReturnCode::bad_parameter, std::move(problem));
    if (!may_command(session.rights.get(), component->ref().code)) {
        asked->refuse(Refusal::not_allowed);
        return {};
    }
    if (bind_.take_over)
        if (auto why_not = take_over(session, *component, now))
            return refused<Bind::Reply>(ReturnCode::error, *std::move(why_not));
    return bind_one(session, asked, {component->shared_from_this(), {.session = session.number, .switching = bind_.switching}},
                    now.steady + settings_.question_deadline, now);
}

// Releases the component for the session that has bound it, and notifies that session of the reason. Returns why that is not
// possible, or nullopt. The `bind` then waits until the component has confirmed its halt.
std::optional<std::string> Engine::Core::take_over(Session const& session, RegisteredComponent& component, Instant now) {
    auto* const previous = component.bound_to;
    if (previous == nullptr || previous == &session) return {};
    if (previous->owner != nullptr)
        return "the component " + quoted(component.ref().code) + " acts for the component " +
               quoted(previous->owner->ref().code) + ", which stands for it: take over that one";
    auto const by = session.rights ? quoted(session.rights->holder()) : "the session number " + std::to_string(session.number);
    auto const reason = "its component was taken over by " + by;
    Attempts attempts;
    attempts([&] { executor_.release(*previous, component, now, reason); });
    attempts([&] { trace_->taken_over(session.number, previous->number, component.ref().code); });
    attempts([&] { unbind(*previous, component, now); });
    attempts([&] {
        tell(*previous,
             {component.shared_from_this(), ErrorType::user_defined_error,
              "the component " + quoted(component.ref().code) + " was taken over by " + by},
             now);
    });
    attempts.rethrow();
    return {};
}

Engine::Core::Later Engine::Core::bind_one(Session& session, SharedAsked const& asked, ToBindNow const& wanted, Steady until,
                                           Instant now) {
    auto& component = *wanted.component;
    if (registry_.find(component.ref().code) != &component)
        return refused<Bind::Reply>(ReturnCode::bad_parameter, "the component " + quoted(component.ref().code) + " has left");
    if (component.is_being_halted()) {
        component.halting->over.emplace_back([this, asked, wanted, until](Instant when) {
            answer_later(asked, [&](Session& asker) { return bind_one(asker, asked, wanted, until, when); });
        });
        return {};
    }
    if (!must_confirm(component, session)) return bind(session, wanted, now);
    auto then = [this, asked, wanted](std::optional<ComponentAnswer>& answer, Instant when) {
        auto& bound = *wanted.component;
        auto const make = [&](Session& asker) -> Later {
            if (!answer)
                return refused<Bind::Reply>(ReturnCode::timeout,
                                            did_not_answer(bound, settings_.question_deadline) + "; it is not bound");
            if (auto* refusal = std::get_if<Refused>(&*answer))
                return refused<Bind::Reply>(ReturnCode::out_of_resources, std::move(refusal->reason));
            if (!std::holds_alternative<Done>(*answer) || bound.has_departed()) {
                auto const* failed = std::get_if<Failed>(&*answer);
                auto const why = failed != nullptr      ? failed->reason
                                 : bound.has_departed() ? "it has left"
                                                        : "it answered another question";
                return refused<Bind::Reply>(ReturnCode::error,
                                            "the component " + quoted(bound.ref().code) + " is not bound: " + why);
            }
            return bind(asker, wanted, when);
        };
        --bound.binds_asked;
        answer_later(asked, make);
        notify_of_release(bound, when);
    };
    auto const ticket = questions_.ask(component, until, "the component did not answer whether it can be bound", std::move(then));
    ++component.binds_asked;
    component.hosted().bind(ticket, wanted.as, now);
    return {};
}

// Decisions 4 and 6: binds the first free match in the order of preference. If none is free, returns a match that the session has
// bound already.
Engine::Core::Later Engine::Core::perform(Session& session, BindAny const& bind, SharedAsked const& asked, Instant now) {
    auto compiled = Selection::compile(bind.condition, vocabulary(session));
    if (auto* problem = std::get_if<std::string>(&compiled))
        return refused<BindAny::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    auto const& selection = std::get<Selection>(compiled);
    if (!may_ever_match(selection.filter(),
                        registry_.possible(selection.filter().demand(), commanded_by(session, selection.filter())), session))
        return refused<BindAny::Reply>(ReturnCode::unsupported, "no component of this engine can match the condition");
    if (auto problem = recorder_.why_no_commands(); !problem.empty())  // the condition is stored
        return refused<BindAny::Reply>(ReturnCode::out_of_resources, std::move(problem));
    auto const [matches, held_of_group] = select_to_bind(selection, session);
    std::vector<ToBindNow> candidates;
    auto const condition = std::make_shared<QueryExpression const>(bind.condition);
    auto const add = [&](RegisteredComponent& match) {
        candidates.push_back(
            {match.shared_from_this(),
             {.session = session.number, .switching = bind.switching, .order = members_in_order(match, selection, session)},
             selection.sorts() ? condition : nullptr});
    };
    for (auto* match : matches)
        if (match->is_free()) add(*match);
    for (auto* match : matches)
        if (match->bound_to == &session && !match->has_failed_to_halt()) add(*match);
    if (candidates.empty() && held_of_group != nullptr)
        return refused<BindAny::Reply>(ReturnCode::out_of_resources,
                                       "no robot can give all components of the group now; " + held(*held_of_group));
    if (candidates.empty())
        return refused<BindAny::Reply>(ReturnCode::out_of_resources,
                                       "no component that matches the condition is free now" +
                                           (matches.empty() ? "" : "; " + why_not_free(*matches.front())));
    return bind_first(session, asked, std::move(candidates), now.steady + settings_.question_deadline, now);
}

// Binds the first candidate that confirms it. Each may take half of the remaining time, the last one all of it.
Engine::Core::Later Engine::Core::bind_first(Session& session, SharedAsked const& asked, std::vector<ToBindNow> candidates,
                                             Steady until, Instant now) {
    auto const wanted = candidates.front();
    auto& candidate = *wanted.component;
    if (candidate.is_being_halted()) {
        candidate.halting->over.emplace_back([this, asked, candidates = std::move(candidates), until](Instant when) {
            answer_later(asked, [&](Session& asker) { return bind_first(asker, asked, candidates, until, when); });
        });
        return {};
    }
    candidates.erase(candidates.begin());
    bool const has_left = registry_.find(candidate.ref().code) != &candidate;
    if (has_left || !must_confirm(candidate, session)) {
        auto const bound = bind(session, wanted, now);
        auto const& outcome = std::get<Bind::Reply>(bound);
        if (outcome.return_code != ReturnCode::ok && !candidates.empty())
            return bind_first(session, asked, std::move(candidates), until, now);
        if (outcome.return_code != ReturnCode::ok) return refused<BindAny::Reply>(outcome.return_code, outcome.reason);
        BindAny::Reply reply;
        reply.component_ref = candidate.ref();
        return reply;
    }
    auto const due = candidates.empty() ? until : now.steady + (until - now.steady) / 2;
    auto then = [this, asked, wanted, candidates = std::move(candidates), until](std::optional<ComponentAnswer>& answer,
                                                                                 Instant when) {
        auto const& component = wanted.component;
        auto const make = [&](Session& asker) -> Later {
            if (answer && std::holds_alternative<Done>(*answer) && !component->has_departed()) {
                auto const bound = this->bind(asker, wanted, when);
                if (std::get<Bind::Reply>(bound).return_code == ReturnCode::ok) {
                    BindAny::Reply reply;
                    reply.component_ref = component->ref();
                    return reply;
                }
            }
            if (!candidates.empty()) return bind_first(asker, asked, candidates, until, when);
            if (!answer)
                return refused<BindAny::Reply>(ReturnCode::timeout,
                                               did_not_answer(*component, settings_.question_deadline) + "; nothing is bound");
            if (auto const* taken = std::get_if<Refused>(&*answer))
                return refused<BindAny::Reply>(ReturnCode::out_of_resources,
                                               "no component that matches the condition is free now; " + taken->reason);
            return refused<BindAny::Reply>(ReturnCode::error, "no component that matches the condition can be bound now");
        };
        --component->binds_asked;
        answer_later(asked, make);
        notify_of_release(*component, when);
    };
    auto const ticket = questions_.ask(candidate, due, "the component did not answer whether it can be bound", std::move(then));
    ++candidate.binds_asked;
    candidate.hosted().bind(ticket, wanted.as, now);
    return {};
}

bool Engine::Core::forget_absent(Session& session, std::string const& ref) {
    return std::erase_if(session.absent, [&](StoredBinding const& each) { return each.ref == ref; }) > 0;
}

Reply Engine::Core::perform(Session& session, Release const& release_, Instant now) {
    bool const was_absent = forget_absent(session, release_.component_ref.code);
    if (was_absent) recorder_.changed(session);
    auto [component, problem] = registry_.meant(release_.component_ref, session);
    if (component == nullptr && was_absent) return Release::Reply{};
    if (component == nullptr) return refused<Release::Reply>(ReturnCode::bad_parameter, std::move(problem));
    if (component->bound_to == &session) {
        executor_.release(session, *component, now);
        unbind(session, *component, now);
    }
    return Release::Reply{};
}

void Engine::Core::unbind(Session& session, RegisteredComponent& component, Instant now) {
    session.bound.erase(&component);
    component.bound_to = nullptr;
    component.switching = Switching::none;
    component.preference = nullptr;
    recorder_.changed(session);
    component.restore_defaults(now);
    notify_of_release(component, now);
    trace_->released(session.number, component.ref().code);
}

// Notifies a component that confirms its bindings that it has none.
void Engine::Core::notify_of_release(RegisteredComponent& component, Instant now) {
    bool const is_free = component.bound_to == nullptr && component.binds_asked == 0 && !component.has_departed();
    if (component.confirms_binding() && is_free) component.hosted().released(now);
}

Reply Engine::Core::perform(Session& session, GetParameter const& get, Instant) {
    auto [component, problem] = registry_.meant(get.component_ref, session);
    if (component == nullptr) return refused<GetParameter::Reply>(ReturnCode::bad_parameter, std::move(problem));
    if (component->bound_to != &session) return refused<GetParameter::Reply>(ReturnCode::error, not_bound(component->ref().code));
    GetParameter::Reply reply;
    auto parameters = component->all_parameters(&session);
    if (!parameters)
        return refused<GetParameter::Reply>(ReturnCode::error, "the component " + quoted(component->ref().code) + " failed");
    reply.parameters = std::move(*parameters);
    return reply;
}

// The members have moved since `bind_any` sorted them.
void Engine::Core::order_members(RegisteredComponent const& logical, Session const& session) {
    auto const compiled = Selection::compile(*logical.preference, vocabulary(session));
    if (!std::holds_alternative<Selection>(compiled)) return;
    auto order = members_in_order(logical, std::get<Selection>(compiled), session);
    logical.hosted().call([order = std::move(order)](Component& component) { component.members_ordered(order); });
}

// Asks the components of the commands whether they are possible (Component::prepare), all at once. `then` gets the prepared
// commands, and returns the reply.
template <class Op, class Then>
Engine::Core::Later Engine::Core::prepare(Session& session, SharedAsked const& asked, std::vector<Preparation> list, Then then,
                                          Instant now) {
    auto const questions = static_cast<std::size_t>(std::ranges::count_if(list, &Preparation::asks));
    if (questions == 0) return then(session, std::move(list), now);
    // This may fail: no question may be open then.
    for (auto const& each : list)
        if (each.asks() && each.component->preference) order_members(*each.component, session);
    auto const prepared = std::make_shared<std::vector<Preparation>>(std::move(list));
    auto const round = questions_.begin(
        now.steady + settings_.question_deadline, questions,
        [this, asked, prepared, then = std::move(then)](Questions::Answers& answers, Instant when) mutable {
            answer_later(asked, [&](Session& asker) -> Later {
                auto next = answers.begin();
                for (auto& each : *prepared)
                    if (auto objection =
                            each.asks() ? why_not_prepared(each, *next++, asker, settings_.question_deadline) : std::nullopt)
                        return refused<typename Op::Reply>(objection->return_code, std::move(objection->reason));
                return then(asker, std::move(*prepared), when);
            });
        });
    std::size_t place = 0;
    for (auto& each : *prepared) {
        if (!each.asks()) continue;
        auto& component = *each.component;
        auto const ticket =
            questions_.add(round, place++, component, "the component did not answer whether a command is possible");
        auto changed = component.in_own_frame(each.parameters);
        component.hosted().prepare(ticket, each.command_type, changed ? std::move(*changed) : each.parameters, now);
    }
    return {};
}

Engine::Core::Later Engine::Core::perform(Session& session, SetParameter const& set, SharedAsked const& asked, Instant now) {
    CommandMessage message{
        .component_ref = set.component_ref, .command_type = "set_parameter", .command_id = {}, .arguments = set.parameters};
    SequenceCheck check{session, registry_, frames_seen_by(session)};
    if (auto problem = check.objection(message))
        return refused<SetParameter::Reply>(problem->return_code, std::move(problem->reason));
    auto then = [this, asked, message = std::move(message), only_check = set.check_only](
                    Session& asker, std::vector<Preparation> prepared, Instant when) mutable -> Later {
        if (only_check) return SetParameter::Reply{};
        if (auto problem = recorder_.why_no_commands(); !problem.empty())
            return refused<SetParameter::Reply>(ReturnCode::out_of_resources, std::move(problem));
        message.command_id = executor_.fresh_id(asker, {});
        SetParameter::Reply reply;
        reply.command_id = message.command_id;
        return run_when_stored(asker, asked, {{{.delay_time = {}, .unit = message}}}, std::move(prepared), std::move(reply),
                               Runs::when_stored, when);
    };
    return prepare<SetParameter>(session, asked, std::move(check.preparations()), std::move(then), now);
}

Engine::Core::Later Engine::Core::perform(Session& session, Execute const& execute, SharedAsked const& asked, Instant now) {
    executor_.forget_old_results(session, now);
    SequenceCheck check{session, registry_, frames_seen_by(session)};
    if (auto problem = check.objection(execute.command_unit_list))
        return refused<Execute::Reply>(problem->return_code, std::move(problem->reason));
    bool const begins = check.begins_something(), lasts = begins || check.delays_something() || check.sets_something();
    if (auto problem = why_not_now(session, begins, lasts, check.commands()))
        return refused<Execute::Reply>(problem->return_code, std::move(problem->reason));
    auto then = [this, asked, begins, lasts, ids = check.ids()](Session& asker, std::vector<Preparation> prepared,
                                                                Instant when) -> Later {
        if (auto problem = why_not_now(asker, begins, lasts, prepared.size()))
            return refused<Execute::Reply>(problem->return_code, std::move(problem->reason));
        for (auto const& id : ids)
            if (asker.commands.contains(id))
                return refused<Execute::Reply>(ReturnCode::bad_parameter,
                                               "the command_id " + quoted(id.text) + " is in use in this session");
        auto const& operation = std::get<Execute>(asked->operation());
        Execute::Reply reply;
        reply.command_unit_list = operation.command_unit_list;
        if (operation.check_only) return reply;
        IdFiller{executor_, asker, ids}.fill(reply.command_unit_list.command_unit_list);
        auto const sequence = reply.command_unit_list;
        bool const at_once = !lasts && std::ranges::none_of(prepared, &Preparation::asks);  // it only stops or suspends
        return run_when_stored(asker, asked, sequence, std::move(prepared), std::move(reply),
                               at_once ? Runs::at_once : Runs::when_stored, when);
    };
    return prepare<Execute>(session, asked, std::move(check.preparations()), std::move(then), now);
}

// Returns why the session may not begin this many commands now, or nullopt.
std::optional<Objection> Engine::Core::why_not_now(Session const& session, bool begins, bool lasts, std::size_t commands) {
    if (everything_is_stopped_ && begins)
        return Objection{ReturnCode::error, "everything was stopped; nothing starts until it is cleared (POST /rois/clear)"};
    if (auto problem = lasts ? recorder_.why_no_commands() : std::string{}; !problem.empty())
        return Objection{ReturnCode::out_of_resources, std::move(problem)};
    // Each of these commands may add a `completed` to the session's queue (decisions 12, 23).
    constexpr std::size_t most_without_memory = 16;
    auto const most = settings_.max_waiting_notifications;
    if (memory_->full() && lasts && session.live_commands() + commands > most_without_memory)
        return Objection{ReturnCode::out_of_resources, memory_->refuse("there is no memory for more commands")};
    if (session.live_commands() + commands <= most) return {};
    ++refused_.commands;
    return Objection{ReturnCode::out_of_resources,
                     "a session may have at most " + std::to_string(most) + " commands that wait or run"};
}

// Decision 17.
Reply Engine::Core::perform(Session& session, GetCommandResult const& get, Instant now) {
    executor_.forget_old_results(session, now);
    auto const found = session.commands.find(get.command_id);
    if (found == session.commands.end())
        return refused<GetCommandResult::Reply>(
            ReturnCode::bad_parameter, "unknown command_id " + quoted(get.command_id.text) + ", or its results have expired");
    auto const& command = *found->second;
    auto const declared = results_of(command);
    // If the profile has a result of this name, it belongs to the component.
    bool const has_reason = !command.reason.empty() && find_parameter(declared, "reason") == nullptr;
    Results results;
    switch (command.state) {
        case Command::State::waiting:
            results.parameters.push_back(text("status", "WAITING"));
            break;
        case Command::State::running:
            results.parameters.push_back(text("status", "RUNNING"));
            break;
        case Command::State::ended:
            results = command.results;
            results.parameters.insert(results.parameters.begin(), text("status", std::string{to_text(command.status)}));
            if (has_reason) results.parameters.insert(results.parameters.begin() + 1, text("reason", command.reason));
            break;
    }
    Declarations known;
    for (auto const* name : {"status", "reason"})
        known.add({.name = name, .data_type_ref = {"string", {}, {}, {}}, .default_value = {}, .description = {}});
    known.add(declared);
    if (auto problem = choose(results, get.condition, known, get.command_id.text, session))
        return refused<GetCommandResult::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    GetCommandResult::Reply reply;
    reply.results = std::move(results);
    return reply;
}

}  // namespace rois
