// What the engine acknowledges only when it is stored, and how it continues after a restart (docs/journal.md).
#include <algorithm>
#include <utility>

#include "engine/commands/sequence_check.hpp"
#include "engine/core.hpp"
#include "types/asking.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr std::chrono::seconds longest_silence{10};  // of a sub engine that knows how commands have ended
constexpr std::string_view interrupted = "the gateway was restarted before the command ended";

Reply not_stored_reply(Operation const& operation) {
    std::string const reason = "the journal could not store the command, so it has not begun: try again later";
    if (std::holds_alternative<SetParameter>(operation))
        return refused<SetParameter::Reply>(ReturnCode::out_of_resources, reason);
    return refused<Execute::Reply>(ReturnCode::out_of_resources, reason);
}

// Returns the component that was stopped since the commands were checked; null: none.
RegisteredComponent const* stopped_since(Execution const& execution) {
    for (auto const& command : execution.commands())
        if (begins_action(command->type) && command->component->stops != command->stops) return command->component.get();
    return nullptr;
}

constexpr std::chrono::seconds between_tries{1};  // to bind a component again that could not answer

}  // namespace

StoredEngine Engine::Core::stored_engine() const {
    return {.last_session = last_session_,
            .last_subscription = subscriptions_.last_id(),
            .last_command = executor_.last_id(),
            .last_handle = executor_.last_handle(),
            .next_event = events_.next(),
            .next_error = errors_.next(),
            .is_stopped = everything_is_stopped_ && !halts_only_,
            .last_stop = last_stop_,
            .ended_owners = ended_owners_,
            .sessions_there = sessions_there_,
            .stops_there = stops_there_};
}

void Engine::Core::when_stored(std::function<void()> then) {
    if (!recorder_.must_wait()) return then();
    recorder_.when_stored([then = std::move(then)](bool, Instant) { then(); });
}

void Engine::Core::flush() noexcept {
    if (recorder_.has_something_to_give()) recorder_.give([this] { return stored_engine(); });
    notifier_.flush();
}

void Engine::Core::stored(Instant now) {
    Attempts attempts;
    recorder_.stored(now, attempts);
    attempts([&] { settle(now); });
    if (attempts.failure()) unsettled_ = attempts.failure();
}

void Engine::Core::not_stored(Instant now) {
    Attempts attempts;
    recorder_.not_stored(now, attempts);
    if (attempts.failure()) unsettled_ = attempts.failure();
}

void Engine::Core::answer_when_stored(SharedAsked const& asked, Reply&& reply) {
    if (!recorder_.must_wait()) return asked->answer(std::move(reply));
    recorder_.when_stored([this, asked, held = std::make_shared<Reply>(std::move(reply))](bool stored, Instant) {
        Attempts attempts;
        if (!stored) attempts([&] { look_again(*asked, *held); });
        asked->answer(std::move(*held));
    });
}

// A refusal that the id of the command is in use is wrong if the other command has not begun, because it could not be stored.
void Engine::Core::look_again(Asked const& asked, Reply& reply) const {
    auto const* const execute = std::get_if<Execute>(&asked.operation());
    auto const* const session = session_of(asked);
    if (execute == nullptr || session == nullptr || outcome_of(reply).return_code != ReturnCode::bad_parameter) return;
    SequenceCheck check{*session, registry_, frames_seen_by(*session)};
    if (!check.objection(execute->command_unit_list)) reply = not_stored_reply(asked.operation());
}

