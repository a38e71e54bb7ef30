// What the engine acknowledges only when it is stored, and how it continues after a restart (docs/journal.md).
#include <algorithm>
#include <utility>

#include "engine/core.hpp"
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
        if (begins_action(command->type) && command->component->halts != command->halts) return command->component.get();
    return nullptr;
}

}  // namespace

StoredEngine Engine::Core::stored_engine() const {
    return {.last_session = last_session_,
            .last_subscription = subscriptions_.last_id(),
            .last_command = executor_.last_id(),
            .last_handle = executor_.last_handle(),
            .next_event = events_.next(),
            .next_error = errors_.next(),
            .is_stopped = everything_is_stopped_,
            .last_stop = last_stop_,
            .stops_of_ended_sessions = stops_of_ended_sessions_,
            .sessions_there = sessions_there_};
}

void Engine::Core::when_stored(std::function<void()> then) {
    if (!recorder_.must_wait()) return then();
    recorder_.when_stored([then = std::move(then)](bool, Instant) { then(); });
}

void Engine::Core::flush() noexcept {
    if (recorder_.has_something_to_give()) recorder_.give(stored_engine());
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
    recorder_.when_stored(
        [asked, held = std::make_shared<Reply>(std::move(reply))](bool, Instant) { asked->answer(std::move(*held)); });
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
    recorder_.when_stored([this, asked, execution = std::move(execution), reply = std::move(reply)](bool stored, Instant when) {
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
    });
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
    stops_of_ended_sessions_ = engine.stops_of_ended_sessions;
    everything_is_stopped_ = engine.is_stopped;
    if (everything_is_stopped_) on_stop_(true);
    sessions_there_ = engine.sessions_there;
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
    return earlier;
}

void Engine::Core::session_opened_there(std::string const& provider, SessionId const& id) {
    sessions_there_[provider] = id.text;
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
    if (!stored.rights.empty() && rights == nullptr) return recorder_.withdrawn(stored.session);
    auto made = std::make_unique<Session>(MotionLease::Terms{stored.lease, stored.lease_http, stored.links_count}, now.steady);
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
    session.events.first = session.errors.first = 0;  // their details are gone: they have expired
    auto const commands = of(state.commands);
    std::ranges::stable_sort(commands, {}, [](StoredCommand const& each) { return each.end ? each.end->at : Utc::max(); });
    for (auto& command : commands) restore(session, std::move(command), now);
    for (auto const& binding : stored.bindings) restore(session, binding, now);
    for (auto const& subscription : of(state.subscriptions))
        if (!restore(subscription)) absent_subscriptions_.push_back(subscription);
    executor_.forget_old_results(session, now);
}

void Engine::Core::restore(Session& session, StoredCommand&& stored, Instant now) {
    bool const may_be_known = !stored.end && sessions_there_.contains(stored.provider);
    auto const end =
        std::move(stored.end)
            .value_or(StoredCommand::End{.status = CompletedStatus::abort, .reason = std::string{interrupted}, .at = now.utc});
    auto const ago = std::clamp(now.utc - end.at, Utc::duration{0}, Utc::duration{settings_.command_results});
    auto command = std::make_shared<Command>();
    command->id = std::move(stored.id);
    command->type = std::move(stored.type);
    command->ref = std::move(stored.ref);
    if (auto* component = registry_.find(command->ref)) command->component = component->shared_from_this();
    command->session = &session;
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
    command->ended_at = now.steady - ago;
    command->ended_utc = end.at;
    command->notified = end.notified;
    executor_.restore(session, command, now);
}

// A component of another engine must confirm the binding. If it is not here yet, the binding waits for it.
void Engine::Core::restore(Session& session, StoredBinding const& binding, Instant now) {
    auto* const component = registry_.find(binding.ref);
    if (component == nullptr) return session.absent.push_back(binding);
    auto const bind_now = [this, binding](RegisteredComponent& to, Session& of, Instant when) {
        bind(of,
             {.component = to.shared_from_this(),
              .as = {.session = of.number, .switching = binding.switching},
              .condition = binding.preference},
             when);
        to.restore_parameters(binding.parameters, when);
    };
    if (!component->confirms_binding()) return bind_now(*component, session, now);
    auto then = [this, bind_now, id = session.id, shared = component->shared_from_this()](std::optional<ComponentAnswer>& answer,
                                                                                          Instant when) {
        --shared->binds_asked;
        auto* const asker = find(id);
        bool const confirmed = answer && std::holds_alternative<Done>(*answer) && !shared->has_departed();
        if (asker != nullptr && confirmed) bind_now(*shared, *asker, when);
        if (asker != nullptr) recorder_.changed(*asker);
        notify_of_release(*shared, when);
    };
    auto const ticket = questions_.ask(*component, now.steady + settings_.question_deadline,
                                       "the component did not answer whether it can be bound", std::move(then));
    ++component->binds_asked;
    auto parameters = component->in_own_frame(binding.parameters).value_or(binding.parameters);
    component->hosted().bind(
        ticket, {.session = session.number, .switching = binding.switching, .parameters = std::move(parameters)}, now);
}

// Returns false if its condition names something that no component has yet.
bool Engine::Core::restore(StoredSubscription const& subscription) {
    auto const session = std::ranges::find(sessions_, subscription.session, [](auto const& each) { return each.second->number; });
    if (session == sessions_.end()) return true;
    auto const& asked = subscription.asked;
    auto filter = Filter::compile(asked.condition, vocabulary(&registry_.results(MessageKind::event, asked.event_type)));
    if (!std::holds_alternative<Filter>(filter)) return false;
    subscriptions_.restore(*session->second, subscription.id, asked, std::move(std::get<Filter>(filter)));
    return true;
}

// Restores what belongs to components that have come.
void Engine::Core::restore_absent(Instant now) {
    std::erase_if(absent_subscriptions_, [&](StoredSubscription const& each) { return restore(each); });
    for (auto const& [id, session] : sessions_)
        for (auto const& binding : std::exchange(session->absent, {})) restore(*session, binding, now);
}

}  // namespace rois
