#include "wire/turns.hpp"

#include <boost/asio/post.hpp>
#include <limits>

namespace rois::net {

Task<> Turns::take(asio::ip::address from, Timer& timer) {
    timer.expires_at(std::chrono::steady_clock::time_point::max());
    Place const place{std::move(from), ++last_number_};
    struct Leaving {
        std::map<Place, Timer*>& waiting;
        Place const& place;
        ~Leaving() { waiting.erase(place); }
    } const leaving{waiting_, place};
    go_on();
    waiting_.emplace(place, &timer);
    boost::system::error_code error;
    co_await timer.async_wait(into(error));
}

void Turns::go_on() {
    if (goes_on_) return;
    asio::post(executor_, [this] { next(); });
    goes_on_ = true;
}

void Turns::next() {
    goes_on_ = false;
    if (waiting_.empty()) return;
    auto first = waiting_.upper_bound({last_, std::numeric_limits<std::uint64_t>::max()});
    if (first == waiting_.end()) first = waiting_.begin();
    last_ = first->first.first;
    first->second->cancel();
    waiting_.erase(first);
    if (!waiting_.empty()) go_on();
}

}  // namespace rois::net
