// A journal in memory, for the engine's tests.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "engine/journal/journal.hpp"

namespace rois {

// Stores changes when the test, or the engine of the tests, asks for it.
class MemoryJournal final : public Journal {
public:
    // What happens to changes when a call to the engine returns. `later`: nothing, until the test calls `settle`.
    enum class Then : std::uint8_t { stored, not_stored, later };
    Then then = Then::stored;
    std::string full;  // why no command may begin

    void store(std::shared_ptr<Changes const> changes) noexcept override { waiting_ = std::move(changes); }
    std::string why_no_commands() const override { return full; }

    bool has_waiting() const { return waiting_ != nullptr; }
    // Stores what waits, or forgets it.
    void settle(bool stored) {
        auto const changes = std::exchange(waiting_, nullptr);
        if (stored) apply(*changes);
        steps += stored ? 1 : 0;
    }
    // The process has died: what waits is lost.
    StoredState take_state() {
        waiting_.reset();
        StoredState state{.engine = engine_};
        for (auto const& [number, each] : sessions_) state.sessions.push_back(each);
        for (auto const& [key, each] : subscriptions_) state.subscriptions.push_back(each);
        for (auto const& [key, each] : commands_) state.commands.push_back(each);
        for (auto const& [key, each] : notifications_) state.notifications.push_back(each);
        return state;
    }

    int steps = 0;

private:
    template <class Value>
    using ById = std::map<std::pair<std::uint64_t, std::string>, Value>;

    void apply(Changes const& changes) {
        engine_ = changes.engine;
        for (auto const& each : changes.unsubscribed) subscriptions_.erase({each.session, each.id});
        for (auto const& each : changes.forgotten_commands) commands_.erase({each.session, each.id});
        for (auto const& each : changes.forgotten_notifications)
            std::erase_if(notifications_,
                          [&](auto const& one) { return one.first.first == each.session && one.first.second <= each.until; });
        for (auto const& each : changes.sessions) sessions_.insert_or_assign(each.session, each);
        for (auto const& each : changes.subscriptions) subscriptions_.insert_or_assign({each.session, each.id.text}, each);
        for (auto const& each : changes.commands) commands_.insert_or_assign({each.session, each.id.text}, each);
        for (auto const& each : changes.notifications)
            notifications_.insert_or_assign({each.session, each.numbered.sequence}, each);
        for (auto const session : changes.ended) {
            sessions_.erase(session);
            auto const is_of_it = [&](auto const& one) { return one.first.first == session; };
            std::erase_if(subscriptions_, is_of_it);
            std::erase_if(commands_, is_of_it);
            std::erase_if(notifications_, is_of_it);
        }
    }

    std::shared_ptr<Changes const> waiting_;
    StoredEngine engine_;
    std::map<std::uint64_t, StoredSession> sessions_;
    ById<StoredSubscription> subscriptions_;
    ById<StoredCommand> commands_;
    std::map<std::pair<std::uint64_t, std::uint64_t>, StoredNotification> notifications_;
};

}  // namespace rois
