// Collects what has changed for the journal, and holds back answers and notifications until it is stored (docs/journal.md).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "engine/journal/journal.hpp"
#include "engine/session.hpp"

namespace rois {

class Attempts;

// Without a journal, nothing is collected or held back. While changes are being stored, later ones are collected, and stored
// together afterwards: the journal writes as often with many clients as with one.
class Recorder final : public Outbox {
public:
    using Sessions = std::unordered_map<SessionId, std::unique_ptr<Session>, IdHash>;

    // Both must outlive the recorder.
    Recorder(Outbox& readers, Sessions const& sessions) : readers_{readers}, sessions_{sessions} {}

    void keep_in(Journal& journal) { journal_ = &journal; }
    bool is_on() const { return journal_ != nullptr; }

    // What has changed. The sessions of logical components are not stored.
    void opened(Session&);
    void changed(Session&);
    void ended(Session&);
    // This session from before a restart does not return.
    void withdrawn(std::uint64_t session) { changed_.others.ended.push_back(session); }
    enum class Has : std::uint8_t { subscribed, subscribed_again };  // it had this subscription before
    void subscribed(Session const&, SubscribeId const&, Subscribe const&, Has);
    void unsubscribed(Session const&, SubscribeId const&);
    void changed(std::shared_ptr<Command> const&);
    void forgot(Session const&, std::shared_ptr<Command> const&);
    // The command does not exist any more, and the journal does not have it.
    void never_mind(std::shared_ptr<Command> const& command) noexcept {
        changed_.commands.erase(command);
        given_.commands.erase(command);
    }
    void changed_engine() { changed_.engine = is_on(); }
    void changed_stop(bool is_stopped) {
        changed_engine();
        if (is_on()) journal_->keep_stop(is_stopped);
    }

    // Whether the session's commands and answers wait for the journal.
    bool stores(Session const& session) const { return is_on() && session.is_stored; }
    // Why no command may begin; empty: it may.
    std::string why_no_commands() const;

    // Calls `then` once everything that has changed until now is stored, or cannot be stored now. Requires must_wait().
    using Then = std::function<void(bool stored, Instant now)>;
    void when_stored(Then then);
    // Whether something has changed that will soon be stored.
    bool must_wait() const { return !is_failing_ && (is_being_stored_ || changed_.any() || news_missed_); }

    // The queue has new notifications. Its readers are notified when these are stored. Cannot fail.
    void notify(NotificationQueue&) override;
    void flush() noexcept override { readers_.flush(); }

    // Whether something has changed, or the journal has failed and is tried again; not while it is busy.
    bool has_something_to_give() const {
        return (changed_.any() || given_.any() || news_missed_ || is_failing_) && !is_being_stored_ && !next_try_;
    }
    // Gives it to the journal; requires has_something_to_give(). If memory is missing, the next call tries again.
    void give(std::function<StoredEngine()> const& engine) noexcept;
    // The journal has stored the changes, or could not. Those that could not be stored are given again later.
    void stored(Instant now, Attempts&);
    void not_stored(Instant now, Attempts&);
    // Call it at each tick. What waits for a journal that fails, or takes too long, continues.
    void look(Instant now, Attempts&);

private:
    struct Subscribed {
        std::optional<Subscribe> asked;  // nullopt: the subscription has ended
        bool is_new = false;             // the journal does not have it yet
    };
    struct Collected {
        bool engine = false;
        std::set<Session*> sessions;
        std::set<Session*> with_news;  // sessions with new notifications
        std::set<std::shared_ptr<Command>> commands;
        std::map<std::pair<std::uint64_t, std::string>, Subscribed> subscriptions;  // by the number of the session, and id
        Changes others;                                                             // sessions and commands that are gone

        bool any() const;
        void forget(Session&);
        void add(Collected& earlier);
    };
    struct Shown {
        std::shared_ptr<NotificationQueue> queue;
        std::uint64_t until = 0;  // sequence
    };

    std::shared_ptr<Changes> changes(StoredEngine const&, std::vector<Shown>&);
    void add_notifications(Session&, Changes&, std::vector<Shown>&);
    static void call(std::vector<Then> const& list, bool stored, Instant now, Attempts&);

    Outbox& readers_;
    Sessions const& sessions_;
    Journal* journal_ = nullptr;

    Collected changed_;
    bool news_missed_ = false;   // there was no memory to note a session with new notifications
    std::vector<Then> waiting_;  // for these changes

    // The changes that the journal is storing, or could not store.
    bool is_being_stored_ = false;
    Collected given_;
    std::vector<Shown> to_show_;
    std::vector<Then> then_;
    std::optional<Steady> since_;  // when `look` saw it first

    bool is_failing_ = false;           // the last changes could not be stored, or not yet
    std::optional<Steady> next_try_{};  // to store them again
};

}  // namespace rois
