// A TCP connection on which a test can say anything, right or wrong.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rois::test {

// The peer closed the connection, or nothing came for far too long.
class LineEnded : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class Line {
public:
    explicit Line(std::uint16_t port, std::string const& address = "127.0.0.1");
    ~Line();
    Line(Line const&) = delete;
    Line& operator=(Line const&) = delete;

    // What the peer does not take any more, because it has closed, is left out.
    void send(std::string_view bytes);
    // As much as goes without waiting; says how much that was.
    std::size_t send_now(std::string_view bytes);
    void finish();  // nothing more will be sent

    // The next bytes, exactly so many. Throws LineEnded.
    std::string take(std::size_t size);
    // Up to and with the mark.
    std::string take_until(std::string_view mark);
    // Whether the peer closes now, without another byte.
    bool ends();
    // Everything until the peer closes.
    std::string rest();

private:
    bool receive();

    int socket_ = -1;
    std::string received_;
};

}  // namespace rois::test
