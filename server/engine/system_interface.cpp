// System interface (7.4.1, table 2): connection, profiles, details of errors.
#include <algorithm>

#include "engine/core.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr std::chrono::milliseconds shortest_lease{1'000};

using Milliseconds = std::chrono::milliseconds;

std::string must_be(std::string_view name, Milliseconds shortest, Milliseconds longest, Milliseconds not_this) {
    return std::string{name} + " must be " + std::to_string(std::min(shortest, longest).count()) + " to " +
           std::to_string(longest.count()) + " milliseconds, not " + std::to_string(not_this.count());
}

bool is_different(MotionLease::Terms const& a, MotionLease::Terms const& b) {
    return a.linked != b.linked || a.http != b.http || a.links_count != b.links_count;
}

// Sets `terms` to the requested leases. Returns why a requested lease is invalid, or nullopt.
std::optional<std::string> agree(MotionLease::Terms& terms, Connect const& asked, EngineSettings const& most) {
    auto const take = [](std::string_view name, std::optional<std::chrono::milliseconds> wanted,
                         std::chrono::milliseconds longest, std::chrono::milliseconds& lease) -> std::optional<std::string> {
        if (!wanted) return {};
        lease = *wanted;
        if (lease >= std::min(shortest_lease, longest) && lease <= longest) return {};
        return must_be(name, shortest_lease, longest, lease);
    };
    if (auto problem = take("motion_lease", asked.motion_lease, most.motion_lease, terms.linked)) return problem;
    if (auto problem = take("motion_lease_http", asked.motion_lease_http, most.motion_lease_http, terms.http)) return problem;
    if (asked.motion_proof) terms.links_count = *asked.motion_proof == MotionProof::pong;
    return {};
}

}  // namespace

void Engine::Core::connect(SharedAsked const& asked, Connect const& connection, Instant now) {
    auto* const known = session_of(*asked);
    auto terms =
        known != nullptr ? known->lease.terms() : MotionLease::Terms{settings_.motion_lease, settings_.motion_lease_http};
    if (auto problem = agree(terms, connection, settings_))
        return asked->answer(refused<Connect::Reply>(ReturnCode::bad_parameter, *problem));
    auto const window = connection.window.value_or(settings_.resume_window);
    if (window < std::min(shortest_lease, settings_.resume_window) || window > settings_.resume_window)
        return asked->answer(refused<Connect::Reply>(ReturnCode::bad_parameter,
                                                     must_be("window", shortest_lease, settings_.resume_window, window)));
    if (known != nullptr) {
        bool const differs = is_different(terms, known->lease.terms()) || (connection.window && window != known->window);
        known->lease.agree(terms);
        if (connection.window) known->window = window;
        known->lease.request_received(now.steady);
        auto reply = perform(*known, connection, now);
        if (!differs) return asked->answer(std::move(reply));  // the sign of life of another engine
        recorder_.changed(*known);
        return answer_when_stored(asked, std::move(reply));
    }
    if (memory_->tight()) return asked->refuse(Refusal::no_memory);
    if (sessions_.size() >= settings_.max_sessions) {
        auto* const idle = longest_idle();
        if (idle == nullptr) {
            ++refused_.sessions;
            return asked->refuse(Refusal::too_many_sessions);
        }
        ++sessions_replaced_;
        end(*idle, "it was idle, and a new session needed its place", now);
        settle(now);
    }
    auto session = std::make_unique<Session>(terms, now.steady);
    session->window = window;
    session->is_engine = connection.is_engine;
    session->receives_switches = connection.switches;
    session->rights = asked->rights;
    if (asked->is_over_http) session->quiet_until += settings_.session_timeout;  // `connect` is a sign of life (decision 2)
    answer_when_stored(asked, perform(open(std::move(session), now), connection, now));
}

Session& Engine::Core::open(std::unique_ptr<Session> session, Instant now) {
    session->id.text = fresh_secret_();
    session->number = ++last_session_;
    session->notifications =
        std::make_shared<NotificationQueue>(session->id, settings_.max_waiting_notifications, settings_.max_sent_notifications);
    auto& opened = enter(std::move(session));
    trace_->session_opened(opened.number);
    if (everything_is_stopped_) tell(opened, everything_was_stopped(), now);
    return opened;
}

