// The engine as the connections see it: one mutex around it, taken for as long as one operation, and the places from which a
// session's notifications are read. All functions may be called from any thread.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/engine.hpp"
#include "engine/prefetch.hpp"
#include "gateway/log.hpp"
#include "gateway/readers.hpp"
#include "gateway/session_quota.hpp"
#include "gateway/telemetry.hpp"
#include "xml/codec.hpp"

namespace rois {

class Gateway;

// As long as it lives, the session's readers do not see what was queued since the operation that gave it: its answer comes
// first (decision 22). Destroy it once the answer has been handed to the socket. Must not outlive the gateway.
class Hold {
public:
    Hold() = default;
    Hold(Hold&& other) noexcept { *this = std::move(other); }
    Hold& operator=(Hold&& other) noexcept;
    ~Hold() { release(); }

private:
    friend class Gateway;
    Hold(Gateway&, std::shared_ptr<NotificationQueue>);
    void release();

    Gateway* gateway_ = nullptr;  // null: holds nothing
    std::shared_ptr<NotificationQueue> queue_;
    NotificationQueue::Hold place_ = 0;
};

// One reader's place in a session's notifications, and its link to the session. The gateway and the reader must outlive it.
class Reading {
public:
    // Not among the readers yet: Gateway::read does that.
    Reading(Gateway& gateway, Link link, std::uint64_t after, Reader& reader)
        : gateway_{gateway}, link_{link}, after_{after}, reader_{reader} {}
    ~Reading();
    Reading(Reading const&) = delete;
    Reading& operator=(Reading const&) = delete;

    using Then = NotificationQueue::Next;
    struct Taken {
        std::vector<Numbered> notifications;
        Then then = Then::wait;
    };
    // The next ones, at most `most`; the place moves behind them. The engine is not locked for it.
    Taken take(std::size_t most);
    Then take(std::size_t most, std::vector<Numbered>& into);  // appends them

    // The motion lease (decision 33): whether the application is asked for signs of life now; and one of them.
    bool wants_signs_of_life(Steady now) const { return queue_->wants_signs_of_life(now); }
    void heard_pong();
    // The long poll was answered; without it the link counts as lost when this ends.
    void answered() { closing_ = Closing::answered; }

    // Prefetches what `take` needs.
    void approach() const { prefetch<sizeof(NotificationQueue)>(queue_.get()); }

    SessionId const& session() const { return queue_->session(); }

private:
    friend class Gateway;

    Gateway& gateway_;
    Link link_;
    Closing closing_ = Closing::lost;
    std::uint64_t after_;
    Reader& reader_;
    std::shared_ptr<NotificationQueue> queue_;  // null until it is among the readers
};

// What those hear who name no session, an unknown one or an ended one.
Fault no_such_session();
Fault shutting_down();
// To whoever sends a document that there is no memory for.
Fault no_memory_for_document(MemoryBudget&);

// The document of a notification (wire.md): the sequence is its session's own; what stands before and behind it is shared by all
// its receivers, encoded once, and lives as long as the notification.
class NotificationDocument {
public:
    explicit NotificationDocument(Numbered const&);
    std::size_t size() const { return before_.size() + digits_size_ + after_.size(); }
    void append_to(std::string& out) const;

private:
    std::string_view before_;
    std::string_view after_;
    std::array<char, 20> digits_{};
    std::size_t digits_size_ = 0;
};

enum class Via : std::uint8_t { http, websocket };

// What one client may take (docs/metrics.md).
struct ClientLimits {
    std::size_t sessions_per_connection = 16;
    std::size_t sessions_per_address = 64;
    std::size_t streams_per_session = 8;
};

// What an operation's request is answered with, and what it means for the connection that it came by.
struct Answer {
    std::string document;
    std::optional<Fault> fault;  // which the document is; no operation ran
    enum class Turn : std::uint8_t { stays, connected, resumed, disconnected } turn = Turn::stays;
    SessionId session;                 // connected, resumed: which the connection speaks for from now on
    std::uint64_t session_number = 0;  // of it, if it was opened or resumed now
    std::uint64_t last_sequence = 0;   // resumed: where its notifications go on
    Hold hold;
};

class Gateway {
public:
    // All must outlive the gateway; `readers` is the engine's outbox. The memory is measured at each tick.
    Gateway(Engine&, Readers& readers, Telemetry&, ClientLimits = {}, MemoryBudget& = MemoryBudget::none());

    // Reads the request's text, performs the operation for the session (an empty id: for nobody yet) and encodes the answer.
    // Only the operation itself is done with the engine locked. `opener`: the connection, whose sessions are counted; null: they
    // are not. `reading`: of the session, if there is one, which spares a search.
    Answer answer(xml::RequestReader&, SessionId const&, std::string_view text, Via,
                  std::shared_ptr<Opener> const& opener = nullptr, Reading const* reading = nullptr);

    // A fault if there is no such session, if `after` is above the last sequence that was given out in it, or if it has as many
    // event streams as it may.
    std::variant<std::unique_ptr<Reading>, Fault> read(SessionId const&, Link, std::uint64_t after, Reader&,
                                                       Readers::Until = Readers::Until::closed);

    // Halts all components and begins the engine's time. Once, before anything is answered.
    void begin();

    // To be called every few milliseconds: lets the engine do what is due. Throws what went wrong, when all else was done.
    void tick();

    // For a gateway that is given up: halts every component, as far as the engine can be had within a second. Never throws.
    void halt_at_last() noexcept;

    // Components come and go: those that `make` makes with the engine locked, since their devices move meanwhile. Throws what
    // that and the engine throw.
    void change(std::function<ComponentChange()> const& make);

    // Stop for everything (decision 34), and its end. Return the state afterwards.
    StopState stop_everything();
    StopState clear();
    bool everything_is_stopped() const;
    std::vector<std::string> not_halted() const;
    std::vector<std::string> not_ready() const;

    // Ends all sessions; what comes later is refused.
    void shut_down();
    MemoryBudget& memory() { return memory_; }
    bool shutting_down() const { return shutting_down_; }

    std::shared_ptr<EngineProfile const> profile() const;
    std::vector<ComponentEntry> components() const;
    EngineStatistics statistics() const;

private:
    friend class Farewell;
    friend class Hold;
    friend class Reading;

    std::variant<Reply, Refusal> perform(SessionId const&, Operation const&, Via, std::shared_ptr<Opener> const&, Reading const*,
                                         Instant now, Answer&);
    std::optional<Fault> refusal_of(Opener const&);
    Fault fault_of(Refusal);
    MemoryBudget::Room room_for(std::string_view text);
    void save_memory(Steady now);
    void heard_from_opened(std::variant<Reply, Refusal> const&, Instant now);

    Engine& engine_;
    Readers& readers_;
    Telemetry& telemetry_;
    MemoryBudget& memory_;
    Steady memory_released_;    // when memory was given back to the system last; the tick's own
    mutable std::mutex mutex_;  // guards the engine, the readers and the quota
    SessionQuota quota_;
    std::size_t streams_per_session_;
    EngineLog log_;
    std::atomic<bool> shutting_down_ = false;
};

// Joins the readers of a session that has ended, to see when the others have taken what was left for them.
class Farewell {
public:
    Farewell(Gateway&, SessionId, Reader&);
    ~Farewell();
    Farewell(Farewell const&) = delete;
    Farewell& operator=(Farewell const&) = delete;

    // The reader is woken whenever this may have changed.
    bool alone() const;

private:
    Gateway& gateway_;
    SessionId session_;
    Reader& reader_;
};

}  // namespace rois
