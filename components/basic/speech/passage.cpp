#include "basic/speech/passage.hpp"

#include <algorithm>

namespace rois::basic {

Seconds spoken_seconds(std::string_view text) {
    constexpr Seconds per_letter = 0.065;    // about 15 letters a second
    constexpr Seconds per_wide_sign = 0.15;  // kana or ideograph: at least three bytes in UTF-8
    Seconds sum = 0;
    for (unsigned char byte : text) {
        if (byte >= 0xe3) {
            sum += per_wide_sign;
        } else if (byte < 0x80 || byte >= 0xc0) {
            sum += per_letter;
        }
    }
    return sum;
}

Seconds speech_duration(std::string_view text) { return std::max(0.5, spoken_seconds(text)); }

}  // namespace rois::basic
