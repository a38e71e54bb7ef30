// Sessions of other engines (decision 39) and of logical components: component_changed, and the end after silence.
#include "engine/core.hpp"

namespace rois {

namespace {

// The least time between two `component_changed` of one component. Logical components learn a new status at once.
constexpr std::chrono::milliseconds between_states{200};
constexpr std::chrono::milliseconds signs_of_life_wanted{1'000};
constexpr std::chrono::seconds silence{2};  // after which a link counts as lost

}  // namespace

// Ends the session of an engine that was silent for too long, even if its link is open: the other engine measures the same times,
// and has given up the session, too.
void Engine::Core::serve_engines(Instant now) {
    Attempts attempts;
    for (auto* component : std::vector{registry_.logical()}) {
        attempts([&] { own_session(*component, now); });
        attempts([&] { free_members(*component, now); });
    }
    for (auto* session : std::vector{engines_}) {
        if (session->ending) continue;
        if (session->owner == nullptr) session->notifications->want_signs_of_life(now.steady + signs_of_life_wanted);
        bool const silent = session->owner == nullptr && session->lease.last_received() + silence + session->window <= now.steady;
        attempts([&] {
            if (silent)
                end(*session, "its engine gave no sign of life for " + in_seconds(silence + session->window), now);
            else
                notify_of_states(*session, now);
        });
    }
    attempts.rethrow();
}

void Engine::Core::notify_of_states(Session& session, Instant now) {
    if (session.owner == nullptr) {
        for (auto const& [ref, component] : registry_.all())
            if (may_see(session.rights.get(), ref)) notify_of_state(session, *component, now);
        return;
    }
    for (auto const& ref : session.owner->members())
        if (auto const* member = registry_.find(ref)) notify_of_state(session, *member, now);
}

void Engine::Core::notify_of_state(Session& session, RegisteredComponent const& component, Instant now) {
    auto const status = component.status_for(&session);
    auto const state = component.reported_states();
    auto const last = session.notified.find(&component);
    if (last != session.notified.end()) {
        auto const& before = last->second;
        bool const changed = before.status != status || before.state != state;
        bool const waits = session.owner == nullptr || before.status == status;
        if (!changed || (waits && now.steady - before.at < between_states)) return;
    }
    notifier_.notify(session, ComponentChanged{component.ref(), status, component.reported()}, component.answer_to(session));
    session.notified[&component] = {now.steady, status, state};
}

void Engine::Core::forget_in_sessions_of_engines(RegisteredComponent const& component, Instant now) {
    Attempts attempts;
    for (auto* session : engines_) {
        bool const was_known = session->notified.erase(&component) > 0;
        if (!was_known || session->owner == nullptr || session->ending) continue;
        attempts([&] { notifier_.notify(*session, ComponentChanged{component.ref(), ComponentStatus::uninitialized, {}}); });
    }
    if (component.own_session != nullptr) attempts([&] { end(*component.own_session, "its logical component has left", now); });
    attempts.rethrow();
}

}  // namespace rois
