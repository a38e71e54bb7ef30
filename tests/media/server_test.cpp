// The server rejects invalid requests and enforces its limits.
#include "media/server.hpp"

#include <gmock/gmock.h>

#include "media/stage.hpp"

namespace rois::media {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

struct MediaServer : testing::Test {
    std::string answer(std::string const& bytes) const {
        Line line{MediaUrl{stage.server.url() + "/"}.address};
        line.send(bytes);
        return line.rest();
    }

    Stage stage;
};

TEST_F(MediaServer, Answers404ForUnknownPaths) {
    auto outlet = stage.server.serve(Sound{}, Flow::on);
    MediaUrl const url{outlet->address()};
    for (std::string const path : {"/", "/stream-2", "/stream-1/", "/STREAM-1", "//stream-1", "*", "/../stream-1"})
        EXPECT_THAT(answer("GET " + path + " HTTP/1.1\r\nHost: x\r\n\r\n"), StartsWith("HTTP/1.1 404 ")) << path;
    EXPECT_THAT(MediaReceiver{outlet->address() + "?again"}.head(), StartsWith("HTTP/1.1 200 "));
    outlet.reset();
    EXPECT_THAT(answer(media_request(url)), StartsWith("HTTP/1.1 404 "));
}

TEST_F(MediaServer, AcceptsOnlyGetAndHead) {
    auto const outlet = stage.server.serve(Sound{}, Flow::on);
    MediaUrl const url{outlet->address()};
    for (std::string const method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "STRANGE"}) {
        auto const refused = answer(media_request(url, method));
        EXPECT_THAT(refused, StartsWith("HTTP/1.1 405 ")) << method;
        EXPECT_THAT(refused, HasSubstr("\r\nAllow: GET, HEAD\r\n"));
    }
    auto const head = answer(media_request(url, "HEAD"));
    EXPECT_THAT(head, StartsWith("HTTP/1.1 200 OK\r\nContent-Type: audio/wav\r\n"));
    EXPECT_TRUE(head.ends_with("\r\n\r\n"));
    EXPECT_TRUE(answer(media_request(MediaUrl{stage.server.url() + "/none"}, "HEAD")).ends_with("\r\n\r\n"));
    EXPECT_TRUE(outlet->receptions().empty()) << "HEAD does not count as receiving";
}

