// A sine tone as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "media/media.hpp"

namespace rois::media {

// Goes on where it was when it was last asked: what is put together of its pieces has no click.
class ToneGenerator {
public:
    enum class Order : std::uint8_t { little_endian, big_endian };

    ToneGenerator(Tone tone, Order order) : tone_{std::move(tone)}, order_{order} {}

    // The next samples; all channels have the same.
    std::string next(std::size_t samples);

private:
    Tone tone_;
    Order order_;
    double phase_ = 0;  // in turns, 0 to 1
};

// Of a WAV file that has no end.
std::string wav_header(Tone const&);

}  // namespace rois::media
