// How long a component may move without a sign of life from its application (decision 33).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "types/instant.hpp"

namespace rois {

// How an application is linked to its session (decision 2): by a WebSocket, or by an event stream or a pending long poll.
enum class LinkKind : std::uint8_t { websocket, stream };

// How a link ended. `answered`: a long poll was answered, which counts as a request of the application. `lost`: the application
// closed the link, or the link broke.
enum class Closing : std::uint8_t { answered, lost };

class MotionLease {
public:
    struct Terms {
        std::chrono::milliseconds linked;  // with a link
        std::chrono::milliseconds http;    // with requests only
        bool links_count = true;           // false: only requests are signs of life, not pongs and open streams
    };

    MotionLease(Terms const& terms, Steady now) : terms_{terms}, last_received_{now}, last_sign_of_life_{now} {}

    Terms const& terms() const { return terms_; }
    void agree(Terms const& terms) { terms_ = terms; }

    void request_received(Steady now) {
        last_received_ = last_sign_of_life_ = now;
        end_after_link_.reset();
    }
    void pong_received(Steady now) {
        last_received_ = now;
        if (terms_.links_count) last_sign_of_life_ = now;
    }
    void opened(LinkKind link, Steady now) {
        ++count(link);
        request_received(now);
    }
    void closed(LinkKind link, Closing closing, Steady now) {
        if (count(link) > 0) --count(link);
        if (closing == Closing::answered && terms_.links_count) request_received(now);
        if (closing == Closing::lost && links() == 0) end_after_link_ = now + for_a_successor;
    }

    // The last request or pong, even if pongs do not count as signs of life.
    Steady last_received() const { return last_received_; }

    std::size_t links() const { return websockets_ + streams_; }

    // The time at which the engine holds the motion, unless it receives a sign of life before. An open stream is a permanent sign
    // of life, because the system detects when the peer is gone; not if the session asked that only its requests count.
    Steady end() const {
        if (streams_ > 0 && terms_.links_count) return Steady::max();
        if (links() > 0) return last_sign_of_life_ + terms_.linked;
        return end_after_link_.value_or(last_sign_of_life_ + terms_.http);
    }

private:
    // How long an application has to open a new link, or send a request, after its last link is lost.
    static constexpr std::chrono::milliseconds for_a_successor{250};

    std::size_t& count(LinkKind link) { return link == LinkKind::websocket ? websockets_ : streams_; }

    Terms terms_;
    Steady last_received_;
    Steady last_sign_of_life_;
    std::size_t websockets_ = 0;
    std::size_t streams_ = 0;
    std::optional<Steady> end_after_link_;  // set when the last link is lost
};

}  // namespace rois
