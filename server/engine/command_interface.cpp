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
    auto selection = Selection::compile(search.condition, vocabulary());
    if (auto* problem = std::get_if<std::string>(&selection))
        return refused<Search::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    Search::Reply reply;
    for (auto const* component : select(std::get<Selection>(selection), session))
        reply.component_ref_list.push_back(component->ref());
    return reply;
}

Reply Engine::Core::perform(Session& session, Bind const& bind, Instant now) {
    auto [component, problem] = registry_.meant(bind.component_ref);
    if (component == nullptr) return refused<Bind::Reply>(ReturnCode::bad_parameter, std::move(problem));
    bool const mine = component->bound_to == &session;
    switch (Registry::bind(*component, session, now)) {
        case Registry::Bound::ok:
            if (!mine) journal_->bound(session.number, component->ref().code);
            return Bind::Reply{};
        case Registry::Bound::not_halted:
            return refused<Bind::Reply>(ReturnCode::error, why_not_halted(*component));
        case Registry::Bound::taken:
            break;
    }
    return refused<Bind::Reply>(ReturnCode::out_of_resources, held(*component));
}

// Decisions 4 and 6: binds the first free match in the order of preference. If none is free, returns a match that the session has
// bound already.
Reply Engine::Core::perform(Session& session, BindAny const& bind, Instant now) {
    auto compiled = Selection::compile(bind.condition, vocabulary());
    if (auto* problem = std::get_if<std::string>(&compiled))
        return refused<BindAny::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    auto const& selection = std::get<Selection>(compiled);
    if (!may_ever_match(selection.filter(), registry_.possible(selection.filter().demand()), session))
        return refused<BindAny::Reply>(ReturnCode::unsupported, "no component of this engine can match the condition");
    auto const [matches, held_of_group] = select_to_bind(selection, session);
    auto found = std::ranges::find_if(matches, &RegisteredComponent::is_free);
    if (found == matches.end())
        found = std::ranges::find_if(
            matches, [&](auto const* match) { return match->bound_to == &session && !match->has_failed_to_halt(); });
    if (found == matches.end() && held_of_group != nullptr)
        return refused<BindAny::Reply>(ReturnCode::out_of_resources,
                                       "no robot can give all components of the group now; " + held(*held_of_group));
    if (found == matches.end())
        return refused<BindAny::Reply>(ReturnCode::out_of_resources,
                                       "no component that matches the condition is free now" +
                                           (matches.empty() ? "" : "; " + why_not_free(*matches.front())));
    if ((*found)->bound_to == nullptr) journal_->bound(session.number, (*found)->ref().code);
    Registry::bind(**found, session, now);
    BindAny::Reply reply;
    reply.component_ref = (*found)->ref();
    return reply;
}

Reply Engine::Core::perform(Session& session, Release const& release_, Instant now) {
    auto [component, problem] = registry_.meant(release_.component_ref);
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
    component.restore_defaults(now);
    journal_->released(session.number, component.ref().code);
}

Reply Engine::Core::perform(Session& session, GetParameter const& get, Instant) {
    auto [component, problem] = registry_.meant(get.component_ref);
    if (component == nullptr) return refused<GetParameter::Reply>(ReturnCode::bad_parameter, std::move(problem));
    if (component->bound_to != &session) return refused<GetParameter::Reply>(ReturnCode::error, not_bound(component->ref().code));
    GetParameter::Reply reply;
    auto parameters = component->all_parameters(&session);
    if (!parameters)
        return refused<GetParameter::Reply>(ReturnCode::error, "the component " + quoted(component->ref().code) + " failed");
    reply.parameters = std::move(*parameters);
    return reply;
}

Reply Engine::Core::perform(Session& session, SetParameter const& set, Instant now) {
    CommandMessage message{
        .component_ref = set.component_ref, .command_type = "set_parameter", .command_id = {}, .arguments = set.parameters};
    if (auto problem = SequenceCheck{session, registry_}.objection(message))
        return refused<SetParameter::Reply>(problem->return_code, std::move(problem->reason));
    message.command_id = executor_.fresh_id(session, {});
    SetParameter::Reply reply;
    reply.command_id = message.command_id;
    executor_.run_alone(session, message, now);
    return reply;
}

Reply Engine::Core::perform(Session& session, Execute const& execute, Instant now) {
    executor_.forget_old_results(session, now);
    SequenceCheck check{session, registry_};
    if (auto problem = check.objection(execute.command_unit_list))
        return refused<Execute::Reply>(problem->return_code, std::move(problem->reason));
    if (everything_is_stopped_ && check.begins_something())
        return refused<Execute::Reply>(ReturnCode::error,
                                       "everything was stopped; nothing starts until it is cleared (POST /rois/clear)");
    // Each of these commands may add a `completed` to the session's queue (decisions 12, 23).
    constexpr std::size_t most_without_memory = 16;
    auto const most = settings_.max_waiting_notifications;
    bool const lasts = check.begins_something() || check.delays_something();
    if (memory_->full() && lasts && session.live_commands() + check.commands() > most_without_memory)
        return refused<Execute::Reply>(ReturnCode::out_of_resources, memory_->refuse("there is no memory for more commands"));
    if (session.live_commands() + check.commands() > most) {
        ++refused_.commands;
        return refused<Execute::Reply>(ReturnCode::out_of_resources,
                                       "a session may have at most " + std::to_string(most) + " commands that wait or run");
    }
    Execute::Reply reply;
    reply.command_unit_list = execute.command_unit_list;
    IdFiller{executor_, session, check.ids()}.fill(reply.command_unit_list.command_unit_list);
    executor_.execute(session, reply.command_unit_list, now);
    return reply;
}

// Decision 17.
Reply Engine::Core::perform(Session& session, GetCommandResult const& get, Instant now) {
    executor_.forget_old_results(session, now);
    auto const found = session.commands.find(get.command_id);
    if (found == session.commands.end())
        return refused<GetCommandResult::Reply>(
            ReturnCode::bad_parameter, "unknown command_id " + quoted(get.command_id.text) + ", or its results have expired");
    auto const& command = *found->second;
    auto const* message = find_message(command.component->profile(), MessageKind::command, command.type);
    // If the profile has a result of this name, it belongs to the component.
    bool const has_reason = !command.reason.empty() && find_parameter(message->results, "reason") == nullptr;
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
    known.add(message->results);
    if (auto problem = choose(results, get.condition, known, get.command_id.text))
        return refused<GetCommandResult::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    GetCommandResult::Reply reply;
    reply.results = std::move(results);
    return reply;
}

}  // namespace rois
