// The streaming components of RoIS 2.0: the media server serves the streams that the messages announce.
#include "kit/received_media.hpp"
#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::AllOf;
using testing::StartsWith;

std::string one(Values const& values, std::string const& name) {
    auto const found = values.find(name);
    return found == values.end() || found->second.size() != 1 ? "none" : found->second.front();
}

struct Agreed {
    std::string id, encoding, transport;
};

// Connects a stream and returns its address.
std::string address_of_stream(Application& guest, std::string const& component) {
    guest.bind(component);
    auto const command = command_ids(guest.execute(Command{.component = component, .type = "connect_stream"})).front();
    EXPECT_EQ(guest.status_of(command), "OK");
    return one(guest.get_command_result(command).values(), "transport_parameters");
}

// An empty hall whose robot streams.
GatewayProcess& streaming_hall() {
    static GatewayProcess hall{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--media", "127.0.0.1:0"}};
    return hall;
}

class Streaming : public testing::TestWithParam<Transport> {
protected:
    Streaming() { desk.connect(); }

    Application desk{GetParam(), streaming_hall()};

    void set(std::string const& component, std::string const& encoding, std::string const& transport) {
        auto const answer = desk.set_parameter(
            component, {{"encoding_parameters", "string", {encoding}}, {"transport_parameters", "string", {transport}}});
        ASSERT_THAT(answer, IsOk());
        EXPECT_EQ(desk.status_of(answer.text("command_id")), "OK");
    }

    Agreed connect(std::string const& component) {
        auto const answer = desk.execute(Command{.component = component, .type = "connect_stream"});
        EXPECT_THAT(answer, IsOk());
        auto const command = command_ids(answer).front();
        EXPECT_EQ(desk.status_of(command), "OK");
        auto const results = desk.get_command_result(command).values();
        return {one(results, "stream_id"), one(results, "encoding_parameters"), one(results, "transport_parameters")};
    }

    Document order(std::string const& component, std::string const& type, std::string const& stream) {
        return desk.execute(Command{.component = component, .type = type, .arguments = {{"stream_id", "string", {stream}}}});
    }

    // Returns the status with which a command about a stream completes.
    std::string outcome(std::string const& component, std::string const& type, std::string const& stream) {
        return desk.status_of(command_ids(order(component, type, stream)).front());
    }

    std::string status(std::string const& stream) {
        return one(desk.query("get_stream_status", where(equal("stream_id", stream))).values(), "status");
    }

    // Waits for a notification of this status of the stream. Begins after the last one that it read.
    void await_status(Agreed const& stream, std::string const& expected) {
        while (true) {
            if (read_ == desk.history().size()) desk.receive();
            auto const values = desk.history()[read_++].values();
            if (one(values, "stream_id") == stream.id && one(values, "status") == expected) return;
        }
    }

    void listen(std::string const& component) {
        ASSERT_THAT(desk.bind(component), IsOk());
        ASSERT_THAT(desk.subscribe("notify_stream_status", where(equal("component_ref", component)), true), IsOk());
    }

private:
    std::size_t read_ = 0;  // number of notifications of the desk's history that were read
};

ROIS_OVER_BOTH_WAYS(Streaming);

TEST_P(Streaming, SoundIsServedByHttp) {
    listen("audio_streaming");
    set("audio_streaming", "audio/wav;rate=8000", "http");
    auto const stream = connect("audio_streaming");
    EXPECT_EQ(stream.encoding, "audio/wav;rate=8000;channels=1");
    await_status(stream, "STREAMING_NOT_RUNNING");
    EXPECT_EQ(status(stream.id), "STREAMING_NOT_RUNNING");
    MediaReceiver receiving{stream.transport};
    EXPECT_THAT(receiving.head(), AllOf(StartsWith("HTTP/1.1 200 "), HasSubstr("Content-Type: audio/wav")));
    receiving.line().take(44);
    EXPECT_GT(share_of(440, samples_of(receiving.line().take(3'200), ByteOrder::little_endian), 8'000), 0.999);
    await_status(stream, "STREAMING_RUNNING");
    EXPECT_EQ(status(stream.id), "STREAMING_RUNNING");
    EXPECT_EQ(outcome("audio_streaming", "suspend_stream", stream.id), "OK");
    await_status(stream, "STREAMING_SUSPENDED");
    EXPECT_EQ(status(stream.id), "STREAMING_SUSPENDED");
    EXPECT_EQ(outcome("audio_streaming", "resume_stream", stream.id), "OK");
    await_status(stream, "STREAMING_RESUMED");
    EXPECT_EQ(status(stream.id), "STREAMING_RESUMED");
    EXPECT_GT(share_of(440, samples_of(receiving.line().take(3'200), ByteOrder::little_endian), 8'000), 0.999);
    EXPECT_EQ(outcome("audio_streaming", "disconnect_stream", stream.id), "OK");
    receiving.line().rest();
    await_status(stream, "STREAMING_NOT_CONNECTED");
    EXPECT_EQ(status(stream.id), "STREAMING_NOT_CONNECTED");
    EXPECT_THAT(MediaReceiver{stream.transport}.head(), StartsWith("HTTP/1.1 404 "));
}

TEST_P(Streaming, SoundHasThePitchOfTheVoiceThatSpeaks) {
    listen("audio_streaming");
    desk.bind("speech_synthesis");
    set("audio_streaming", "audio/wav;rate=8000", "http");
    auto const stream = connect("audio_streaming");
    MediaReceiver receiving{stream.transport};
    receiving.line().take(44);
    auto const is_audible = [&](double pitch) {
        for (int piece = 0; piece < 100; ++piece)
            if (share_of(pitch, samples_of(receiving.line().take(3'200), ByteOrder::little_endian), 8'000) > 0.999) return true;
        return false;
    };
    for (auto const& [character, pitch] : {std::pair{"child", 300.0}, {"robot", 90.0}}) {
        desk.execute(
            Command{.component = "speech_synthesis",
                    .id = std::string{"as "} + character,
                    .arguments = {{"character", "string", {character}}, {"speech_text", "string", {std::string(600, 'a')}}}});
        EXPECT_TRUE(is_audible(pitch)) << character;
    }
    desk.execute(Command{.component = "speech_synthesis", .type = "stop"});
    EXPECT_TRUE(is_audible(440)) << "the robot is silent";
}

TEST_P(Streaming, SoundIsSentByRtp) {
    listen("audio_streaming");
    Mailbox mailbox;
    set("audio_streaming", "audio/L16;rate=16000", "rtp://127.0.0.1:" + std::to_string(mailbox.port()));
    auto const stream = connect("audio_streaming");
    EXPECT_EQ(stream.encoding, "audio/L16;rate=16000;channels=1");
    RtpPacket packet{mailbox.take()};
    EXPECT_THAT(stream.transport, StartsWith("rtp://127.0.0.1:" + std::to_string(mailbox.port()) + ";payload_type=96;"));
    EXPECT_THAT(stream.transport, testing::EndsWith(";ssrc=" + std::to_string(packet.ssrc)));
    auto sound = packet.payload;
    for (int i = 1; i < 10; ++i) {
        RtpPacket const next{mailbox.take()};
        EXPECT_EQ(next.sequence, static_cast<std::uint16_t>(packet.sequence + 1));
        EXPECT_EQ(next.timestamp, packet.timestamp + 320);
        packet = next;
        sound += next.payload;
    }
    EXPECT_GT(share_of(440, samples_of(sound, ByteOrder::big_endian), 16'000), 0.999);
    await_status(stream, "STREAMING_RUNNING");
    set("audio_streaming", "", "");
}

TEST_P(Streaming, TheHallIsSeenFromAbove) {
    listen("video_streaming");
    set("video_streaming", "multipart/x-mixed-replace;size=1000;framerate=25", "");
    auto const stream = connect("video_streaming");
    MediaReceiver receiving{stream.transport};
    EXPECT_THAT(receiving.head(), HasSubstr("Content-Type: multipart/x-mixed-replace;boundary=picture"));
    receiving.next_picture();
    auto const picture = decoded_jpeg(receiving.next_picture());
    ASSERT_EQ(picture.width, 1'000u);
    ASSERT_EQ(picture.height, 600u);
    std::string const robot =
        desk.query("robot_position").root().child("results").child("located").child("position").text().get();
    double x = 0, y = 0;
    ASSERT_EQ(std::sscanf(robot.c_str(), "%lf %lf", &x, &y), 2);
    auto const [red, green, blue] = picture.at(static_cast<int>(x / 20), 599 - static_cast<int>(y / 20));
    EXPECT_GT(green, red + 50) << "the robot is where it says that it is";
    EXPECT_GT(green, blue + 30);
    await_status(stream, "STREAMING_RUNNING");
    set("video_streaming", "", "");
}

TEST_P(Streaming, EndsWithTheBinding) {
    listen("audio_streaming");
    auto const stream = connect("audio_streaming");
    MediaReceiver receiving{stream.transport};
    EXPECT_THAT(desk.release("audio_streaming"), IsOk());
    receiving.line().rest();
    await_status(stream, "STREAMING_NOT_CONNECTED");
}

TEST_P(Streaming, EndsWithTheSession) {
    std::optional<MediaReceiver> receiving;
    {
        Application guest{GetParam(), streaming_hall()};
        guest.connect();
        receiving.emplace(address_of_stream(guest, "video_streaming"));
        receiving->next_picture();
    }
    receiving->line().rest();
}

TEST(StreamingAddress, IsOfNoUseAfterItsSessionAlsoIfCommandsContinue) {
    GatewayProcess const gateway{{"--media", "127.0.0.1:0", "--on-session-end", "continue"}};
    Application desk{Transport::http, gateway};
    desk.connect();
    auto const address = address_of_stream(desk, "video_streaming");
    MediaReceiver receiving{address};
    receiving.next_picture();
    EXPECT_THAT(desk.disconnect(), IsOk());
    receiving.line().rest();
    EXPECT_THAT(MediaReceiver{address}.head(), testing::StartsWith("HTTP/1.1 404 "));
}

TEST(StreamingAddress, IsThePublicAddress) {
    GatewayProcess const gateway{{"--media", "127.0.0.1:0", "--media-url", "https://robots.example/media"}};
    Application desk{Transport::http, gateway};
    desk.connect();
    auto const address = address_of_stream(desk, "video_streaming");
    EXPECT_THAT(address, StartsWith("https://robots.example/media/"));
    EXPECT_GE(address.size(), std::string{"https://robots.example/media/"}.size() + 22) << "128 bits or more";
}

TEST(StreamingTarget, IsOnThisMachineUnlessTheKeyMediaRtpAllowsOthers) {
    for (bool const all : {false, true}) {
        GatewayProcess const gateway{{"--media", "127.0.0.1:0", "--media-rtp", all ? "any" : "loopback"}};
        Application desk{Transport::http, gateway};
        desk.connect();
        desk.bind("audio_streaming");
        auto const answer = desk.set_parameter("audio_streaming", {{"encoding_parameters", "string", {"audio/L16"}},
                                                                   {"transport_parameters", "string", {"rtp://192.0.2.1:5004"}}});
        if (all)
            EXPECT_THAT(answer, IsOk());
        else
            EXPECT_THAT(answer, IsRefused("BAD_PARAMETER", "media_rtp"));
    }
}

// Under a name of their own site that points to this machine (DNS rebinding), or across sites.
TEST_P(Streaming, IsNotForPagesOfOtherSites) {
    ASSERT_THAT(desk.bind("video_streaming"), IsOk());
    set("video_streaming", "image/jpeg", "http");
    MediaUrl const url{connect("video_streaming").transport};
    auto const status = [&](std::string const& target, std::string const& lines) {
        Line line{url.address};
        line.send("GET " + target + " HTTP/1.1\r\n" + lines + "\r\n");
        return line.take_until("\r\n").substr(9, 3);
    };
    for (std::string const host : {"127.0.0.1:8081", "localhost:8081", "[::1]"})
        EXPECT_EQ(status(url.target, "Host: " + host + "\r\n"), "200") << host;
    EXPECT_EQ(status(url.target, "Host: localhost:8081\r\nOrigin: http://localhost:8081\r\n"), "200");
    for (auto const& target : {url.target, std::string{"/nowhere"}}) {
        EXPECT_EQ(status(target, "Host: evil.example\r\n"), "421");
        EXPECT_EQ(status(target, "Host: localhost\r\nOrigin: http://evil.example\r\n"), "403");
        EXPECT_EQ(status(target, "Host: localhost\r\nOrigin: null\r\n"), "403");
        EXPECT_EQ(status(target, "Host: localhost\r\nHost: evil.example\r\n"), "400");
    }
}

TEST(MediaReceiverThatNeverReads, IsCutAfterTheWriteTimeout) {
    GatewayProcess const gateway{{"--media", "127.0.0.1:0", "--write-timeout", "0.2"}};
    Application desk{Transport::http, gateway};
    desk.connect();
    desk.bind("video_streaming");
    desk.set_parameter("video_streaming",
                       {{"encoding_parameters", "string", {"multipart/x-mixed-replace;size=1280;framerate=25"}}});
    MediaReceiver idle{address_of_stream(desk, "video_streaming")};
    desk.subscribe("notify_stream_status", {}, true);
    std::string last;
    while (last != "STREAMING_NOT_RUNNING") last = one(desk.receive().values(), "status");
}

TEST(StreamingAddress, MustBeFree) {
    auto const ended = run_gateway({"--listen", "127.0.0.1:0", "--media", shared_gateway().url().substr(7)});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.error, HasSubstr("cannot serve media on 127.0.0.1:"));
}

}  // namespace
}  // namespace rois::test
