// Signs of life: requests that change nothing, while a robot may move for the session and the application is alive.
#include <algorithm>

#include "core.hpp"

namespace rois::detail {

namespace {

// Between two pings, while a robot moves, the gateway lets 0.75 s pass at most.
constexpr std::chrono::milliseconds after_ping{1'500};

// Of a gateway whose lease is not known. Its default is 2 s; a connection may ask for 1 s.
constexpr std::chrono::milliseconds usual_lease{2'000};

}  // namespace

void Core::alive() {
    spoken_for_ = true;
    loop_.post([self = shared_from_this()] { self->give_sign_of_life(); });
}

std::chrono::milliseconds Core::between_signs_of_life() const {
    return std::clamp(settings_.motion_lease.value_or(usual_lease) / 5, std::chrono::milliseconds{50}, usual_lease / 5);
}

void Core::pinged() {
    pinged_at_ = std::chrono::steady_clock::now();
    expect_signs_of_life();
}

// Over HTTP the gateway sends no pings: whatever is bound may move.
bool Core::wants_signs_of_life() const {
    if (!is_open()) return false;
    bool const over_http = settings_.way == Way::http || is_joined();
    bool const may_move = over_http && (!bound_.empty() || sent_raw_);
    return may_move || !watches_.empty() || std::chrono::steady_clock::now() < pinged_at_ + after_ping;
}

// Of an application that lives on this thread: one sign after the other, as long as they are wanted.
void Core::expect_signs_of_life() {
    if (life_ != 0 || spoken_for_ || !wants_signs_of_life()) return;
    life_ = loop_.in(between_signs_of_life(), [this] {
        life_ = 0;
        if (!spoken_for_) give_sign_of_life();
        expect_signs_of_life();
    });
}

// Whatever else was sent just now is a sign as well.
void Core::give_sign_of_life() {
    if (proving_ || !wants_signs_of_life()) return;
    if (std::chrono::steady_clock::now() < said_at_ + between_signs_of_life() / 2) return;
    proving_ = true;
    spawn(prove_life());
}

// `connect` changes nothing in a session that is there. If the engine has ended the session meanwhile, it opens another one.
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