Session& Engine::Core::enter(std::unique_ptr<Session> session) {
    if (session->is_engine) engines_.reserve(engines_.size() + 1);
    bool const new_slot = free_slots_.empty();
    auto const slot = new_slot ? static_cast<std::uint32_t>(sessions_.size()) : free_slots_.back();
    if (new_slot) free_slots_.reserve(slot + 1);  // the end of a session must not allocate
    session->events = {slot, events_.next()};
    session->errors = {slot, errors_.next()};
    await_end_of_window(*session);
    auto& place = sessions_[session->id];
    place = std::move(session);
    auto& opened = *place;
    if (!new_slot) free_slots_.pop_back();
    if (opened.is_engine) engines_.push_back(&opened);
    recorder_.opened(opened);
    return opened;
}

Reply Engine::Core::perform(Session& session, Connect const& connection, Instant) {
    Connect::Reply reply;
    reply.session = session.id;
    if (connection.window) reply.window = session.window;
    return reply;
}

Reply Engine::Core::perform(Session& session, Resume const& resume, Instant) {
    if (resume.last_sequence <= session.notifications->last_sequence()) {
        trace_->session_resumed(session.number);
        if (session.is_engine && resume.last_sequence == 0) session.notifications->keep_unread();
        return Resume::Reply{};
    }
    return refused<Resume::Reply>(ReturnCode::bad_parameter, "last_sequence must be at most " +
                                                                 std::to_string(session.notifications->last_sequence()) +
                                                                 ", not " + std::to_string(resume.last_sequence));
}

bool Engine::Core::owns_present_stop(Session const& session) const {
    return everything_is_stopped_ && session.owns_stop && session.last_stop == last_stop_;
}

bool Engine::Core::present_stop_has_owners() const {
    return !ended_owners_.empty() ||
           std::ranges::any_of(sessions_, [&](auto const& each) { return owns_present_stop(*each.second); });
}

// Whose stop it is, for a session that follows one that has ended: of a client with the same token, and of an engine if it is
// one.
std::string Engine::Core::owner_of(Session const& session) {
    auto const* rights = session.rights.get();
    return (session.is_engine ? "engine " : "client ") + (rights == nullptr ? "" : rights->holder() + " " + rights->id());
}

// The session takes the place of an owner that has ended. Returns false if none had its token.
bool Engine::Core::follow_ended_owner(Session const& session) {
    auto const found = std::ranges::find(ended_owners_, owner_of(session));
    if (found == ended_owners_.end()) return false;
    ended_owners_.erase(found);
    return true;
}

// A stop ends when each session that owns it has cleared it. A stop without owners, such as one of POST /rois/stop, ends only
// with POST /rois/clear. A session that asks again sees how far the stop is.
Reply Engine::Core::perform(Session& session, StopEverything const&, Instant now) {
    StopEverything::Reply reply;
    bool const was_stopped = everything_is_stopped_;
    if (!was_stopped || session.last_stop != last_stop_) {
        session.owns_stop = !was_stopped || present_stop_has_owners();
        auto const number = last_stop_;
        auto ended_owners = std::move(ended_owners_);
        Attempts attempts;
        attempts([&] { begin_stop_of_everything(now); });
        if (was_stopped) {
            last_stop_ = number;
            ended_owners_ = std::move(ended_owners);
            attempts([&] { follow_ended_owner(session); });
        }
        session.last_stop = last_stop_;
        attempts([&] { recorder_.changed(session); });
        attempts([&] { trace_->stopped_everything(session.number); });
        attempts.rethrow();
    }
    if (owns_present_stop(session)) reply.stop = last_stop_;  // also again: the first answer may have been lost
    reply.not_halted = not_halted();
    std::erase_if(reply.not_halted, [&](std::string const& ref) { return !may_see(session.rights.get(), ref); });
    return reply;
}

Reply Engine::Core::perform(Session& session, ClearStop const& asked, Instant) {
    // An engine whose earlier session has ended before it knew the number of its stop.
    bool const follows = session.is_engine && std::ranges::find(ended_owners_, owner_of(session)) != ended_owners_.end();
    auto const stop = asked.stop == ClearStop::own && (owns_present_stop(session) || follows) ? last_stop_ : asked.stop;
    if (stop != last_stop_ || !present_stop_has_owners()) return ClearStop::Reply{};
    recorder_.changed(session);
    recorder_.changed_engine();
    bool const owned = owns_present_stop(session);
    if (owned) session.owns_stop = false;
    bool const has_cleared = owned || follow_ended_owner(session);
    bool const is_over = !present_stop_has_owners();
    if (is_over) clear();
    if (has_cleared) trace_->cleared_stop(session.number, is_over);
    return ClearStop::Reply{};
}

Reply Engine::Core::perform(Session& session, Disconnect const&, Instant now) {
    end(session, "it disconnected", now);
    return Disconnect::Reply{};
}