Engine::Core::Later Engine::Core::run_when_stored(Session& session, SharedAsked const& asked, CommandUnitSequence const& sequence,
                                                  std::vector<Preparation> prepared, Reply reply, Runs runs, Instant now) {
    auto execution = executor_.make(session, sequence, std::move(prepared));
    if (!recorder_.stores(session) || !recorder_.must_wait()) {
        executor_.begin(execution, now);
        return reply;
    }
    if (runs == Runs::at_once) {
        executor_.begin(execution, now);
        answer_when_stored(asked, std::move(reply));
        return {};
    }
    auto then = [this, asked, execution, reply = std::move(reply)](bool stored, Instant when) {
        if (session_of(*asked) == nullptr) executor_.take_back(nullptr, *execution);  // with on_session_end = continue
        answer_later(asked, [&](Session& asker) -> Later {
            auto const* const stopped = stopped_since(*execution);
            if (stored && stopped == nullptr) {
                executor_.begin(execution, when);
                return reply;
            }
            executor_.drop(asker, *execution);
            if (!stored) return not_stored_reply(asked->operation());
            return refused<Execute::Reply>(ReturnCode::error, "the component " + quoted(stopped->ref().code) +
                                                                  " was stopped before the command could begin");
        });
    };
    try {
        recorder_.when_stored(std::move(then));
    } catch (...) {
        executor_.take_back(&session, *execution);
        throw;
    }
    return {};
}

void Engine::Core::restore(StoredState state, RightsOf const& rights_of, Instant now) {
    auto const& engine = state.engine;
    last_session_ = engine.last_session;
    subscriptions_.continue_ids(engine.last_subscription);
    executor_.continue_ids(engine.last_command, engine.last_handle);
    events_.begin_with(engine.next_event);
    errors_.begin_with(engine.next_error);
    last_stop_ = engine.last_stop;
    ended_owners_ = engine.ended_owners;
    everything_is_stopped_ = engine.is_stopped;
    if (everything_is_stopped_) on_stop_(true);
    sessions_there_ = engine.sessions_there;
    stops_there_ = engine.stops_there;
    if (everything_is_stopped_)  // perhaps there, too
        for (auto const& [provider, id] : sessions_there_) stops_there_.try_emplace(provider, ClearStop::own);
    for (auto& session : std::exchange(state.sessions, {})) restore(std::move(session), state, rights_of, now);
    if (undecided_.empty()) return;
    deadlines_.add(now.steady + longest_silence, [this](Instant then) {
        for (auto const& [provider, id] : sessions_there_) ended_there(provider, {}, then);
    });
}

Engine::EarlierSession Engine::Core::earlier_session(std::string const& provider) const {
    auto const found = sessions_there_.find(provider);
    EarlierSession earlier{.id = {found == sessions_there_.end() ? std::string{} : found->second}};
    for (auto const& each : undecided_)
        if (each.provider == provider) earlier.commands.push_back(each.command->handle);
    if (auto const stop = stops_there_.find(provider); stop != stops_there_.end()) earlier.stop = stop->second;
    return earlier;
}

void Engine::Core::session_opened_there(std::string const& provider, SessionId const& id) {
    sessions_there_[provider] = id.text;
    recorder_.changed_engine();
}

void Engine::Core::stopped_there(std::string const& provider, std::optional<std::uint64_t> stop) {
    if (stop)
        stops_there_[provider] = *stop;
    else
        stops_there_.erase(provider);
    recorder_.changed_engine();
}

void Engine::Core::ended_there(std::string const& provider, std::vector<CommandEnded> ended, Instant now) {
    Attempts attempts;
    for (auto const& each : undecided_) {
        auto const& command = each.command;
        if (each.provider != provider || command->session == nullptr) continue;
        auto const known = std::ranges::find(ended, command->handle, &CommandEnded::command);
        CommandEnded told{.command = command->handle, .status = CompletedStatus::abort, .reason = std::string{interrupted}};
        if (known != ended.end()) told = std::move(*known);
        if (auto* component = registry_.find(command->ref)) command->component = component->shared_from_this();
        attempts([&] { executor_.ended_there(command, std::move(told), now); });
    }
    std::erase_if(undecided_, [&](Undecided const& each) { return each.provider == provider; });
    if (attempts.failure()) unsettled_ = attempts.failure();
}

