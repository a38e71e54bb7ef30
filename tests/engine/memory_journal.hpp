// A journal in memory, for the engine's tests.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "engine/journal/journal.hpp"

namespace rois {

// Stores changes when the test, or the engine of the tests, asks for it.
class MemoryJournal final : public Journal {
public:
    // What happens to changes when a call to the engine returns. `later`: nothing, until the test calls `settle`.
    enum class Then : std::uint8_t { stored, not_stored, later };
    Then then = Then::stored;
    std::string full;  // why no command may begin

    void store(std::shared_ptr<Changes const> changes) noexcept override {
        gone = changes->ended.size() + changes->unsubscribed.size() + changes->forgotten_commands.size();
        waiting_ = std::move(changes);
    }
    void keep_stop(bool is_stopped) noexcept override { is_stopped_ = is_stopped; }
    std::string why_no_commands() const override { return full; }

    bool has_waiting() const { return waiting_ != nullptr; }
    // Stores the waiting changes, or forgets them. Returns whether they are stored: without memory, none is.
    bool settle(bool stored) {
        auto const changes = std::exchange(waiting_, nullptr);
        try {
            if (stored) apply(*changes);
        } catch (std::bad_alloc const&) {
            return false;
        }
        steps += stored ? 1 : 0;
        return stored;
    }
    // The process has died: what waits is lost.
    StoredState take_state() {
        waiting_.reset();
        StoredState state{.engine = kept_.engine};
        state.engine.is_stopped = state.engine.is_stopped || is_stopped_;
        for (auto const& [number, each] : kept_.sessions) state.sessions.push_back(each);
        for (auto const& [key, each] : kept_.subscriptions) state.subscriptions.push_back(each);
        for (auto const& [key, each] : kept_.commands) state.commands.push_back(each);
        for (auto const& [key, each] : kept_.notifications) state.notifications.push_back(each);
        return state;
    }

    int steps = 0;
    std::size_t gone = 0;  // sessions, subscriptions and commands that were no longer needed, in the last changes

private:
    using Key = std::pair<std::uint64_t, std::string>;

    struct Kept {
        StoredEngine engine;
        std::map<std::uint64_t, StoredSession> sessions{};
        std::map<Key, StoredSubscription> subscriptions{};
        std::map<Key, StoredCommand> commands{};
        std::map<std::pair<std::uint64_t, std::uint64_t>, StoredNotification> notifications{};
    };

    static void put(auto& to, auto& news) noexcept {
        for (auto const& [key, value] : news) to.erase(key);
        to.merge(news);
    }

    // The steps that need memory come first: all changes are stored, or none.
    void apply(Changes const& changes) {
        Kept news{.engine = changes.engine};
        std::vector<Key> unsubscribed, forgotten;
        for (auto const& each : changes.unsubscribed) unsubscribed.emplace_back(each.session, each.id);
        for (auto const& each : changes.forgotten_commands) forgotten.emplace_back(each.session, each.id);
        for (auto const& each : changes.sessions) news.sessions.insert_or_assign(each.session, each);
        for (auto const& each : changes.subscriptions) news.subscriptions.insert_or_assign({each.session, each.id.text}, each);
        for (auto const& each : changes.commands) news.commands.insert_or_assign({each.session, each.id.text}, each);
        for (auto const& each : changes.notifications)
            news.notifications.insert_or_assign({each.session, each.numbered.sequence}, each);

        kept_.engine = std::move(news.engine);
        for (auto const& key : unsubscribed) kept_.subscriptions.erase(key);
        for (auto const& key : forgotten) kept_.commands.erase(key);
        for (auto const& each : changes.forgotten_notifications)
            std::erase_if(kept_.notifications, [&](auto const& one) {
                auto const [session, sequence] = one.first;
                return session == each.session && sequence >= each.from && sequence <= each.until;
            });
        put(kept_.sessions, news.sessions);
        put(kept_.subscriptions, news.subscriptions);
        put(kept_.commands, news.commands);
        put(kept_.notifications, news.notifications);
        for (auto const session : changes.ended) {
            kept_.sessions.erase(session);
            auto const is_of_it = [&](auto const& one) { return one.first.first == session; };
            std::erase_if(kept_.subscriptions, is_of_it);
            std::erase_if(kept_.commands, is_of_it);
            std::erase_if(kept_.notifications, is_of_it);
        }
    }

    std::shared_ptr<Changes const> waiting_;
    Kept kept_;
    bool is_stopped_ = false;
};

}  // namespace rois
