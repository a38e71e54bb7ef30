// Signs of life: requests without effect, sent while a robot may move for the session and the application is alive.
#include <algorithm>

#include "core/core.hpp"

namespace rois::detail {

namespace {

// A robot may move until this long after a ping: while one moves, the gateway sends a ping at least every 0.75 s.
constexpr std::chrono::milliseconds after_ping{1'500};

// The gateway's default lease; its real one is unknown here.
constexpr std::chrono::milliseconds usual_lease{2'000};

}  // namespace

void Core::alive() {
    application_gives_signs_ = true;
    loop_.post([self = shared_from_this()] { self->give_sign_of_life(); });
}

std::chrono::milliseconds Core::between_signs_of_life() const {
    return std::clamp(settings_.motion_lease.value_or(usual_lease) / 5, std::chrono::milliseconds{50}, usual_lease / 5);
}

void Core::pinged() {
    pinged_at_ = std::chrono::steady_clock::now();
    expect_signs_of_life();
}

// Over HTTP the gateway sends no pings: any bound component may move.
bool Core::wants_signs_of_life() const {
    if (!is_open()) return false;
    bool const over_http = settings_.way == Way::http || is_joined();
    bool const may_move = over_http && (!bound_.empty() || sent_raw_);
    return may_move || !watches_.empty() || std::chrono::steady_clock::now() < pinged_at_ + after_ping;
}

// While a robot may move, gives one sign of life after the other, until the application gives signs itself.
void Core::expect_signs_of_life() {
    if (life_ != 0 || application_gives_signs_ || !wants_signs_of_life()) return;
    life_ = loop_.in(between_signs_of_life(), [this] {
        life_ = 0;
        if (!application_gives_signs_) give_sign_of_life();
        expect_signs_of_life();
    });
}

// Sends nothing if another document was sent just now: that document is a sign of life, too.
void Core::give_sign_of_life() {
    if (proving_ || !wants_signs_of_life()) return;
    if (std::chrono::steady_clock::now() < last_sent_at_ + between_signs_of_life() / 2) return;
    proving_ = true;
    spawn(prove_life());
}

// Sends `connect`, which has no effect in an open session. If the engine has ended the session meanwhile, `connect` opens
// another.
Task<> Core::prove_life() {
    auto const self = shared_from_this();
    Request request{Connect{}, {}};
    auto const answer = co_await plain(std::move(request), settings_.deadline);
    proving_ = false;
    auto const* const reply = std::get_if<Reply>(&answer);
    auto const* const connected = reply != nullptr ? std::get_if<Connect::Reply>(reply) : nullptr;
    if (is_open() && connected != nullptr && connected->session != session_) session_gone();
}

}  // namespace rois::detail
