// A connection's socket, with what was received and not yet used. Belongs to one thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "net/asio.hpp"
#include "net/poller.hpp"
#include "net/resumptions.hpp"
#include "net/telemetry.hpp"
#include "types/instant.hpp"

namespace rois::net {

class Wire final : private Poller::Watcher {
public:
    // The poller and the resumptions are those of the socket's loop, and outlive the wire.
    Wire(Socket, Poller&, Resumptions&, std::chrono::milliseconds write_timeout, Telemetry&);
    ~Wire();
    Wire(Wire const&) = delete;
    Wire& operator=(Wire const&) = delete;

    Executor const& executor() const { return resumptions_.executor(); }

    // The peer's address and port, for the log.
    std::string peer() const;

    // What was received and not yet used. Good until the next receive.
    std::span<char> received() { return {input_.data() + used_, input_.size() - used_}; }
    std::string_view text() { return {input_.data() + used_, input_.size() - used_}; }
    void use(std::size_t bytes);

    enum class Outcome : std::uint8_t { done, closed, late };

    // Receives what is there; `expected` says how many bytes are on their way, when that is known. Nothing: await `readable`,
    // then ask again. Between two of these it receives once: then it is the turn of the loop's other connections, however much is
    // there.
    std::optional<Outcome> receive_now(Steady until, std::size_t expected = 0);
    Task<> readable();
    // Lets the loop's other connections have a turn.
    Task<> next_turn();
    // Ends a receive that waits: it is late now.
    void stop_waiting();

    // Hands over what the socket takes at once; says how many bytes those were. Errors show at the next send.
    std::size_t send_now(std::string_view);
    // Hands over all; the connection is cut when that takes longer than the write timeout.
    Task<Outcome> send(std::string_view);

    // While nothing is received: calls `gone` when the peer closes. Once it has sent something, nothing is watched any more.
    // While `is_proof`, the peer is probed, and has gone when it does not answer for two seconds (decision 33).
    class Watch;
    Watch watch(std::function<void()> gone, std::function<bool(Steady now)> is_proof);

    // Whether something was given to `send` that the peer has not taken.
    bool waits_for_reader() const { return output_due_ != Steady::max(); }

    // Says that nothing more will be sent.
    void finish();
    // Finishes, and reads away what the peer still sends, so that it can read our last words before the connection ends.
    Task<> linger(Steady until);

    // Cuts what is overdue.
    void sweep(Steady now);
    void cut() noexcept;

private:
    // A coroutine that waits.
    using Token = Resumptions::Token;
    using Waiter = std::optional<Resumptions::Handler>;
    static Task<> until_resumed(Waiter&);
    static void resume(Waiter&);
    void resume_later(Waiter&) noexcept;

    void changed(std::uint32_t events) override;
    std::optional<std::size_t> read_some(std::span<char>);
    void look_whether_gone();
    void probe(bool on);

    Poller& poller_;
    Resumptions& resumptions_;
    int socket_;  // -1: cut
    std::chrono::milliseconds write_timeout_;
    Telemetry& telemetry_;
    std::string input_;
    std::size_t used_ = 0;
    Steady input_due_ = Steady::max();
    Steady output_due_ = Steady::max();
    bool input_late_ = false;
    bool readable_ = false;  // nobody has yet read until there was nothing more
    bool received_ = false;  // since `readable` was awaited
    bool ended_ = false;     // the peer has said its last: always readable
    bool failed_ = false;    // nothing can be written any more
    Waiter reader_;
    Waiter writer_;
    std::function<void()> watching_;            // what to call; empty: nobody watches
    std::function<bool(Steady now)> is_proof_;  // beside it
    bool probed_ = false;                       // the system probes the peer now
};

// Watches as long as it lives.
class Wire::Watch {
public:
    explicit Watch(Wire& wire) : wire_{wire} {}
    ~Watch() {
        wire_.watching_ = nullptr;
        wire_.is_proof_ = nullptr;
    }
    Watch(Watch const&) = delete;
    Watch& operator=(Watch const&) = delete;

private:
    Wire& wire_;
};

}  // namespace rois::net
