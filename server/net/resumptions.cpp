#include "net/resumptions.hpp"

#include <boost/asio/post.hpp>
#include <utility>

namespace rois::net {

namespace {

constexpr std::size_t coroutines_of_a_connection = 2;  // one that reads, one that writes

}  // namespace

void Resumptions::enter() {
    auto const wanted = (connections_ + 1) * coroutines_of_a_connection;
    for (auto* const list : {&waiting_, &serving_})
        if (list->capacity() < wanted) list->reserve(2 * wanted);
    ++connections_;
}

void Resumptions::add(Handler handler) noexcept {
    waiting_.push_back(std::move(handler));
    if (!std::exchange(posted_, true)) post();
}

void Resumptions::look_after() noexcept {
    if (!waiting_.empty() && !std::exchange(posted_, true)) post();
}

void Resumptions::post() noexcept {
    try {
        asio::post(executor_, [this] { serve(); });
    } catch (...) {
        posted_ = false;  // `look_after` tries again
    }
}

// A coroutine that is added meanwhile has its turn the next time.
void Resumptions::serve() noexcept {
    posted_ = false;
    std::swap(serving_, waiting_);
    for (auto& each : serving_) {
        auto handler = std::move(each);
        try {
            std::move(handler)();
        } catch (...) {
            troubles_.report(Troubles::Where::connection);
        }
    }
    serving_.clear();
}

}  // namespace rois::net
