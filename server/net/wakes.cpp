#include "net/wakes.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <utility>

#include "net/readers.hpp"

namespace rois::net {

namespace {

constexpr std::size_t most_at_once = 32;  // some 200 us of work

}  // namespace

void Wakes::add(std::shared_ptr<Reader> reader) {
    {
        std::lock_guard const lock{mutex_};
        waiting_.push_back(std::move(reader));
        if (std::exchange(posted_, true)) return;
    }
    post();
}

void Wakes::post() {
    asio::post(executor_, [this] { serve(); });
}

void Wakes::serve() {
    auto const end = std::min(served_ + most_at_once, serving_.size());
    while (served_ < end) std::exchange(serving_[served_++], {})->serve();
    if (served_ < serving_.size() || take_more()) post();
}

// False when nobody waits: then the next to come posts.
bool Wakes::take_more() {
    serving_.clear();
    served_ = 0;
    std::lock_guard const lock{mutex_};
    std::swap(serving_, waiting_);
    posted_ = !serving_.empty();
    return posted_;
}

}  // namespace rois::net
