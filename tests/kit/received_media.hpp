// Receives and decodes media.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kit/address.hpp"
#include "kit/line.hpp"

namespace rois::kit {

// A URL like "http://127.0.0.1:8081/abc", as the address and the target of a request.
struct MediaUrl {
    Address address;
    std::string target;

    explicit MediaUrl(std::string const& url);  // throws std::invalid_argument if the URL is invalid
};

// Returns the request "GET /abc HTTP/1.1" with its header.
std::string media_request(MediaUrl const&, std::string const& method = "GET");

// Reads the sound or video at this URL.
class MediaReceiver {
public:
    explicit MediaReceiver(std::string const& url) : url_{url}, line_{url_.address} {
        line_.send(media_request(url_));
        head_ = line_.take_until("\r\n\r\n");
    }

    std::string const& head() const { return head_; }
    Line& line() { return line_; }
    std::string next_picture();  // of a video: a JPEG

private:
    MediaUrl url_;
    Line line_;
    std::string head_;
};

enum class ByteOrder : std::uint8_t { little_endian, big_endian };
std::vector<std::int16_t> samples_of(std::string_view bytes, ByteOrder);

// Returns the share of the sound's energy at this frequency, 0 to 1. Most exact for whole periods.
double share_of(double frequency, std::vector<std::int16_t> const& samples, double rate);

// Three bytes a pixel, row by row from the top left.
struct Bitmap {
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    std::array<int, 3> at(int column, int row) const;
};
Bitmap decoded_jpeg(std::string_view);  // throws std::runtime_error if it is not a JPEG

// A UDP socket on a free port of the loopback.
class Mailbox {
public:
    Mailbox();
    ~Mailbox();
    Mailbox(Mailbox const&) = delete;
    Mailbox& operator=(Mailbox const&) = delete;

    std::uint16_t port() const { return port_; }
    // Returns the next datagram. Throws LineEnded if none arrives.
    std::string take();

private:
    int socket_ = -1;
    std::uint16_t port_ = 0;
};

// RFC 3550, 5.1.
struct RtpPacket {
    unsigned version, payload_type;
    bool marker;
    std::uint16_t sequence;
    std::uint32_t timestamp, ssrc;
    std::string payload;

    explicit RtpPacket(std::string const& datagram);
};

}  // namespace rois::kit
