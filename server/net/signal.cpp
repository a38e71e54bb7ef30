#include "net/signal.hpp"

#include <utility>

namespace rois::net {

void Signal::raise() {
    raised_ = true;
    timer_.cancel();
}

Task<Signal::Woken> Signal::wait_until(Steady until) {
    if (!raised_) {
        boost::system::error_code error;
        timer_.expires_at(until);
        co_await timer_.async_wait(into(error));
    }
    co_return std::exchange(raised_, false) ? Woken::raised : Woken::time_passed;
}

}  // namespace rois::net
