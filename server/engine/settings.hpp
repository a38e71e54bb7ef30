// The engine's limits and periods. All but `max_kept_events` are configurable.
#pragma once

#include <chrono>
#include <cstddef>

namespace rois {

// Whether the commands of a session that ends are stopped (decision 3).
enum class OnSessionEnd : std::uint8_t { stop, continue_ };

struct EngineSettings {
    std::size_t max_sessions = 1'000;
    std::size_t max_waiting_notifications = 1'024;   // per session (decision 23)
    std::size_t max_sent_notifications = 1'024;      // kept for resuming, per session
    std::size_t max_kept_events = 0;                 // without a receiver: kept for a later subscription until they expire
    std::size_t max_command_results = 1'000;         // kept, per session (decision 17)
    std::size_t max_subscribed_predicates = 10'000;  // total in the conditions of a session's subscriptions (docs/conditions.md)
    std::size_t max_predicates = 100'000;            // total in the conditions of all subscriptions
    std::size_t max_condition_bytes = 1 << 20;       // total text in the conditions of a session's subscriptions
    std::size_t max_condition_steps = 40'000'000;    // a second, for matching conditions (engine/conditions/effort.hpp)
    std::chrono::milliseconds command_results = std::chrono::minutes{10};
    std::chrono::milliseconds event_details = std::chrono::seconds{60};     // `expire` (decision 21)
    std::chrono::milliseconds error_details = std::chrono::minutes{10};     // decision 24
    std::chrono::milliseconds start_timeout = std::chrono::seconds{5};      // unless the profile has one (decision 16)
    std::chrono::milliseconds question_deadline = std::chrono::seconds{1};  // for a component's answer (decision 36)
    std::chrono::milliseconds session_timeout = std::chrono::seconds{60};
    std::chrono::milliseconds resume_window = std::chrono::seconds{30};
    std::chrono::milliseconds motion_lease = std::chrono::seconds{2};        // of a session with a link (decision 33)
    std::chrono::milliseconds motion_lease_http = std::chrono::seconds{10};  // of a session that sends requests only
    OnSessionEnd on_session_end = OnSessionEnd::stop;
};

// The present settings with those of others, as far as they can change while the engine runs. Sessions that are open keep the
// limits of their notifications.
inline EngineSettings with_changes(EngineSettings const& present, EngineSettings const& wanted) {
    auto next = wanted;
    next.max_kept_events = present.max_kept_events;
    return next;
}

}  // namespace rois
