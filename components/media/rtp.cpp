#include "media/rtp.hpp"

#include <algorithm>
#include <charconv>

namespace rois::media {

namespace {

constexpr std::uint8_t version = 0x80;  // 2, without padding, extension and contributing sources
constexpr std::uint8_t marker = 0x80;
constexpr std::uint32_t packets_a_second = 50;
constexpr std::uint32_t most_bytes = 1'400;  // of sound, so that every network passes a packet unfragmented

void append(std::string& bytes, std::uint32_t value, int count) {
    for (int i = count - 1; i >= 0; --i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
}

}  // namespace

std::optional<asio::ip::udp::endpoint> rtp_target(std::string_view text) {
    constexpr std::string_view scheme = "rtp://";
    if (!text.starts_with(scheme)) return {};
    text.remove_prefix(scheme.size());
    auto const colon = text.rfind(':');
    if (colon == text.npos) return {};
    auto host = text.substr(0, colon);
    auto const port_text = text.substr(colon + 1);
    std::uint16_t port = 0;
    auto const [end, bad] = std::from_chars(port_text.data(), port_text.data() + port_text.size(), port);
    if (bad != std::errc{} || end != port_text.data() + port_text.size() || port == 0) return {};
    if (host == "localhost") host = "127.0.0.1";
    bool const bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
    if (bracketed) host = host.substr(1, host.size() - 2);
    if (bracketed != (host.find(':') != host.npos)) return {};
    boost::system::error_code error;
    auto const address = asio::ip::make_address(host, error);
    if (error || address.is_unspecified()) return {};
    return asio::ip::udp::endpoint{address, port};
}

std::uint8_t payload_type(Tone const& tone) {
    if (tone.rate == 44'100 && tone.channels == 2) return 10;
    if (tone.rate == 44'100 && tone.channels == 1) return 11;
    return 96;
}

RtpPackets::RtpPackets(Tone const& tone, Beginning beginning)
    : tone_{tone},
      samples_{std::min(tone.rate / packets_a_second, most_bytes / (2 * tone.channels))},
      generator_{tone, ToneGenerator::Order::big_endian},
      now_{beginning} {}

std::string RtpPackets::next() {
    std::string packet;
    packet.push_back(static_cast<char>(version));
    packet.push_back(static_cast<char>(payload_type(tone_) | (after_silence_ ? marker : 0)));
    append(packet, now_.sequence, 2);
    append(packet, now_.timestamp, 4);
    append(packet, now_.ssrc, 4);
    packet += generator_.next(samples_);
    ++now_.sequence;
    now_.timestamp += samples_;
    after_silence_ = false;
    return packet;
}

void RtpPackets::pass() {
    now_.timestamp += samples_;
    after_silence_ = true;
}

}  // namespace rois::media