void Engine::Core::restore(StoredSession&& stored, StoredState& state, RightsOf const& rights_of, Instant now) {
    auto rights = stored.rights.empty() ? nullptr : rights_of(stored.rights);
    if (!stored.rights.empty() && rights == nullptr) {
        // Nobody follows an owner whose rights are gone: its stop needs POST /rois/clear.
        if (everything_is_stopped_ && stored.owns_stop && stored.last_stop == last_stop_)
            ended_owners_.push_back("withdrawn " + stored.rights);
        trace_->session_ended(stored.session, "its token is not valid any more");
        return recorder_.withdrawn(stored.session);
    }
    auto made = std::make_unique<Session>(MotionLease::Terms{stored.lease, stored.lease_http, stored.links_count}, now.steady);
    made->has_been_stored = true;
    made->id = stored.id;
    made->number = stored.session;
    made->rights = std::move(rights);
    made->window = stored.window;
    made->is_engine = stored.is_engine;
    made->receives_switches = stored.receives_switches;
    made->last_stop = stored.last_stop;
    made->owns_stop = stored.owns_stop;
    made->notifications =
        std::make_shared<NotificationQueue>(made->id, settings_.max_waiting_notifications, settings_.max_sent_notifications);
    auto const of = [&](auto& all) {
        return std::ranges::equal_range(all, stored.session, {}, [](auto const& each) { return each.session; });
    };
    std::vector<Numbered> notifications;
    for (auto& each : of(state.notifications)) notifications.push_back(std::move(each.numbered));
    made->notifications->restore(std::move(notifications));
    auto& session = enter(std::move(made));
    trace_->session_restored(session.number, session.rights.get());
    session.events.first = session.errors.first = 0;  // their details are gone: they have expired
    auto const commands = of(state.commands);
    std::ranges::stable_sort(commands, {}, [](StoredCommand const& each) { return each.end ? each.end->at : Utc::max(); });
    for (auto& command : commands) restore(session, std::move(command), now);
    session.absent = std::move(stored.bindings);
    bind_absent(session, now);
    for (auto const& each : of(state.subscriptions))
        if (!restore(session, each.id, each.asked)) session.absent_subscriptions.emplace(each.id.text, each.asked);
    executor_.forget_old_results(session, now);
}

void Engine::Core::restore(Session& session, StoredCommand&& stored, Instant now) {
    bool const may_be_known = !stored.end && sessions_there_.contains(stored.provider);
    auto const end =
        std::move(stored.end)
            .value_or(StoredCommand::End{.status = CompletedStatus::abort, .reason = std::string{interrupted}, .at = now.utc});
    auto command = std::make_shared<Command>();
    command->has_been_stored = true;
    command->id = std::move(stored.id);
    command->type = std::move(stored.type);
    command->ref = std::move(stored.ref);
    if (auto* component = registry_.find(command->ref)) command->component = component->shared_from_this();
    command->session = &session;
    command->session_number = session.number;
    if (may_be_known) {
        command->handle = CommandHandle{stored.handle};
        command->state = Command::State::running;
        session.commands.emplace(command->id, command);
        return undecided_.push_back({std::move(stored.provider), std::move(command)});
    }
    command->state = Command::State::ended;
    command->status = end.status;
    command->reason = end.reason;
    command->results = end.results;
    command->ended_at = now.steady;  // only the calendar knows how long ago, and it may have jumped: the id stays in use
    command->ended_utc = end.at;
    command->notified = end.notified;
    executor_.restore(session, command, now);
}

// Binds the components that have come. A component of another engine must confirm that first. If it is not here yet, or cannot
// answer, its binding waits: it ends only if the component is bound now, or the other engine refuses it.
void Engine::Core::bind_absent(Session& session, Instant now) {
    auto const waiting = session.absent;  // a copy, because binding changes the list
    for (auto const& binding : waiting) {
        auto* const component = registry_.find(binding.ref);
        if (component == nullptr || binding.is_asked) continue;
        if (component->bound_to == nullptr && component->confirms_binding())
            ask_to_bind(session, *component, binding, now);
        else
            bind_again(session, *component, binding, now);
    }
}

