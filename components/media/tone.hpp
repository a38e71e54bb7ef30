// A sine tone as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "media/media.hpp"

namespace rois::media {

// Goes on where it was when it was last asked: what is put together of its pieces has no click.
class ToneGenerator {
public:
    enum class Order : std::uint8_t { little_endian, big_endian };

    ToneGenerator(Tone const& tone, Order order) : tone_{tone}, order_{order} {}

    // The next samples; all channels have the same.
    std::string next(std::size_t samples);

private:
    Tone tone_;
    Order order_;
    std::uint64_t position_ = 0;  // in samples
};

// Of a WAV file that has no end.
std::string wav_header(Tone const&);

}  // namespace rois::media
