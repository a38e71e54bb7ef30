#include "media/rtp.hpp"

#include <gmock/gmock.h>

#include "media/stage.hpp"

namespace rois::media {
namespace {

using testing::HasSubstr;
using testing::Optional;

std::string target(Mailbox const& mailbox) { return "rtp://127.0.0.1:" + std::to_string(mailbox.port()); }

TEST(Rtp, ATargetIsAnAddressAndAPort) {
    auto const read = [](std::string_view text) {
        auto const found = rtp_target(text);
        return found ? found->address().to_string() + " " + std::to_string(found->port()) : "none";
    };
    EXPECT_EQ(read("rtp://127.0.0.1:5004"), "127.0.0.1 5004");
    EXPECT_EQ(read("rtp://localhost:1"), "127.0.0.1 1");
    EXPECT_EQ(read("rtp://[::1]:65535"), "::1 65535");
    for (auto const* text :
         {"", "rtp", "rtp://", "rtp://127.0.0.1", "rtp://127.0.0.1:", "rtp://127.0.0.1:0", "rtp://127.0.0.1:65536", "rtp://:5004",
          "rtp://127.0.0.1:5004/", "rtp://127.0.0.1:+1", "rtp://robot.example:5004", "rtp://::1:5004", "rtp://[127.0.0.1]:5004",
          "rtp://0.0.0.0:5004", "rtp://[::]:5004", "http://127.0.0.1:5004", "RTP 127.0.0.1:5004"})
        EXPECT_EQ(read(text), "none") << text;
}

TEST(Rtp, PacketsAreNumberedAndTimed) {
    RtpPackets packets{{.rate = 16'000}, {.ssrc = 0xDEADBEEF, .timestamp = 0xFFFFFF00, .sequence = 0xFFFF}};
    RtpPacket const first{packets.next()}, second{packets.next()};
    packets.pass();
    RtpPacket const third{packets.next()}, fourth{packets.next()};
    EXPECT_EQ(first.version, 2u);
    EXPECT_EQ(first.payload_type, 96u);
    EXPECT_EQ(first.ssrc, 0xDEADBEEF);
    EXPECT_EQ(first.timestamp, 0xFFFFFF00);
    EXPECT_EQ(second.timestamp, 0xFFFFFF00 + 320) << "wraps around";
    EXPECT_EQ(third.timestamp, second.timestamp + 640) << "the timestamp advances in silence";
    EXPECT_EQ(fourth.timestamp, third.timestamp + 320);
    EXPECT_EQ(first.sequence, 0xFFFF);
    EXPECT_EQ(second.sequence, 0);
    EXPECT_EQ(third.sequence, 1);
    EXPECT_TRUE(first.marker && third.marker) << "first packet after silence";
    EXPECT_FALSE(second.marker || fourth.marker);
    EXPECT_EQ(first.payload.size(), 640u);
}

TEST(Rtp, PacketsFitIntoAnyNetwork) {
    for (std::uint32_t const rate : {8'000u, 16'000u, 44'100u, 48'000u})
        for (std::uint16_t const channels : {1, 2}) {
            RtpPackets packets{{.rate = rate, .channels = channels}, {.ssrc = 1, .timestamp = 0, .sequence = 0}};
            RtpPacket const first{packets.next()}, second{packets.next()};
            EXPECT_LE(first.payload.size(), 1'400u);
            EXPECT_EQ(first.payload.size(), second.timestamp * 2u * channels);
            EXPECT_NEAR(static_cast<double>(packets.interval().count()) / 1e9, static_cast<double>(packets.samples()) / rate,
                        1e-8);
        }
}

TEST(Rtp, HasTheStaticPayloadTypes) {
    EXPECT_EQ(payload_type({.rate = 44'100, .channels = 2}), 10);
    EXPECT_EQ(payload_type({.rate = 44'100, .channels = 1}), 11);
    EXPECT_EQ(payload_type({.rate = 48'000, .channels = 2}), 96);
}

TEST(Rtp, IsSentToItsTarget) {
    Stage stage;
    Mailbox mailbox;
    auto const outlet = stage.server.send({}, target(mailbox), Flow::on);
    RtpPacket packet{mailbox.take()};
    EXPECT_EQ(outlet->address(), target(mailbox) + ";payload_type=96;ssrc=" + std::to_string(packet.ssrc));
    EXPECT_TRUE(packet.marker);
    auto sound = packet.payload;
    for (int i = 1; i < 10; ++i) {
        RtpPacket const next{mailbox.take()};
        EXPECT_EQ(next.sequence, static_cast<std::uint16_t>(packet.sequence + 1));
        EXPECT_EQ(next.timestamp, packet.timestamp + 320);
        EXPECT_EQ(next.ssrc, packet.ssrc);
        EXPECT_FALSE(next.marker);
        packet = next;
        sound += next.payload;
    }
    EXPECT_GT(share_of(440, samples_of(sound, ByteOrder::big_endian), 16'000), 0.999);
    EXPECT_EQ(next_reception(*outlet), Reception::begun);
}

TEST(Rtp, IsSilentUntilResumedWhenItStartsHeld) {
    Stage stage;
    Mailbox mailbox, witness;
    auto const outlet = stage.server.send({}, target(mailbox), Flow::held),
               other = stage.server.send({}, target(witness), Flow::on);
    for (int i = 0; i < 5; ++i) witness.take();  // 100 ms
    outlet->go_on();
    RtpPacket const first{mailbox.take()};
    EXPECT_TRUE(first.marker);
    EXPECT_EQ(RtpPacket{mailbox.take()}.timestamp, first.timestamp + 320) << "no packet before";
}

TEST(Rtp, IsSilentWhileItIsHeld) {
    Stage stage;
    Mailbox mailbox, witness;
    auto const outlet = stage.server.send({}, target(mailbox), Flow::on),
               other = stage.server.send({}, target(witness), Flow::on);
    RtpPacket last{mailbox.take()};
    outlet->hold();
    for (int i = 0; i < 10; ++i) witness.take();  // 200 ms
    outlet->go_on();
    // Packets in transit arrive first.
    RtpPacket next{mailbox.take()};
    for (; !next.marker; next = RtpPacket{mailbox.take()}) last = next;
    EXPECT_EQ(next.sequence, static_cast<std::uint16_t>(last.sequence + 1));
    EXPECT_GT(next.timestamp - last.timestamp, 5u * 320u) << "silence counts in the timestamp";
    EXPECT_TRUE(outlet->receptions().size() <= 1);
}

TEST(Rtp, RefusesForeignTargets) {
    Stage stage;
    EXPECT_THAT(stage.server.rtp_refusal("rtp://192.0.2.1:5004"), Optional(HasSubstr("loopback")));
    EXPECT_THAT(stage.server.rtp_refusal("rtp://239.1.2.3:5004"), Optional(HasSubstr("loopback")));
    EXPECT_THAT(stage.server.rtp_refusal("rtp://robot:5004"), Optional(HasSubstr("numeric")));
    EXPECT_EQ(stage.server.rtp_refusal("rtp://[::1]:5004"), std::nullopt);
    EXPECT_THROW(stage.server.send({}, "rtp://192.0.2.1:5004", Flow::on), std::runtime_error);
    Settings open;
    open.rtp_targets = RtpTargets::any;
    EXPECT_EQ(Stage{open}.server.rtp_refusal("rtp://192.0.2.1:5004"), std::nullopt);
}

}  // namespace
}  // namespace rois::media
