// Says which connections of a loop have something to read, or room to write. Belongs to one thread.
#pragma once

#include <sys/epoll.h>

#include <array>
#include <cstdint>
#include <span>

#include "net/asio.hpp"
#include "net/troubles.hpp"

namespace rois::net {

// An epoll of its own beside Asio's, whose sockets try to read before they wait, in vain nearly always: here a request costs one
// receive. Each change is told once (EPOLLET).
class Poller {
public:
    // Somebody who waits for that. Takes part until `remove`.
    class Watcher {
    public:
        virtual void changed(std::uint32_t events) = 0;  // EPOLLIN, ...

    protected:
        ~Watcher() = default;
    };

    // Throws boost::system::system_error when the system gives no epoll.
    Poller(Executor const&, Troubles&);
    Poller(Poller const&) = delete;
    Poller& operator=(Poller const&) = delete;

    // From now on the watcher is told, the first time also of what is there already. False when the system refuses.
    bool add(int descriptor, Watcher&);
    void remove(int descriptor, Watcher&);

    // Now and then: tells what could not be told, and waits again if an exception has ended that.
    void look_after();

private:
    static constexpr std::size_t most_at_once = 64;

    void wait();
    void tell();

    Descriptor epoll_;
    Troubles& troubles_;
    bool waits_ = false;
    std::array<epoll_event, most_at_once> events_{};
    std::span<epoll_event> untold_;
};

}  // namespace rois::net
