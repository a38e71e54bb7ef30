// RTP (RFC 3550) with linear 16 bit sound (RFC 3551, 4.5.11).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "media/asio.hpp"
#include "media/media.hpp"
#include "media/tone.hpp"

namespace rois::media {

// Of "rtp://127.0.0.1:5004", "rtp://[::1]:5004", "rtp://localhost:5004"; nothing when the text is no such target.
std::optional<asio::ip::udp::endpoint> rtp_target(std::string_view text);

// 10 and 11 are those of 44.1 kHz with two channels and with one; all others agree on a number beyond RTP.
std::uint8_t payload_type(Tone const&);

// The packets of one source.
class RtpPackets {
public:
    struct Beginning {  // drawn by lot, as RFC 3550 wants it
        std::uint32_t ssrc;
        std::uint32_t timestamp;
        std::uint16_t sequence;
    };

    RtpPackets(Tone const&, Beginning);

    // How much a packet holds: 20 ms, or what fits into 1,400 bytes.
    std::uint32_t samples() const { return samples_; }
    std::chrono::nanoseconds interval() const { return std::chrono::nanoseconds{std::chrono::seconds{samples_}} / tone_.rate; }

    // A packet; the first one after silence is marked.
    std::string next();

    // As much silence instead of a packet: the clock goes on, the tone does not.
    void pass();

private:
    Tone tone_;
    std::uint32_t samples_;
    ToneGenerator generator_;
    Beginning now_;
    bool after_silence_ = true;
};

}  // namespace rois::media
