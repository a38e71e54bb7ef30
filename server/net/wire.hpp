// A connection's socket, with the bytes that were received and not used yet. Belongs to one thread.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "gateway/telemetry.hpp"
#include "net/asio.hpp"
#include "types/instant.hpp"

namespace rois::net {

class Wire {
public:
    Wire(Socket, std::chrono::milliseconds write_timeout, Telemetry&);
    Wire(Wire const&) = delete;
    Wire& operator=(Wire const&) = delete;

    Executor executor() { return socket_.get_executor(); }

    // The peer's address and port, for the log.
    std::string peer() const;

    // The bytes that were received and not used yet. Valid until the next receive.
    std::span<char> received() { return {input_.data() + used_, input_.size() - used_}; }
    std::string_view text() { return {input_.data() + used_, input_.size() - used_}; }
    void use(std::size_t bytes);

    enum class Outcome : std::uint8_t { done, closed, late };

    // Waits until there is something to read, and reads it once. `expected` is the number of bytes that the peer will send, if it
    // is known. Late after `until`, to the precision of sweep().
    Task<Outcome> receive(Steady until, std::size_t expected = 0);
    // Ends a receive that waits: it is late now.
    void stop_waiting() { input_due_ = Steady::min(); }

    // Writes as much as the socket takes without waiting, and returns how many bytes that was. An error shows in the next send.
    std::size_t send_now(std::string_view);
    // Writes everything. The connection is cut if that takes longer than the write timeout.
    Task<Outcome> send(std::string_view);

    // While nothing is received: calls `gone` when the peer closes the connection. If the peer sends something, watching ends.
    // While `is_proof` returns true, the system probes the peer: without an answer for two seconds it has gone (decision 33).
    class Watch;
    Watch watch(std::function<void()> gone, std::function<bool(Steady now)> is_proof);

    // Whether the peer has not taken everything that was given to send().
    bool waits_for_reader() const { return output_due_ != Steady::max(); }

    // Tells the peer that nothing more will be sent.
    void finish();
    // Finishes, and discards what the peer still sends, so that it can read our last answer before the connection ends.
    Task<> linger(Steady until);

    // Cuts the connection if a write is overdue, and ends an overdue receive. To be called every now and then.
    void sweep(Steady now);
    void cut();

private:
    struct Watching {
        std::function<void()> gone;
        std::function<bool(Steady now)> is_proof;
    };

    void look_whether_gone();
    void probe(bool on);

    Socket socket_;
    std::chrono::milliseconds write_timeout_;
    Telemetry& telemetry_;
    std::string input_;
    std::size_t used_ = 0;
    Steady input_due_ = Steady::max();
    Steady output_due_ = Steady::max();
    bool input_late_ = false;
    bool probed_ = false;                 // the system probes the peer now
    std::shared_ptr<Watching> watching_;  // null: nobody watches
};

// Watches as long as it lives.
class Wire::Watch {
public:
    explicit Watch(Wire& wire) : wire_{wire} {}
    ~Watch();
    Watch(Watch const&) = delete;
    Watch& operator=(Watch const&) = delete;

private:
    Wire& wire_;
};

}  // namespace rois::net
