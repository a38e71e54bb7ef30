// Who reads the notifications of a session, and what keeps them behind an answer.
#include <chrono>
#include <utility>

#include "gateway/gateway.hpp"

namespace rois {

namespace {

Instant present() { return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()}; }

}  // namespace

Hold::Hold(Gateway& gateway, std::shared_ptr<NotificationQueue> queue)
    : gateway_{&gateway}, queue_{std::move(queue)}, place_{queue_->hold()} {}

Hold& Hold::operator=(Hold&& other) noexcept {
    release();
    gateway_ = std::exchange(other.gateway_, nullptr);
    queue_ = std::move(other.queue_);
    place_ = other.place_;
    return *this;
}

void Hold::release() {
    auto* const gateway = std::exchange(gateway_, nullptr);
    if (gateway && queue_->release(place_)) notify(*gateway);
}

void Hold::delay() {
    if (gateway_ && queue_->delay(place_)) notify(*gateway_);
}

void Hold::resume() {
    if (gateway_) queue_->resume(place_);
}

void Hold::notify(Gateway& gateway) {
    Gateway::Lock const lock{gateway};
    gateway.engine_.published(*queue_);
}

// Must not fail: neither call allocates.
Reading::~Reading() {
    if (!queue_) return;
    Gateway::Lock const lock{gateway_};
    gateway_.readers_.leave(session(), reader_);
    gateway_.engine_.link_closed(session(), link_, closing_, present());
}

void Reading::note_pong() {
    Gateway::Lock const lock{gateway_};
    gateway_.engine_.note_pong(session(), present());
}

Reading::Then Reading::take(std::size_t most, std::vector<Numbered>& into) {
    auto const before = into.size();
    auto const then = queue_->read(after_, most, into);
    if (into.size() > before) after_ = into.back().sequence;
    return then;
}

Reading::Taken Reading::take(std::size_t most) {
    Taken taken;
    taken.then = take(most, taken.notifications);
    return taken;
}

Farewell::Farewell(Gateway& gateway, SessionId session, Reader& reader)
    : gateway_{gateway}, session_{std::move(session)}, reader_{reader} {
    std::lock_guard const lock{gateway_.mutex_};
    gateway_.readers_.join(session_, reader_);
}

Farewell::~Farewell() {
    std::lock_guard const lock{gateway_.mutex_};
    gateway_.readers_.leave(session_, reader_);
}

bool Farewell::alone() const {
    std::lock_guard const lock{gateway_.mutex_};
    return gateway_.readers_.count(session_) == 1;
}

}  // namespace rois
