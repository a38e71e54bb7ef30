// A connection's socket, with what was received and not yet used. Belongs to one thread.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "net/asio.hpp"
#include "net/telemetry.hpp"
#include "types/instant.hpp"

namespace rois::net {

class Wire {
public:
    Wire(Socket socket, std::chrono::milliseconds write_timeout, Telemetry& telemetry);

    Executor executor() { return socket_.get_executor(); }

    // What was received and not yet used. Good until the next receive.
    std::span<char> received() { return {input_.data() + used_, input_.size() - used_}; }
    std::string_view text() { return {input_.data() + used_, input_.size() - used_}; }
    void use(std::size_t bytes);

    enum class Outcome : std::uint8_t { done, closed, late };

    // Waits for at least one more byte; `expected` says how many are on their way, when that is known.
    Task<Outcome> receive(Steady until, std::size_t expected = 0);
    // Ends a receive that waits: it is late now.
    void stop_waiting();

    // Hands over what the socket takes at once; says how many bytes those were. Errors show at the next send.
    std::size_t send_now(std::string_view);
    // Hands over all; the connection is cut when that takes longer than the write timeout.
    Task<Outcome> send(std::string_view);

    // While nothing is received: calls `gone` when the peer closes. Once it has sent something, nothing is watched any more.
    class Watch;
    Watch watch(std::function<void()> gone);

    // Says that nothing more will be sent.
    void finish();
    // Finishes, and reads away what the peer still sends, so that it can read our last words before the connection ends.
    Task<> linger(Steady until);

    // Cuts what is overdue.
    void sweep(Steady now);
    void cut();

private:
    Socket socket_;
    std::chrono::milliseconds write_timeout_;
    Telemetry& telemetry_;
    std::string input_;
    std::size_t used_ = 0;
    Steady input_due_ = Steady::max();
    Steady output_due_ = Steady::max();
    bool input_late_ = false;
};

// Watches as long as it lives.
class Wire::Watch {
public:
    Watch(Wire& wire, std::shared_ptr<bool> watching) : wire_{wire}, watching_{std::move(watching)} {}
    ~Watch();
    Watch(Watch const&) = delete;
    Watch& operator=(Watch const&) = delete;

private:
    Wire& wire_;
    std::shared_ptr<bool> watching_;  // shared with the handler that waits
};

}  // namespace rois::net
