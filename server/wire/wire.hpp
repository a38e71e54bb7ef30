// The socket of a connection, with its unread input, and with TLS if the port has it. Belongs to one thread. All input and output
// of a connection goes through it.
#pragma once

#include <boost/asio/ssl/stream.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gateway/process/telemetry.hpp"
#include "types/instant.hpp"
#include "types/unique_descriptor.hpp"
#include "wire/asio.hpp"
#include "wire/turns.hpp"

namespace rois::net {

class Wire {
public:
    Wire(Socket, std::chrono::milliseconds write_timeout, Telemetry&);
    Wire(Wire const&) = delete;
    Wire& operator=(Wire const&) = delete;

    Executor executor() { return socket_.get_executor(); }

    // The peer's address and port, for the log.
    std::string peer() const;

    // The received bytes that are not used yet. Valid until the next receive. `use` removes bytes at their front.
    std::span<char> received() { return {input_.data() + used_, input_.size() - used_}; }
    std::string_view text() { return {input_.data() + used_, input_.size() - used_}; }
    void use(std::size_t bytes);

    enum class Outcome : std::uint8_t { done, closed, late };

    // Waits for a turn among the clients that have not shown who they are. Returns false if the connection was cut meanwhile.
    Task<bool> take_turn(Turns&);

    // The opening handshake of TLS, before anything else. Takes a turn for its costly part. Returns `done` also if the peer does
    // not begin it: then `is_secure` is false, and the wire has received something else.
    Task<Outcome> secure(std::shared_ptr<asio::ssl::context>, Steady until, Turns&);
    bool is_secure() const { return tls_ != nullptr; }

    // Waits for input, and reads once. `expected`: the number of bytes that the peer will send, if it is known. Returns `late`
    // after `until`, when `sweep` is called.
    Task<Outcome> receive(Steady until, std::size_t expected = 0);
    // The next `sweep` ends a waiting receive: it returns `late`.
    void stop_waiting() { input_due_ = Steady::min(); }

    // Ends a waiting receive that has an end (`until`). It returns `done` without new input.
    void interrupt();

    // Writes without waiting. Returns the number of written bytes. With TLS that is always 0: only `waits_for_reader` tells,
    // after a while, that the peer does not read. After an error, the next send fails.
    std::size_t send_now(std::string_view);
    // Writes everything. The connection is cut if that takes longer than the write timeout.
    Task<Outcome> send(std::string_view);

    // Calls `closed` when a sweep finds that the peer has closed the connection. While `is_proof` returns true, the system probes
    // the peer: without an answer for two seconds the connection counts as closed (decision 33).
    class Watch {
    public:
        explicit Watch(Wire& wire) : wire_{wire} {}
        ~Watch() { wire_.watching_.reset(); }
        Watch(Watch const&) = delete;
        Watch& operator=(Watch const&) = delete;
        // Returns whether the peer has closed the connection.
        bool gone() const { return wire_.watching_->gone; }

    private:
        Wire& wire_;
    };
    Watch watch(std::function<void()> closed, std::function<bool(Steady now)> is_proof);

    // Returns whether `send` waits for the peer to read, and has done so since then.
    bool waits_for_reader(Steady then = Steady::max()) const {
        return output_due_ != Steady::max() && output_due_ - write_timeout_ <= then;
    }

    // Closes the sending direction.
    void finish();
    // Closes the sending direction, and discards input until `until` or until the peer closes. So the peer can read the last
    // answer.
    Task<> linger(Steady until);

    // Cuts the connection if a write is overdue, ends an overdue receive, and looks whether a watched peer is gone. Call it
    // regularly.
    void sweep(Steady now);
    // Closes the socket.
    void cut();
    // Gives the socket to the caller. Only without TLS.
    UniqueDescriptor release();

private:
    struct Watching {
        std::function<void()> closed;
        std::function<bool(Steady now)> is_proof;
        bool gone = false;
    };

    struct Tls {
        Tls(std::shared_ptr<asio::ssl::context> with, Socket& on) : context{std::move(with)}, stream{on, *context} {}

        std::shared_ptr<asio::ssl::context> context;
        asio::ssl::stream<Socket&> stream;
    };

    Outcome input_ended(boost::system::error_code);
    void check_for_close();
    void probe(bool on);

    Socket socket_;
    std::unique_ptr<Tls> tls_;  // null: no TLS
    std::chrono::milliseconds write_timeout_;
    Telemetry& telemetry_;
    std::string input_;
    std::size_t used_ = 0;
    Steady input_due_ = Steady::max();
    Steady output_due_ = Steady::max();
    bool input_late_ = false;
    bool interrupted_ = false;
    bool probed_ = false;    // the system probes the peer
    Timer* turn_ = nullptr;  // waits for a turn
    std::optional<Watching> watching_;
};

}  // namespace rois::net