namespace {

// The profile of the sub engine that has all of these components, or that of the main engine.
std::shared_ptr<EngineProfile const> profile_of_engine_with(std::shared_ptr<EngineProfile const> const& main,
                                                            std::vector<ComponentEntry> const& components) {
    if (components.empty()) return main;
    auto const sub = std::ranges::find(
        main->sub_profiles, components.front().engine,
        [](EngineProfile const& profile) -> auto const& { return profile.object.name; });
    bool const has_all = sub != main->sub_profiles.end() &&
                         std::ranges::all_of(components, [&](auto const& c) { return c.engine == sub->object.name; });
    return has_all ? std::shared_ptr<EngineProfile const>{main, &*sub} : main;
}

}  // namespace

Reply Engine::Core::perform(Session& session, GetProfile const& get, Instant) {
    auto selection = Selection::compile(get.condition, vocabulary(session));
    if (auto* problem = std::get_if<std::string>(&selection))
        return refused<GetProfile::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    GetProfile::Reply reply;
    auto const& selected = std::get<Selection>(selection);
    bool names_members = selected.filter().names_units();
    for (auto const* component : select(selected, session)) {
        names_members = names_members || component->is_member;
        reply.components.push_back(component->entry());
        if (session.is_engine) reply.components.back().traits = component->traits();
    }
    if (session.is_engine) reply.space = space(session.rights.get());
    auto const whole = profile_seen_by(session.rights.get(), session.is_engine ? profile_for_engines(names_members)
                                                             : names_members   ? profile()
                                                                               : profile_without_members());
    reply.profile = selected.filter().restricts() ? profile_of_engine_with(whole, reply.components) : whole;
    return reply;
}

Reply Engine::Core::perform(Session& session, GetErrorDetail const& get, Instant now) {
    auto const& id = get.error_id.text;
    return reply_with<GetErrorDetail::Reply>(errors_.find(id, session.errors, now), "error", id, get.condition, session);
}

// Decision 24: the engine's errors go to all sessions; a component's errors to the sessions that use it.
void Engine::Core::publish(FoundError const& report, Instant now, Attempts& deliveries) {
    auto const* const component = report.component.get();
    std::set<Session*> concerned;
    if (component != nullptr) {
        auto ever = perspective(nullptr, Perspective::Of::ever);
        concerned = subscriptions_.possible_subscribers(*component, [&](Subscription const& subscription) {
            auto const may_match = [&] { return subscription.filter.match(ever.candidate(*component)) != Match::no; };
            return paid_by(*subscription.subscribers.front().session, now, may_match).value_or(true);
        });
        if (component->bound_to != nullptr) concerned.insert(component->bound_to);
    }
    auto error = noted(report, now);
    auto const notification = std::make_shared<OutgoingNotification const>(error);
    error.text = report.text;
    auto const for_engines = engines_.empty() ? notification : std::make_shared<OutgoingNotification const>(std::move(error));
    auto const notify = [&](Session& session) {
        deliveries([&] {
            errors_.add_receiver(session.errors.slot);
            bool const gets_text = session.is_engine && (component == nullptr || !hides_members(session, component->ref().code));
            notifier_.notify(session, gets_text ? for_engines : notification,
                             component == nullptr ? 0 : component->answer_to(session));
        });
    };
    if (component == nullptr)
        for (auto const& [id, session] : sessions_) notify(*session);
    for (auto* session : concerned) notify(*session);
}

void Engine::Core::tell(Session& session, FoundError const& found, Instant now) {
    auto error = noted(found, now);
    if (session.is_engine) error.text = found.text;
    errors_.add_receiver(session.errors.slot);
    notifier_.notify(session, std::move(error));
}

// Keeps the details of the error.
ReceiveError Engine::Core::noted(FoundError const& report, Instant now) {
    auto results = std::make_shared<Results>();
    if (report.component != nullptr)
        results->parameters.push_back(
            reference("component_ref", report.component->ref().code, report.component->ref().codebook_ref));
    results->parameters.push_back(date_time("time", now.utc));
    results->parameters.push_back(text("text", report.text));
    ReceiveError error{
        .error_id = {errors_.add(std::move(results), nullptr, now)}, .error_type = report.type, .component_ref = {}};
    if (report.component != nullptr) error.component_ref = report.component->ref();
    ++errors_published_;
    return error;
}

void Engine::Core::halt_everything(Instant now) {
    halts_only_ = !std::exchange(everything_is_stopped_, true);
    Attempts attempts;
    attempts([&] { on_stop_(true); });  // before the components are halted
    attempts([&] { executor_.stop_all("everything was stopped", now); });
    attempts([&] { settle(now); });
    attempts.rethrow();
}

}  // namespace rois
