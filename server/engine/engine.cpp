#include "engine/engine.hpp"

#include <algorithm>
#include <concepts>
#include <utility>

#include "engine/core.hpp"
#include "types/asking.hpp"
#include "types/identifier_length.hpp"
#include "types/text/texts.hpp"

namespace rois {

Engine::Core::Core(EngineProfile profile, std::vector<ComponentProfile> known_profiles, EngineSettings const& settings,
                   Outbox& outbox, FreshSecret fresh_secret)
    : settings_{settings},
      fresh_secret_{std::move(fresh_secret)},
      belongings_{{"", {std::move(known_profiles), {}, {}}}},
      profile_{std::move(profile)},
      recorder_{outbox, sessions_},
      notifier_{recorder_},
      effort_{settings_.max_condition_steps},
      delivery_effort_{settings_.max_condition_steps},
      executor_{settings_, registry_, agenda_, deadlines_, notifier_, questions_, trace_, recorder_},
      events_{"e-", settings_.event_details},
      kept_events_{settings_.max_kept_events},
      errors_{"x-", settings_.error_details} {}

// A call that blocks may outlast the engine: its thread then ends alone.
Engine::Core::~Core() {
    for (auto const& [ref, component] : registry_.all()) {
        component->hosted().provider().close();
        component->halting.reset();  // an operation that waits for it holds the component
    }
    for (auto const& device : devices_) device->provider->close();
    for (auto const& [name, provider] : providers_)  // also those whose components have left
        if (auto const known = provider.lock()) known->close();
}

namespace {

// A tick asks for pings for this long, so that they continue if the next tick is late.
constexpr std::chrono::milliseconds signs_of_life_wanted{1'000};

// Whether the answer tells something that must still be true after a restart. `execute` and `set_parameter` have waited for the
// journal before they ran, but a refusal may be about a command that is being stored ("the command_id is in use"). `disconnect`
// needs no promise: without its application, the session ends anyway.
bool is_lasting(Operation const& operation, ReturnCode return_code) {
    if (return_code != ReturnCode::ok) return std::holds_alternative<Execute>(operation);
    return std::visit(
        []<class Known>(Known const&) {
            return std::same_as<Known, Connect> || std::same_as<Known, Bind> || std::same_as<Known, BindAny> ||
                   std::same_as<Known, Release> || std::same_as<Known, Subscribe> || std::same_as<Known, Unsubscribe> ||
                   std::same_as<Known, GetCommandResult> || std::same_as<Known, StopEverything> || std::same_as<Known, ClearStop>;
        },
        operation);
}

}  // namespace

void Engine::Core::handle(std::shared_ptr<Asked> const& asked, Instant now) {
    take(asked, now);
    Attempts attempts;
    if (!attempts([&] { settle(now); })) unsettled_ = attempts.failure();
}

// Refuses the operation, if there is a reason, before it changes anything.
void Engine::Core::take(std::shared_ptr<Asked> const& asked, Instant now) {
    auto const& operation = asked->operation();
    if (shutting_down_) return asked->refuse(Refusal::shutting_down);
    if (auto const* connection = std::get_if<Connect>(&operation)) return connect(asked, *connection, now);
    auto const* resumed = std::get_if<Resume>(&operation);
    auto* session = resumed != nullptr ? find(resumed->session) : session_of(*asked);
    if (session == nullptr || session->rights != asked->rights) return asked->refuse(Refusal::no_session);
    session->lease.request_received(now.steady);
    auto const too_long = why_too_long(operation);
    auto const turn = turn_of(*session, now);
    auto reply = std::visit(
        [&]<class Known>(Known const& known) -> Later {
            if (too_long) return refused<typename Known::Reply>(ReturnCode::bad_parameter, *too_long);
            try {
                if constexpr (requires { perform(*session, known, asked, now); })
                    return perform(*session, known, asked, now);
                else
                    return perform(*session, known, now);
            } catch (TooMuchEffort const&) {
                return too_much_effort<typename Known::Reply>();
            }
        },
        operation);
    if (reply) answer(asked, *session, std::move(*reply));
}

std::string_view Engine::Core::component_named_by(Operation const& operation, Session const& session) const {
    auto const* named = std::visit(
        []<class Known>(Known const& known) -> Identifier const* {
            if constexpr (requires { known.component_ref; }) return &known.component_ref;
            if constexpr (std::same_as<Known, Execute>) {
                auto const& units = known.command_unit_list.command_unit_list;
                auto const* only = units.size() == 1 ? std::get_if<CommandMessage>(&units.front().unit) : nullptr;
                if (only != nullptr) return &only->component_ref;
            }
            return nullptr;
        },
        operation);
    bool const is_known = named != nullptr && registry_.meant(*named, session).component != nullptr;
    return is_known ? std::string_view{named->code} : std::string_view{};
}

void Engine::Core::answer(SharedAsked const& asked, Session const& session, Reply&& reply) {
    auto const& outcome = outcome_of(reply);
    if (outcome.return_code != ReturnCode::ok) {
        Attempts attempts;
        attempts([&] {
            trace_->refused(session.number, asked->operation(), outcome, component_named_by(asked->operation(), session));
        });
    }
    if (is_lasting(asked->operation(), outcome.return_code))
        answer_when_stored(asked, std::move(reply));
    else
        asked->answer(std::move(reply));
}

void Engine::Core::answer_later(SharedAsked const& asked, std::function<Later(Session&)> const& make) {
    auto* session = session_of(*asked);
    if (session == nullptr) return asked->refuse(Refusal::no_session);
    auto const& queue = asked->notifications;
    auto const before = queue->current();
    queue->enter(asked->hold);
    try {
        if (auto reply = make(*session)) answer(asked, *session, std::move(*reply));
    } catch (...) {
        queue->enter(before);
        asked->refuse(Refusal::no_memory);
        throw;
    }
    queue->enter(before);
}

void Engine::Core::begin(Instant now) {
    executor_.stop_all("the gateway starts", now);
    tick(now);
}

// If a part of the tick fails, the others still run. Throws the first failure at the end; a later tick repeats the failed part.
void Engine::Core::tick(Instant now) {
    Attempts attempts;
    if (unsettled_) attempts.note(std::exchange(unsettled_, nullptr));
    attempts([&] { hold_unproven_motion(now); });
    attempts([&] { report_stop_of_everything(now); });
    attempts([&] { report_profile_change(now); });
    attempts([&] { serve_engines(now); });
    if (memory_->full()) attempts([&] { save_memory(now); });
    turns_ = 0;
    attempts([&] { advance_devices(now); });
    attempts([&] { questions_.expire(now); });
    recorder_.look(now, attempts);
    last_due_ = Deadlines::first();
    attempts([&] { executor_.repair(now, inbox_->take_lost_reports()); });
    end_marked_sessions(now, attempts);
    subscriptions_.forget_unused();
    attempts([&] { settle(now); });
    attempts([&] { forget_what_is_old(now); });
    attempts.rethrow();
}

void Engine::Core::forget_what_is_old(Instant now) {
    if (now.steady - details_checked_ < std::chrono::seconds{1}) return;
    details_checked_ = now.steady;
    events_.forget_expired(now);
    kept_events_.forget_expired(now.steady);
    errors_.forget_expired(now);
    executor_.forget_old_results(now);
}

// Decision 33. Asks the sessions that command moving components for signs of life, and holds the motion if they are missing. If
// the ticks paused for as long as a motion lease, no session was asked in that time: the engine then holds all motion.
void Engine::Core::hold_unproven_motion(Instant now) {
    auto const missed = now.steady - last_tick_.value_or(now.steady);
    Attempts attempts;
    for (auto* component : registry_.moving()) {
        auto const* session = component->bound_to;
        if (session != nullptr && session->owner != nullptr) continue;  // held with its logical component
        if (session == nullptr || (!component->works() && session->live_commands() == 0)) continue;
        session->notifications->want_signs_of_life(now.steady + signs_of_life_wanted);
        if (!component->works() || component->is_being_held) continue;
        attempts([&] {
            if (missed >= settings_.motion_lease)
                executor_.hold(*component, "the engine stood still for " + in_seconds(missed), now);
            else if (now.steady >= session->lease.end())
                executor_.hold(*component, "its application gave no sign of life within its motion lease", now);
        });
    }
    attempts.rethrow();  // before last_tick_ changes: the next tick then holds the components that could not be held
    last_tick_ = now.steady;
    settle(now);
}

void Engine::Core::mark_overflowed() {
    for (auto const& [id, session] : sessions_) {
        if (session->ending || !session->notifications->overflowed()) continue;
        session->ending = true;
        session->why_it_ends = "more notifications waited than max_waiting_notifications allows";
        sessions_must_end_ = true;
    }
}

Session* Engine::Core::find(SessionId const& id) const {
    auto const found = sessions_.find(id);
    return found == sessions_.end() || found->second->ending ? nullptr : found->second.get();
}

Session* Engine::Core::session_of(Asked const& asked) const {
    return asked.notifications ? find(asked.notifications->session()) : nullptr;
}

void Engine::Core::end(SessionId const& id, Instant now) {
    auto* session = find(id);
    if (session == nullptr) return;
    end(*session, "the gateway ended it", now);
    settle(now);
}

void Engine::Core::end_withdrawn(Instant now) {
    for (auto const& [id, session] : sessions_) {
        if (session->rights == nullptr || session->ending || !session->rights->is_withdrawn()) continue;
        session->ending = sessions_must_end_ = true;
        session->why_it_ends = "its token was revoked or changed, or has expired";
    }
    Attempts attempts;
    end_marked_sessions(now, attempts);
    attempts([&] { settle(now); });
    attempts.rethrow();
}

// From here on `find` does not return the session. If a step throws, the next tick continues.
void Engine::Core::end(Session& session, std::string_view why, Instant now) {
    session.ending = true;
    session.why_it_ends = why;
    try {
        remove(session, now);
    } catch (...) {
        sessions_must_end_ = true;
        throw;
    }
}

void Engine::Core::end_marked_sessions(Instant now, Attempts& attempts) {
    if (!std::exchange(sessions_must_end_, false)) return;
    for (auto next = sessions_.begin(); next != sessions_.end();) {
        auto& session = *(next++)->second;
        if (session.ending) attempts([&] { end(session, session.why_it_ends, now); });
    }
}

namespace {

// Also with OnSessionEnd::continue_: what moves, and streams, whose addresses only this session may have.
bool ends_with_its_session(RegisteredComponent const& component) {
    return component.moves() || arguments_of(component, "connect_stream") != nullptr;
}

}  // namespace

// Decision 3. With rights that were withdrawn, nothing goes on. Halts the components first, because they may move. Closes the
// notification queue last, so that it contains the ends of the commands.
void Engine::Core::remove(Session& session, Instant now) {
    Attempts attempts;
    bool const may_go_on = session.rights == nullptr || !session.rights->is_withdrawn();
    if (settings_.on_session_end == OnSessionEnd::continue_ && may_go_on) {
        for (auto* component : session.bound)
            if (ends_with_its_session(*component))
                attempts([&] { executor_.halt(*component, CompletedStatus::abort, "its session has ended", now); });
        attempts([&] { executor_.detach_commands(session); });
    } else {
        for (auto* component : session.bound)
            attempts([&] { executor_.halt(*component, CompletedStatus::abort, "its session has ended", now); });
        attempts([&] { executor_.abort_all(session, now); });
        while (!session.bound.empty()) attempts([&] { unbind(session, **session.bound.begin(), now); });
    }
    attempts.rethrow();
    for (auto* component : session.bound) {
        component->bound_to = nullptr;
        notify_of_release(*component, now);
        trace_->released(session.number, component->ref().code);
    }
    subscriptions_.remove_all(session);
    pass_on_unread(session, now);
    executor_.forget(session);
    notifier_.close(session);
    recorder_.ended(session);
    trace_->session_ended(session.number, session.why_it_ends);
    free_slots_.push_back(session.events.slot);  // cannot throw: `connect` reserved the room
    std::erase(engines_, &session);
    if (owns_present_stop(session))
        attempts([&] { ended_owners_.push_back(owner_of(session)); });  // else it needs POST /rois/clear
    if (session.owner != nullptr) session.owner->own_session = nullptr;
    sessions_.erase(sessions_.find(session.id));
}

void Engine::Core::stop_everything(Instant now) {
    Attempts attempts;
    attempts([&] { begin_stop_of_everything(now); });
    attempts([&] { settle(now); });
    attempts.rethrow();
}

// Does not settle: that may end the session that asks.
void Engine::Core::begin_stop_of_everything(Instant now) {
    everything_is_stopped_ = true;
    stop_unreported_ = true;
    ended_owners_.clear();
    ++last_stop_;
    recorder_.changed_stop(true);
    Attempts attempts;
    attempts([&] { on_stop_(true); });  // before the components are halted
    attempts([&] { executor_.stop_all("everything was stopped", now); });
    attempts([&] { last_stop_ = std::hash<std::string>{}(fresh_secret_()); });
    attempts([&] { report_stop_of_everything(now); });
    attempts.rethrow();
}

void Engine::Core::clear() {
    if (!std::exchange(everything_is_stopped_, false)) return;
    recorder_.changed_stop(false);
    on_stop_(false);
}

// Any client can stop everything, as often as it likes. Reporting each stop would fill the queues of the sessions.
void Engine::Core::report_stop_of_everything(Instant now) {
    if (!stop_unreported_ || !everything_is_stopped_) return;
    if (stop_reported_ && now.steady - *stop_reported_ < std::chrono::seconds{1}) return;
    agenda_.add(everything_was_stopped());
    stop_reported_ = now.steady;
    stop_unreported_ = false;
}

std::vector<std::string> Engine::Core::not_halted() const {
    std::vector<std::string> refs;
    for (auto const& [ref, component] : registry_.all())
        if (component->halting) refs.push_back(ref);
    return refs;
}

std::vector<std::string> Engine::Core::not_ready() const {
    std::vector<std::string> refs;
    for (auto const& [ref, component] : registry_.all()) {
        auto const& halting = component->halting;
        if (halting && (everything_is_stopped_ || halting->failed || !component->has_stood)) refs.push_back(ref);
    }
    return refs;
}

void Engine::Core::shut_down(Instant now) {
    shutting_down_ = true;
    settings_.on_session_end = OnSessionEnd::stop;
    Attempts attempts;
    attempts([&] { executor_.stop_all("the engine ends", now); });
    for (auto const& [id, session] : sessions_) {
        session->ending = sessions_must_end_ = true;
        session->why_it_ends = "the gateway is shutting down";
    }
    end_marked_sessions(now, attempts);
    attempts([&] { settle(now); });
    attempts.rethrow();
}

// Drops data that is only kept for later: results, details, sent notifications and waiting events. Keeps the newest ones, for an
// application that is slow for a moment. Then ends the sessions with too many waiting notifications. Runs at most every 100 ms.
void Engine::Core::save_memory(Instant now) {
    constexpr std::size_t kept = 64, most_waiting = 256;
    if (now.steady - memory_saved_ < std::chrono::milliseconds{100}) return;
    memory_saved_ = now.steady;
    events_.keep_last(kept);
    kept_events_.keep_last(kept);
    errors_.keep_last(kept);
    std::vector<SessionId> slow;
    for (auto const& [id, session] : sessions_) {
        executor_.keep_results(*session, kept);
        notifier_.keep_last(*session, kept);
        if (session->notifications->waiting() > most_waiting) slow.push_back(id);
    }
    for (auto const& id : slow)
        if (auto* session = find(id)) end(*session, "memory_budget is used up, and too many notifications waited for it", now);
    settle(now);
}

std::shared_ptr<NotificationQueue> Engine::Core::note_request(SessionId const& id, Instant now, Rights const* rights) {
    auto* session = find(id);
    if (session == nullptr || session->rights.get() != rights) return {};
    session->last_activity = now.steady;
    session->quiet_until = std::max(session->quiet_until, now.steady + settings_.session_timeout);
    return session->notifications;
}

void Engine::Core::note_pong(SessionId const& id, Instant now) {
    if (auto* session = find(id)) session->lease.pong_received(now.steady);
}

void Engine::Core::link_opened(SessionId const& id, LinkKind link, Instant now) {
    if (auto* session = find(id)) session->lease.opened(link, now.steady);
}

void Engine::Core::link_closed(SessionId const& id, LinkKind link, Closing closing, Instant now) {
    auto* session = find(id);
    if (session == nullptr) return;
    session->lease.closed(link, closing, now.steady);
    session->last_activity = now.steady;
    auto const grace = link == LinkKind::stream ? settings_.session_timeout : std::chrono::milliseconds{0};
    session->quiet_until = std::max(session->quiet_until, now.steady + grace);
    await_end_of_window(*session);
}

// Returns null if no session is idle. An idle session has no link, no binding, no subscription and no live command.
Session* Engine::Core::longest_idle() const {
    Session* longest = nullptr;
    for (auto const& [id, session] : sessions_) {
        bool const has_bound = !session->bound.empty() || !session->absent.empty();
        bool const has_subscribed = !session->subscriptions.empty() || !session->absent_subscriptions.empty();
        bool const idle = session->lease.links() == 0 && !has_bound && !has_subscribed && session->live_commands() == 0;
        auto const earlier = [](Session const& a, Session const& b) {
            return std::pair{a.last_activity, a.number} < std::pair{b.last_activity, b.number};
        };
        if (idle && (longest == nullptr || earlier(*session, *longest))) longest = session.get();
    }
    return longest;
}

// Each session has one deadline, however often its links open and close. Only the first call for a session allocates memory.
void Engine::Core::await_end_of_window(Session& session, Steady not_before) {
    auto const when = std::max(session.quiet_until + session.window, not_before);
    if (session.end_of_window && deadlines_.postpone(*session.end_of_window, when)) return;
    session.end_of_window = deadlines_.add(when, [this, id = session.id](Instant then) { end_if_lost(id, then); });
}

// Checks again later if the session sent something in between (decision 2). Keeps the deadline while a link is open: when the
// link ends, the deadline can be moved without allocating memory.
void Engine::Core::end_if_lost(SessionId const& id, Instant now) {
    auto* session = find(id);
    if (session == nullptr) return;
    bool const linked = session->lease.links() > 0;
    if (!linked && session->quiet_until + session->window <= now.steady)
        return end(*session, "its link was lost and it was not resumed within its window", now);
    constexpr std::chrono::minutes between_looks{1};
    await_end_of_window(*session, linked ? now.steady + between_looks : now.steady);
}

std::vector<ComponentEntry> Engine::Core::components(Rights const* rights) const {
    std::vector<ComponentEntry> entries;
    for (auto const& [ref, component] : registry_.all())
        if (may_see(rights, ref)) entries.push_back(component->entry());
    return entries;
}

EngineStatistics Engine::Core::statistics() const {
    EngineStatistics numbers;
    numbers.sessions = sessions_.size();
    numbers.sessions_replaced = sessions_replaced_;
    numbers.components = registry_.all().size();
    numbers.subscriptions = subscriptions_.size();
    std::ranges::copy(executor_.completed_by_status(), numbers.commands_completed);
    numbers.events = events_published_;
    numbers.notifications = notifier_.pushed();
    numbers.notifications_lost = notifier_.lost();
    numbers.errors = errors_published_;
    numbers.stray_answers = executor_.stray_answers();
    numbers.everything_is_stopped = everything_is_stopped_;
    numbers.not_halted = not_halted().size();
    for (auto const& [id, session] : sessions_) numbers.each_session.push_back(statistics(*session));
    std::ranges::sort(numbers.each_session, {}, &SessionStatistics::number);
    auto const waiting = settings_.max_waiting_notifications;
    numbers.limits = {{"sessions", settings_.max_sessions, refused_.sessions},
                      {"commands", waiting, refused_.commands},
                      {"subscribed_predicates", settings_.max_subscribed_predicates, refused_.predicates},
                      {"predicates", settings_.max_predicates, refused_.all_predicates},
                      {"condition_bytes", settings_.max_condition_bytes, refused_.condition_bytes},
                      {"condition_steps", settings_.max_condition_steps, effort_.refusals()},
                      {"waiting_notifications", waiting, notifier_.lost() + notifier_.overflows()}};
    if (memory_->total() == MemoryBudget::none().total()) return numbers;
    numbers.limits.push_back({"memory_budget", memory_->total(), memory_->refusals()});
    numbers.memory_budget = memory_->total();
    numbers.memory_used = memory_->used();
    return numbers;
}

SessionStatistics Engine::Core::statistics(Session const& session) {
    SessionStatistics numbers{.number = session.number,
                              .connected = session.connected,
                              .bound = {},
                              .commands = session.live_commands(),
                              .subscriptions = session.subscriptions.size(),
                              .waiting_notifications = session.notifications->waiting()};
    for (auto const* component : session.bound) numbers.bound.push_back(component->ref().code);
    std::ranges::sort(numbers.bound);
    return numbers;
}

}  // namespace rois
