// The engine behind one mutex, which is held during one operation, and the readers of its notifications. Thread-safe: all
// functions may be called from any thread.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/engine.hpp"
#include "gateway/access/session_quota.hpp"
#include "gateway/access/tokens.hpp"
#include "gateway/process/log.hpp"
#include "gateway/process/telemetry.hpp"
#include "gateway/readers.hpp"
#include "xml/codec/codec.hpp"

namespace rois {

class Gateway;

// Keeps an operation's answer in front of the notifications that the operation caused (decision 22): while it lives, the
// session's readers do not see them. Destroy it after the answer was given to the socket. The gateway must outlive it.
class Hold {
public:
    Hold() = default;
    Hold(Hold&& other) noexcept { *this = std::move(other); }
    Hold& operator=(Hold&& other) noexcept;
    ~Hold() { release(); }

    // The answer cannot be sent yet: from now until `resume`, only the notifications that its operation causes wait for it.
    void delay();
    void resume();

private:
    friend class Gateway;
    Hold(Gateway&, std::shared_ptr<NotificationQueue>);
    void release();
    void notify(Gateway&);
    void leave() {
        if (gateway_ != nullptr) queue_->leave(place_);
    }
    NotificationQueue::Hold number() const { return place_; }

    Gateway* gateway_ = nullptr;  // null: holds nothing
    std::shared_ptr<NotificationQueue> queue_;
    NotificationQueue::Hold place_ = 0;
};

// A reader's position in a session's notifications, and its link to the session. The gateway and the reader must outlive it.
class Reading {
public:
    // Does not join the readers: only Gateway::read does.
    Reading(Gateway& gateway, LinkKind link, std::uint64_t after, Reader& reader)
        : gateway_{gateway}, link_{link}, after_{after}, reader_{reader} {}
    ~Reading();
    Reading(Reading const&) = delete;
    Reading& operator=(Reading const&) = delete;

    using Then = NotificationQueue::Next;
    struct Taken {
        std::vector<Numbered> notifications;
        Then then = Then::wait;
    };
    // Returns at most `most` notifications and moves the position behind them. Does not lock the engine.
    Taken take(std::size_t most);
    Then take(std::size_t most, std::vector<Numbered>& into);  // appends to `into`

    // The motion lease (decision 33): whether it needs signs of life now, and the report of one.
    bool wants_signs_of_life(Steady now) const { return queue_->wants_signs_of_life(now); }
    void note_pong();
    // The long poll was answered. If this is not called, the link counts as lost when the object is destroyed.
    void answered() { closing_ = Closing::answered; }

    SessionId const& session() const { return queue_->session(); }
    // The session is that of another engine, which knows the answers to its requests by their request_id (decision 39).
    bool is_of_engine() const { return is_of_engine_; }

private:
    friend class Gateway;

    Gateway& gateway_;
    LinkKind link_;
    Closing closing_ = Closing::lost;
    std::uint64_t after_;
    Reader& reader_;
    std::shared_ptr<NotificationQueue> queue_;  // null until it is among the readers
    bool is_of_engine_ = false;
};

// The fault for a request without a token that is valid.
Fault unauthorized();
// The fault for a request with a missing, unknown or ended session, or one of another token.
Fault no_such_session();
Fault shutting_down();
// The fault for a document that does not fit into memory.
Fault no_memory_for_document(MemoryBudget&);

// The document of a notification (docs/clients.md). Only the sequence differs between sessions. The text before and behind it is
// encoded once, shared by all receivers, and lives as long as the notification.
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

// Limits of one client (docs/metrics.md).
struct ClientLimits {
    std::size_t sessions_per_connection = 16;
    std::size_t sessions_per_address = 64;
    std::size_t streams_per_session = 8;
};

// The answer to a request, and its effect on the connection.
struct Answer {
    std::string document;
    std::optional<Fault> fault;  // set: the document is this fault, and no operation ran
    enum class Turn : std::uint8_t { stays, connected, resumed, disconnected } turn = Turn::stays;
    SessionId session;                 // connected, resumed: the connection's session from now on
    std::uint64_t session_number = 0;  // its number, if it was opened or resumed now
    std::uint64_t last_sequence = 0;   // resumed: its notifications continue after this one
    Hold hold;
};

class Exchange;

// The answer to a request. It may come later, when a component has answered. The gateway must outlive it.
class PendingAnswer {
public:
    PendingAnswer() = default;
    PendingAnswer(std::shared_ptr<Exchange> exchange, Hold hold) : exchange_{std::move(exchange)}, hold_{std::move(hold)} {}

    bool has_come() const;
    // Returns whether the operation may change the session of the connection: connect, resume, disconnect.
    bool is_about_session() const;
    bool is_disconnect() const;
    // The answer is not sent at once.
    void delay() { hold_.delay(); }
    // Call it once, when the answer has come.
    Answer take();

private:
    std::shared_ptr<Exchange> exchange_;
    Hold hold_;
};

class Gateway {
public:
    // All must outlive the gateway. `readers` is the engine's outbox. Each tick measures the memory. Without `tokens` clients
    // need none.
    Gateway(Engine&, Readers& readers, Telemetry&, ClientLimits = {}, MemoryBudget& = MemoryBudget::none(),
            Tokens* tokens = nullptr);
    ~Gateway();
    Gateway(Gateway const&) = delete;
    Gateway& operator=(Gateway const&) = delete;

