// A TCP connection on which a client can say anything, right or wrong.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <string_view>

#include "client/address.hpp"

namespace rois::client {

// The peer closed the connection, or nothing came for far too long.
class LineEnded : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class Line {
public:
    // Throws LineEnded when nobody takes the connection.
    explicit Line(Address const&);
    ~Line();
    Line(Line const&) = delete;
    Line& operator=(Line const&) = delete;

    // What the peer does not take any more, because it has closed, is left out.
    void send(std::string_view bytes);
    // As much as goes without waiting; says how much that was.
    std::size_t send_now(std::string_view bytes);
    void finish();  // nothing more will be sent

    // How long what comes next is waited for; the address's patience at first.
    void be_patient(std::chrono::milliseconds patience) { patience_ = patience; }

    // The next bytes, exactly so many. Throws LineEnded, also when they do not come in time.
    std::string take(std::size_t size);
    // Up to and with the mark.
    std::string take_until(std::string_view mark);
    // Whether the peer closes now, without another byte.
    bool ends();
    // Everything until the peer closes.
    std::string rest();

private:
    using Clock = std::chrono::steady_clock;

    bool receive(Clock::time_point deadline);
    Clock::time_point deadline() const { return Clock::now() + patience_; }

    int socket_ = -1;
    std::chrono::milliseconds patience_;
    std::string received_;
};

}  // namespace rois::client
