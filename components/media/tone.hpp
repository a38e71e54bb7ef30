// Sine tones as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "media/media.hpp"

namespace rois::media {

// Each piece continues the phase of the piece before, so that joined pieces have no click.
class ToneGenerator {
public:
    enum class Order : std::uint8_t { little_endian, big_endian };

    ToneGenerator(Tone tone, Order order) : tone_{std::move(tone)}, order_{order} {}

    // Returns the next samples, the same for all channels.
    std::string next(std::size_t samples);

private:
    Tone tone_;
    Order order_;
    double phase_ = 0;  // of a period, 0 to 1
};

// Returns the header of a WAV file of unlimited length.
std::string wav_header(Tone const&);

}  // namespace rois::media
