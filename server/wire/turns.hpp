// Turns of clients that have not shown who they are. So what they cost does not keep other clients of the thread waiting.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <cstdint>
#include <map>
#include <utility>

#include "wire/asio.hpp"

namespace rois::net {

// Belongs to one thread, as its executor. Between two turns, the thread does all other work that is ready.
class Turns {
public:
    explicit Turns(Executor executor) : executor_{std::move(executor)} {}

    // Waits for a turn, with this timer: to cancel it ends the waiting. The addresses have their turns one after the other,
    // however many clients of one address wait.
    Task<> take(asio::ip::address from, Timer&);
    // Call it after an exception has ended the work of the thread.
    void go_on();

private:
    void next();

    using Place = std::pair<asio::ip::address, std::uint64_t>;  // of a waiting client: its address, and its number

    Executor executor_;
    std::map<Place, Timer*> waiting_;
    std::uint64_t last_number_ = 0;
    asio::ip::address last_;  // had the last turn
    bool goes_on_ = false;
};

}  // namespace rois::net