void Engine::Core::ask_to_bind(Session& session, RegisteredComponent& component, StoredBinding const& binding, Instant now) {
    auto then = [this, binding, id = session.id, shared = component.shared_from_this()](std::optional<ComponentAnswer>& answer,
                                                                                        Instant when) {
        --shared->binds_asked;
        if (auto* const asker = find(id)) take_answer(*asker, *shared, binding, answer, when);
        notify_of_release(*shared, when);
    };
    auto const ticket = questions_.ask(component, now.steady + settings_.question_deadline,
                                       "the component did not answer whether it can be bound", std::move(then));
    std::ranges::find(session.absent, binding.ref, &StoredBinding::ref)->is_asked = true;
    ++component.binds_asked;
    auto parameters = component.in_own_frame(binding.parameters).value_or(binding.parameters);
    component.hosted().bind(
        ticket, {.session = session.number, .switching = binding.switching, .parameters = std::move(parameters)}, now);
}

// A logical component refuses while none of its members can act: that may change soon.
void Engine::Core::take_answer(Session& session, RegisteredComponent& component, StoredBinding const& binding,
                               std::optional<ComponentAnswer> const& answer, Instant now) {
    auto const waiting = std::ranges::find(session.absent, binding.ref, &StoredBinding::ref);
    if (waiting == session.absent.end()) return;  // released, or bound again
    waiting->is_asked = false;
    bool const confirmed = answer && std::holds_alternative<Done>(*answer) && !component.has_departed();
    auto const* const refused = answer && !component.is_logical() ? std::get_if<Refused>(&*answer) : nullptr;
    if (confirmed) return bind_again(session, component, binding, now);
    if (refused == nullptr) return ask_absent_again(now);
    lose_absent(session, component, refused->reason, now);
}

void Engine::Core::lose_absent(Session& session, RegisteredComponent& component, std::string const& why, Instant now) {
    forget_absent(session, component.ref().code);
    recorder_.changed(session);
    trace_->released(session.number, component.ref().code);
    tell(session,
         {component.shared_from_this(), ErrorType::user_defined_error,
          "the binding of the component " + quoted(component.ref().code) + " has ended: " + why},
         now);
}

void Engine::Core::bind_again(Session& session, RegisteredComponent& component, StoredBinding const& binding, Instant now) {
    auto const reply = bind(session,
                            {.component = component.shared_from_this(),
                             .as = {.session = session.number, .switching = binding.switching},
                             .condition = binding.preference},
                            now);
    if (outcome_of(reply).return_code == ReturnCode::ok) return component.restore_parameters(binding.parameters, now);
    if (component.bound_to == nullptr) return ask_absent_again(now);  // it has not confirmed its halt yet
    lose_absent(session, component, outcome_of(reply).reason, now);
}

void Engine::Core::ask_absent_again(Instant now) {
    if (asks_absent_again_) return;
    deadlines_.add(now.steady + between_tries, [this](Instant then) {
        asks_absent_again_ = false;
        restore_absent(then);
    });
    asks_absent_again_ = true;
}

// Returns false if its condition names something that no component has yet.
bool Engine::Core::restore(Session& session, SubscribeId const& id, Subscribe const& asked) {
    auto filter = Filter::compile(asked.condition, vocabulary(session, MessageKind::event, asked.event_type));
    if (!std::holds_alternative<Filter>(filter)) return false;
    subscriptions_.restore(session, id, asked, std::move(std::get<Filter>(filter)));
    return true;
}

// Restores what belongs to components that have come.
void Engine::Core::restore_absent(Instant now) {
    for (auto const& [id, session] : sessions_) {
        std::erase_if(session->absent_subscriptions,
                      [&](auto const& each) { return restore(*session, {each.first}, each.second); });
        bind_absent(*session, now);
    }
}

}  // namespace rois
