#include "media/tone.hpp"

#include <cmath>
#include <numbers>

namespace rois::media {

namespace {

constexpr double amplitude = 16'384;
constexpr std::uint32_t endless = 0xFFFFFFFF;

void append(std::string& bytes, std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
}

}  // namespace

std::string ToneGenerator::next(std::size_t samples) {
    std::string bytes;
    bytes.reserve(samples * 2 * tone_.channels);
    double const turn = (tone_.current_frequency ? tone_.current_frequency() : tone_.frequency) / tone_.rate;
    for (std::size_t i = 0; i < samples; ++i) {
        auto const value = std::lround(amplitude * std::sin(2 * std::numbers::pi * phase_));
        phase_ += turn;
        phase_ -= std::floor(phase_);
        auto const low = static_cast<char>(value & 0xFF), high = static_cast<char>(value >> 8 & 0xFF);
        for (unsigned channel = 0; channel < tone_.channels; ++channel) {
            bytes.push_back(order_ == Order::little_endian ? low : high);
            bytes.push_back(order_ == Order::little_endian ? high : low);
        }
    }
    return bytes;
}

std::string wav_header(Tone const& tone) {
    std::uint32_t const frame = 2u * tone.channels;
    std::string bytes = "RIFF";
    append(bytes, endless, 4);
    bytes += "WAVEfmt ";
    append(bytes, 16, 4);
    append(bytes, 1, 2);  // PCM
    append(bytes, tone.channels, 2);
    append(bytes, tone.rate, 4);
    append(bytes, tone.rate * frame, 4);
    append(bytes, frame, 2);
    append(bytes, 16, 2);
    bytes += "data";
    append(bytes, endless, 4);
    return bytes;
}

}  // namespace rois::media
