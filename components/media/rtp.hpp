// RTP (RFC 3550) with linear 16 bit sound (RFC 3551, 4.5.11).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "media/asio.hpp"
#include "media/channel.hpp"
#include "media/media.hpp"
#include "media/tone.hpp"

namespace rois::media {

// Parses "rtp://127.0.0.1:5004", "rtp://[::1]:5004" or "rtp://localhost:5004". Returns nothing if the text is invalid.
std::optional<asio::ip::udp::endpoint> rtp_target(std::string_view text);

// Returns 10 for 44.1 kHz stereo, 11 for 44.1 kHz mono (RFC 3551), else the dynamic type 96.
std::uint8_t payload_type(Tone const&);

// The packets of one source.
class RtpPackets {
public:
    struct Beginning {  // random values (RFC 3550, 5.1)
        std::uint32_t ssrc;
        std::uint32_t timestamp;
        std::uint16_t sequence;
    };

    RtpPackets(Tone const&, Beginning);

    // Samples of a packet: 20 ms, but at most 1,400 bytes.
    std::uint32_t samples() const { return samples_; }
    std::chrono::nanoseconds interval() const { return std::chrono::nanoseconds{std::chrono::seconds{samples_}} / tone_.rate; }

    // Returns the next packet. The first packet after silence has the marker bit.
    std::string next();

    // Skips one packet: advances the timestamp, but not the tone.
    void pass();

private:
    Tone tone_;
    std::uint32_t samples_;
    ToneGenerator generator_;
    Beginning now_;
    bool after_silence_ = true;
};

// Sends a channel by RTP. Completes when the channel ends. RTP does not report receivers, so the channel always counts as
// received.
Task<> send_by_rtp(std::shared_ptr<Channel>, Datagrams, asio::ip::udp::endpoint, RtpPackets);

}  // namespace rois::media
