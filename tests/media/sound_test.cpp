#include <gmock/gmock.h>

#include "media/stage.hpp"
#include "media/tone.hpp"

namespace rois::media {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Tone, IsASine) {
    for (std::uint32_t const rate : {8'000u, 16'000u, 44'100u, 48'000u}) {
        ToneGenerator generator{{.frequency = 440, .rate = rate}, ToneGenerator::Order::little_endian};
        auto const samples = samples_of(generator.next(rate), ByteOrder::little_endian);
        EXPECT_GT(share_of(440, samples, rate), 0.999) << rate;
        EXPECT_LT(share_of(450, samples, rate), 0.001) << rate;
    }
}

TEST(Tone, ContinuesWithoutAClick) {
    ToneGenerator whole{{}, ToneGenerator::Order::big_endian}, pieces{{}, ToneGenerator::Order::big_endian};
    std::string together;
    for (std::size_t const size : {1u, 7u, 100u, 892u}) together += pieces.next(size);
    EXPECT_EQ(together, whole.next(1'000));
}

TEST(Tone, ChangesItsFrequencyWithoutAClick) {
    double now = 300;
    ToneGenerator generator{{.current_frequency = [&] { return now; }}, ToneGenerator::Order::little_endian};
    auto samples = samples_of(generator.next(16'000), ByteOrder::little_endian);
    EXPECT_GT(share_of(300, samples, 16'000), 0.999);
    int const before = samples.back();
    now = 120;
    samples = samples_of(generator.next(16'000), ByteOrder::little_endian);
    EXPECT_GT(share_of(120, samples, 16'000), 0.999);
    EXPECT_LT(std::abs(samples.front() - before), 2'100) << "at most one step of the sine";
}

TEST(Tone, IsTheSameInAllChannels) {
    ToneGenerator one{{.channels = 1}, ToneGenerator::Order::little_endian};
    ToneGenerator two{{.channels = 2}, ToneGenerator::Order::little_endian};
    auto const mono = samples_of(one.next(50), ByteOrder::little_endian);
    auto const stereo = samples_of(two.next(50), ByteOrder::little_endian);
    ASSERT_EQ(stereo.size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(stereo[i], mono[i / 2]);
}

TEST(Tone, HasAWavHeader) {
    auto const header = wav_header({.rate = 44'100, .channels = 2});
    ASSERT_EQ(header.size(), 44u);
    EXPECT_EQ(header.substr(0, 4) + header.substr(8, 8) + header.substr(36, 4), "RIFFWAVEfmt data");
    EXPECT_EQ(header.substr(20, 16), std::string("\1\0\2\0\x44\xAC\0\0\x10\xB1\2\0\4\0\x10\0", 16));
}

TEST(HttpSound, IsATone) {
    Stage stage;
    auto const outlet = stage.server.serve(Sound{}, Flow::on);
    MediaReceiver receiving{outlet->address()};
    EXPECT_THAT(receiving.head(), StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(receiving.head(), HasSubstr("\r\nContent-Type: audio/wav\r\n"));
    EXPECT_EQ(receiving.line().take(44), wav_header({}));
    auto const samples = samples_of(receiving.line().take(3'200), ByteOrder::little_endian);
    EXPECT_GT(share_of(440, samples, 16'000), 0.999);
}

TEST(HttpSound, IsNetworkOrderAsL16) {
    Stage stage;
    auto const outlet = stage.server.serve(Sound{{.rate = 8'000, .channels = 1}, Sound::Form::l16}, Flow::on);
    MediaReceiver receiving{outlet->address()};
    EXPECT_THAT(receiving.head(), HasSubstr("\r\nContent-Type: audio/L16;rate=8000;channels=1\r\n"));
    EXPECT_GT(share_of(440, samples_of(receiving.line().take(3'200), ByteOrder::big_endian), 8'000), 0.999);
}

TEST(HttpSound, ResumesWhereItWasHeld) {
    Stage stage;
    auto const held = stage.server.serve(Sound{}, Flow::on), other = stage.server.serve(Sound{}, Flow::on);
    MediaReceiver receiving{held->address()}, witness{other->address()};
    receiving.line().take(44);
    auto sound = receiving.line().take(1'280);
    held->hold();
    witness.line().take(44 + 8 * 1'280);  // 320 ms
    held->go_on();
    sound += receiving.line().take(2 * 1'280);
    ToneGenerator expected{{}, ToneGenerator::Order::little_endian};
    EXPECT_EQ(sound, expected.next(3 * 640));
}

}  // namespace
}  // namespace rois::media
