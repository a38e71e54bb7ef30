#include "media/feed.hpp"

#include <utility>

#include "media/tone.hpp"

namespace rois::media {

namespace {

constexpr auto sound_at_once = std::chrono::milliseconds{40};

class SoundFeed final : public Feed {
public:
    explicit SoundFeed(Sound const& sound)
        : sound_{sound},
          generator_{sound.tone, is_wav() ? ToneGenerator::Order::little_endian : ToneGenerator::Order::big_endian} {}

    std::string content_type() const override {
        if (is_wav()) return "audio/wav";
        return "audio/L16;rate=" + std::to_string(sound_.tone.rate) + ";channels=" + std::to_string(sound_.tone.channels);
    }

    Clock::duration interval() const override { return sound_at_once; }

    std::string next(Clock::time_point) override {
        std::string piece;
        if (is_wav() && !std::exchange(begun_, true)) piece = wav_header(sound_.tone);
        return piece += generator_.next(sound_.tone.rate * std::size_t{sound_at_once.count()} / 1'000);
    }

private:
    bool is_wav() const { return sound_.form == Sound::Form::wav; }

    Sound sound_;
    ToneGenerator generator_;
    bool begun_ = false;
};

// Each picture is one part, which replaces the part before.
class FilmFeed final : public Feed {
public:
    explicit FilmFeed(Channel& channel) : channel_{channel} {}

    std::string content_type() const override { return "multipart/x-mixed-replace;boundary=picture"; }

    Clock::duration interval() const override {
        return Clock::duration{std::chrono::seconds{1}} / std::get<Film>(channel_.content()).frames_per_second;
    }

    std::string next(Clock::time_point now) override {
        auto const picture = channel_.picture(now);
        if (!picture) return {};
        return "--picture\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(picture->size()) + "\r\n\r\n" +
               *picture + "\r\n";
    }

private:
    Channel& channel_;
};

}  // namespace

std::unique_ptr<Feed> feed_of(Channel& channel) {
    if (auto const* sound = std::get_if<Sound>(&channel.content())) return std::make_unique<SoundFeed>(*sound);
    return std::make_unique<FilmFeed>(channel);
}

}  // namespace rois::media