    // Reads the request and performs its operation for the session (an empty id: none yet). Locks the engine only for the
    // operation. If the answer comes later, `waits` is woken then. `client` counts its sessions, and its principal limits what it
    // may do; null: no limits. `reading` is an open reading of the session, if there is one: it saves a search.
    PendingAnswer answer(xml::RequestReader&, SessionId const&, std::string_view text, Via, std::weak_ptr<Waker> waits,
                         std::shared_ptr<Client> const& client = nullptr, Reading const* reading = nullptr);

    // Starts to read behind the sequence `after`. Returns a fault if the session is unknown or has other rights, if `after` is
    // above its last sequence, or if it has too many event streams.
    std::variant<std::unique_ptr<Reading>, Fault> read(SessionId const&, Rights const*, LinkKind, std::uint64_t after, Reader&,
                                                       Readers::Until = Readers::Until::closed);

    // From now on, uses these limits, and those of the engine (Engine::use).
    void use(ClientLimits, EngineSettings const&);

    // Null: clients need no token.
    Tokens* tokens() const { return tokens_; }

    // Sets where clients' actions are noted. Call it before the first request.
    void audit_to(Audit);
    // Notes that a client was refused before an operation was performed.
    void note_refusal(Client const&, std::string_view operation, FaultCode) const;

    // Halts all components and starts the engine's clock. Call it once, before the first request.
    void begin();

    // Runs the engine's due work. Call it every few milliseconds. Throws the first error, after all other work was done.
    void tick();

    // Waits until a component has reported something, at most until `until`. Returns whether one has. For the engine's clock.
    bool await_reports(Steady until);
    // Lets the engine handle what components have reported.
    void handle_reports();

    // After a restart (Engine::earlier_session). `then` is called when the session is stored, or at once without a journal: with
    // the gateway locked, on any thread.
    Engine::EarlierSession earlier_session(std::string const& provider) const;
    void session_opened_there(std::string const& provider, SessionId const&, std::function<void()> then);
    void stopped_there(std::string const& provider, std::optional<std::uint64_t> stop);
    void ended_there(std::string const& provider, std::vector<CommandEnded>);

    // Called by the journal: the engine's changes were stored, or could not be.
    void stored(bool all);

    // Halts every component before the process ends in an emergency. Gives up if the engine stays locked for a second.
    void halt_at_last() noexcept;

    // Adds and removes components. Throws the exceptions of the engine.
    std::vector<std::string> change(ComponentChange);

    // Stop for everything (decision 34), and its end. Return the state afterwards.
    StopState stop_everything(Client const* asked_by = nullptr);
    StopState clear(Client const* asked_by = nullptr);
    bool everything_is_stopped() const;
    std::vector<std::string> not_halted() const;
    std::vector<std::string> not_ready() const;

    // Ends all sessions and refuses all later requests.
    void shut_down();
    MemoryBudget& memory() { return memory_; }
    bool shutting_down() const { return shutting_down_; }

    // What a client with these rights sees; null: everything.
    std::shared_ptr<EngineProfile const> profile(Rights const* = nullptr) const;
    std::vector<ComponentEntry> components(Rights const* = nullptr) const;
    EngineStatistics statistics(Rights const* = nullptr) const;  // of sessions only for those who may see everything
    // Those of the sub engines with a component that the client sees.
    std::vector<EngineState> seen_of(std::vector<EngineState> sub_engines, Rights const*) const;

private:
    friend class Exchange;
    friend class Farewell;
    friend class Hold;
    friend class Reading;

    // Locks the engine. Its end wakes the readers that were notified meanwhile.
    class Lock : public std::unique_lock<std::mutex> {
    public:
        explicit Lock(Gateway& gateway) : unique_lock{gateway.mutex_}, engine_{gateway.engine_} {}
        ~Lock() { engine_.flush(); }
        Lock(Lock const&) = delete;
        Lock& operator=(Lock const&) = delete;

    private:
        Engine& engine_;
    };

    void show_limits(ClientLimits const&);
    void await_journal(Lock&);
    PendingAnswer perform(SessionId const&, Request&&, Via, std::weak_ptr<Waker> waits, std::shared_ptr<Client> const&,
                          Reading const*, Instant now);
    PendingAnswer refused(Fault);
    std::optional<Fault> refusal_of(Client const&);
    void note_foreign(SessionId const&, Rights const*, std::string_view operation) const;
    void session_restored(std::uint64_t session, Rights const*);
    Fault fault_of(Refusal);
    MemoryBudget::Room room_for(std::string_view text);
    void save_memory(Steady now);

    class Alarm {
    public:
        void ring();
        bool wait_until(Steady);

    private:
        std::mutex mutex_;
        std::condition_variable rung_;
        bool rings_ = false;
    };

    Engine& engine_;
    Readers& readers_;
    Telemetry& telemetry_;
    MemoryBudget& memory_;
    Tokens* const tokens_;
    Alarm alarm_;               // a component has reported something
    Steady memory_released_;    // when memory was last returned to the system; used only by tick()
    mutable std::mutex mutex_;  // guards the engine, the readers and the quota
    SessionQuota quota_;
    std::size_t streams_per_session_;
    EngineLog log_;
    Audit audit_ = [](AuditEntry const&) {};
    std::condition_variable journal_done_;
    std::atomic<bool> shutting_down_ = false;
};

// Joins the readers of an ended session, to see when the others have taken the remaining notifications.
class Farewell {
public:
    Farewell(Gateway&, SessionId, Reader&);
    ~Farewell();
    Farewell(Farewell const&) = delete;
    Farewell& operator=(Farewell const&) = delete;

    // Whether all other readers have left. The reader is woken when one leaves.
    bool alone() const;

private:
    Gateway& gateway_;
    SessionId session_;
    Reader& reader_;
};

}  // namespace rois
