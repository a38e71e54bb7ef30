#include "net/poller.hpp"

#include <algorithm>
#include <cerrno>

namespace rois::net {

namespace {

int made_epoll() {
    auto const made = ::epoll_create1(EPOLL_CLOEXEC);
    if (made < 0) throw boost::system::system_error({errno, boost::system::system_category()}, "epoll");
    return made;
}

}  // namespace

Poller::Poller(Executor const& executor, Troubles& troubles) : epoll_{executor, made_epoll()}, troubles_{troubles} {}

bool Poller::add(int descriptor, Watcher& watcher) {
    epoll_event wanted{};
    wanted.events = EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET;
    wanted.data.ptr = &watcher;
    return ::epoll_ctl(epoll_.native_handle(), EPOLL_CTL_ADD, descriptor, &wanted) == 0;
}

void Poller::remove(int descriptor, Watcher& watcher) {
    ::epoll_ctl(epoll_.native_handle(), EPOLL_CTL_DEL, descriptor, nullptr);
    for (auto& event : untold_)
        if (event.data.ptr == &watcher) event.data.ptr = nullptr;
}

void Poller::wait() {
    epoll_.async_wait(Descriptor::wait_read, [this](boost::system::error_code error) {
        waits_ = false;
        if (error) return;
        tell();
        wait();
    });
    waits_ = true;
}

void Poller::look_after() {
    tell();
    if (!waits_) wait();
}

// What is not told this time is told the next.
void Poller::tell() {
    auto const count = ::epoll_wait(epoll_.native_handle(), events_.data(), most_at_once, 0);
    untold_ = std::span{events_}.first(static_cast<std::size_t>(std::max(count, 0)));
    while (!untold_.empty()) {
        auto const event = untold_.front();
        untold_ = untold_.subspan(1);
        auto* const watcher = static_cast<Watcher*>(event.data.ptr);
        if (watcher == nullptr) continue;
        try {
            watcher->changed(event.events);
        } catch (...) {
            troubles_.report(Troubles::Where::connection);
        }
    }
}

}  // namespace rois::net
