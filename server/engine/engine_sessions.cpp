// What sessions of other engines are told (decision 39), and when they end.
#include "engine/core.hpp"

namespace rois {

namespace {

constexpr std::chrono::milliseconds between_states{200};  // of one component
constexpr std::chrono::milliseconds signs_of_life_wanted{1'000};
constexpr std::chrono::seconds silence{2};  // of a link that counts as lost

}  // namespace

// A link that is silent counts as lost, even if it is open: the other engine counts alike, and has given up our session then.
void Engine::Core::serve_engines(Instant now) {
    Attempts attempts;
    for (auto* session : std::vector{engines_}) {
        if (session->ending) continue;
        session->notifications->want_signs_of_life(now.steady + signs_of_life_wanted);
        bool const silent = session->last_heard + silence + session->window <= now.steady;
        attempts([&] {
            if (silent)
                end(*session, "its engine was silent for too long", now);
            else
                tell_states(*session, now);
        });
    }
    attempts.rethrow();
}

void Engine::Core::tell_states(Session& session, Instant now) {
    for (auto const& [ref, component] : registry_.all()) {
        auto const status = component->status_for(&session);
        auto const state = component->reported_states();
        auto const [place, is_new] = session.told.try_emplace(component.get());
        auto& told = place->second;
        bool const changed = is_new || told.status != status || told.state != state;
        if (!changed || (!is_new && now.steady - told.at < between_states)) continue;
        told = {now.steady, status, state};
        notifier_.notify(session, ComponentChanged{component->ref(), status, component->reported()});
    }
}

}  // namespace rois
