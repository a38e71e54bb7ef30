#include "media/rtp.hpp"

namespace rois::media {

namespace {

constexpr auto most_behind = Clock::duration{std::chrono::seconds{1}};

}  // namespace

Task<> send_by_rtp(std::shared_ptr<Channel> channel, Datagrams socket, asio::ip::udp::endpoint target, RtpPackets packets) {
    Receiver const receiver{*channel};
    Timer timer{socket.get_executor()};
    for (auto due = Clock::now(); !channel->ended(); due += packets.interval()) {
        boost::system::error_code error;
        timer.expires_at(due);
        co_await timer.async_wait(into(error));
        if (channel->held() || Clock::now() - due > most_behind) {
            packets.pass();
            continue;
        }
        auto const packet = packets.next();
        co_await socket.async_send_to(asio::buffer(packet), target, into(error));
    }
}

}  // namespace rois::media
