// A media server on a free port, and its receivers.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "kit/received_media.hpp"
#include "media/server.hpp"

namespace rois::media {

using namespace kit;

class Stage {
public:
    explicit Stage(Settings settings = {})
        : server{std::move(settings), [n = 0]() mutable { return "stream-" + std::to_string(++n); }} {}

    Server server;
};

// Waits for the outlet's next change of reception.
inline Reception next_reception(Outlet& outlet) {
    auto const end = std::chrono::steady_clock::now() + std::chrono::seconds{20};
    while (std::chrono::steady_clock::now() < end) {
        if (auto const changes = outlet.receptions(); !changes.empty()) {
            EXPECT_EQ(changes.size(), 1u);
            return changes.back();
        }
        std::this_thread::yield();
    }
    throw std::runtime_error{"no change of reception within 20 s"};
}

// A picture of one colour.
inline Picture plain(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    Picture picture{.width = 32, .height = 16, .rgb = {}};
    for (int i = 0; i < 32 * 16; ++i) picture.rgb.insert(picture.rgb.end(), {red, green, blue});
    return picture;
}

// The dominant colour of a picture: 'r', 'g' or 'b'.
inline char colour_of(std::string const& jpeg) {
    auto const pixel = decoded_jpeg(jpeg).at(16, 8);
    if (pixel[0] > 200) return 'r';
    return pixel[1] > 200 ? 'g' : 'b';
}

// A film in a settable colour.
struct Screen {
    std::atomic<char> colour{'r'};

    Film film(Film::Form form) {
        return {.draw = [this]() -> std::optional<Picture> {
                    char const shown = colour;
                    if (shown == '-') return {};
                    return plain(shown == 'r' ? 255 : 0, shown == 'g' ? 255 : 0, shown == 'b' ? 255 : 0);
                },
                .frames_per_second = 25,
                .form = form};
    }
};

}  // namespace rois::media
