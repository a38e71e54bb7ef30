// Sessions of other engines (decision 39): component_changed, and the end after silence.
#include "engine/core.hpp"

namespace rois {

namespace {

constexpr std::chrono::milliseconds between_states{200};  // of one component
constexpr std::chrono::milliseconds signs_of_life_wanted{1'000};
constexpr std::chrono::seconds silence{2};  // after which a link counts as lost

}  // namespace

// A silent link counts as lost, even if it is open: the other engine counts the same times, and has given up the session then.
void Engine::Core::serve_engines(Instant now) {
    Attempts attempts;
    for (auto* session : std::vector{engines_}) {
        if (session->ending) continue;
        session->notifications->want_signs_of_life(now.steady + signs_of_life_wanted);
        bool const silent = session->lease.last_received() + silence + session->window <= now.steady;
        attempts([&] {
            if (silent)
                end(*session, "its engine was silent for too long", now);
            else
                notify_of_states(*session, now);
        });
    }
    attempts.rethrow();
}

void Engine::Core::notify_of_states(Session& session, Instant now) {
    for (auto const& [ref, component] : registry_.all()) {
        auto const status = component->status_for(&session);
        auto const state = component->reported_states();
        auto const last = session.notified.find(component.get());
        if (last != session.notified.end()) {
            auto const& before = last->second;
            bool const changed = before.status != status || before.state != state;
            if (!changed || now.steady - before.at < between_states) continue;
        }
        notifier_.notify(session, ComponentChanged{component->ref(), status, component->reported()});
        session.notified[component.get()] = {now.steady, status, state};
    }
}

}  // namespace rois