TEST_F(MediaServer, RefusesInvalidRequests) {
    EXPECT_THAT(answer("hello\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
    EXPECT_THAT(answer("GET / HTTP/9.9\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
    EXPECT_THAT(answer("GET / HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 400 ")) << "without Host";
    auto const with_header = [&](std::size_t bytes) {
        return answer("GET / HTTP/1.1\r\nHost: x\r\nX: " + std::string(bytes, 'x') + "\r\n\r\n");
    };
    EXPECT_THAT(with_header(16'300), StartsWith("HTTP/1.1 404 "));
    EXPECT_THAT(with_header(16'400),
                AllOf(StartsWith("HTTP/1.1 431 "), HasSubstr("the header has more than 16384 bytes (max_header)")));
}

TEST_F(MediaServer, ReportsStartAndEndOfReception) {
    auto const outlet = stage.server.serve(Sound{}, Flow::on);
    EXPECT_TRUE(outlet->receptions().empty());
    {
        MediaReceiver one{outlet->address()};
        EXPECT_EQ(next_reception(*outlet), Reception::begun);
        MediaReceiver two{outlet->address()};
        two.line().take(100);
        EXPECT_TRUE(outlet->receptions().empty()) << "only the first one is reported";
    }
    EXPECT_EQ(next_reception(*outlet), Reception::ended);
    MediaReceiver again{outlet->address()};
    EXPECT_EQ(next_reception(*outlet), Reception::begun);
}

TEST_F(MediaServer, NoticesAReceiverThatLeavesWhileHeld) {
    auto const outlet = stage.server.serve(Sound{}, Flow::on);
    {
        MediaReceiver receiving{outlet->address()};
        EXPECT_EQ(next_reception(*outlet), Reception::begun);
        outlet->hold();
    }
    EXPECT_EQ(next_reception(*outlet), Reception::ended);
}

TEST_F(MediaServer, EndsTheConnectionWithTheOutlet) {
    Screen screen;
    auto sound = stage.server.serve(Sound{}, Flow::on), held = stage.server.serve(Sound{}, Flow::on);
    auto film = stage.server.serve(screen.film(Film::Form::motion_jpeg), Flow::on);
    held->hold();
    MediaReceiver one{sound->address()}, two{film->address()}, three{held->address()};
    one.line().take(100);
    two.next_picture();
    sound.reset();
    film.reset();
    held.reset();
    one.line().rest();
    two.line().rest();
    EXPECT_EQ(three.line().rest(), "");
}

TEST(MediaServerLimits, QueuesConnectionsBeyondTheLimit) {
    Settings settings;
    settings.limits.max_connections = 2;
    Stage stage{settings};
    auto const outlet = stage.server.serve(Sound{}, Flow::on);
    auto one = std::make_unique<MediaReceiver>(outlet->address());
    MediaReceiver two{outlet->address()};
    MediaUrl const url{outlet->address()};
    Line third{url.address};
    third.send(media_request(url));
    two.line().take(20'000);  // some 600 ms
    one.reset();
    EXPECT_THAT(third.take_until("\r\n\r\n"), StartsWith("HTTP/1.1 200 "));
}

TEST(MediaServerLimits, CanChangeWhileItRuns) {
    Settings settings;
    settings.limits.max_connections = 1;
    Stage stage{settings};
    auto const outlet = stage.server.serve(Sound{}, Flow::on);
    MediaReceiver const one{outlet->address()};
    MediaUrl const url{outlet->address()};
    Line second{url.address};
    second.send(media_request(url));
    settings.limits.max_connections = 2;
    settings.limits.request_timeout = std::chrono::milliseconds{100};
    stage.server.use(settings.limits);
    EXPECT_THAT(second.take_until("\r\n\r\n"), StartsWith("HTTP/1.1 200 "));
}

TEST(MediaServerLimits, LimitsTheTimeOfARequest) {
    Settings settings;
    settings.limits.request_timeout = std::chrono::milliseconds{100};
    Stage stage{settings};
    Line line{MediaUrl{stage.server.url() + "/"}.address};
    line.send("GET / HTTP/1.1\r\nHo");
    EXPECT_EQ(line.rest(), "");
}

TEST(MediaServerLimits, DisconnectsAReceiverThatDoesNotRead) {
    Settings settings;
    settings.limits.write_timeout = std::chrono::milliseconds{100};
    Stage stage{settings};
    Picture large{.width = 1'600, .height = 1'200, .rgb = {}};
    std::uint32_t noise = 1;
    for (int i = 0; i < 1'600 * 1'200 * 3; ++i)
        large.rgb.push_back(static_cast<std::uint8_t>((noise = noise * 1'664'525 + 1) >> 24));
    auto const outlet = stage.server.serve(
        Film{.draw = [&] { return std::optional{large}; }, .frames_per_second = 25, .form = Film::Form::motion_jpeg}, Flow::on);
    MediaReceiver idle{outlet->address()};
    EXPECT_EQ(next_reception(*outlet), Reception::begun);
    EXPECT_EQ(next_reception(*outlet), Reception::ended);
}

TEST(MediaServerSettings, SetThePublicUrl) {
    Settings settings;
    settings.url = "https://robots.example/media/";
    EXPECT_EQ(Stage{settings}.server.serve(Sound{}, Flow::on)->address(), "https://robots.example/media/stream-1");
    settings = {};
    settings.host = "0.0.0.0";
    EXPECT_THAT(Stage{settings}.server.url(), StartsWith("http://127.0.0.1:"));
}

TEST(MediaServerSettings, APortInUseIsRefused) {
    Stage stage;
    Settings settings;
    settings.port = MediaUrl{stage.server.url() + "/"}.address.port;
    try {
        Stage second{settings};
        ADD_FAILURE() << "two servers on one port";
    } catch (std::runtime_error const& error) {
        EXPECT_THAT(error.what(), HasSubstr("cannot serve media on 127.0.0.1:" + std::to_string(settings.port)));
    }
}

TEST(MediaServerSettings, OutletsMayOutliveIt) {
    auto stage = std::make_unique<Stage>();
    auto const sound = stage->server.serve(Sound{}, Flow::on);
    Mailbox mailbox;
    auto const sent = stage->server.send({}, "rtp://127.0.0.1:" + std::to_string(mailbox.port()), Flow::on);
    MediaReceiver receiving{sound->address()};
    stage.reset();
    receiving.line().rest();
    sound->hold();
    sent->go_on();
}

}  // namespace
}  // namespace rois::media
