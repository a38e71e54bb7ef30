// A TCP or TLS connection on which a test can send any bytes, valid or not.
#pragma once

#include <openssl/types.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "kit/address.hpp"

namespace rois::kit {

// The peer closed the connection, or sent nothing within the patience.
class LineEnded : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class Line {
public:
    // Connects. Throws LineEnded if no server accepts the connection, or its certificate is not trusted.
    explicit Line(Address const&);
    ~Line();
    Line(Line const&) = delete;
    Line& operator=(Line const&) = delete;

    // Sends all bytes; stops silently if the peer has closed.
    void send(std::string_view bytes);
    // Sends without waiting. Returns the number of bytes sent. Only without TLS.
    std::size_t send_now(std::string_view bytes);
    void finish();  // closes the sending direction

    // Sets the longest wait of the functions below. Default: the patience of the address.
    void set_patience(std::chrono::milliseconds patience) { patience_ = patience; }

    // Returns the next `size` bytes. Throws LineEnded if they do not arrive.
    std::string take(std::size_t size);
    // Returns the bytes up to and including the mark. Throws LineEnded if the mark does not arrive.
    std::string take_until(std::string_view mark);
    // Waits until the peer closes or sends. Returns whether the peer closed without another byte.
    bool ends();
    // Returns all bytes until the peer closes.
    std::string rest();

private:
    using Clock = std::chrono::steady_clock;

    struct Free {
        void operator()(SSL*) const;
    };

    void secure(Address const&);
    bool receive(Clock::time_point deadline);
    Clock::time_point deadline() const { return Clock::now() + patience_; }

    int socket_ = -1;
    std::unique_ptr<SSL, Free> tls_;  // null: no TLS
    std::chrono::milliseconds patience_;
    std::string received_;
};

}  // namespace rois::kit
