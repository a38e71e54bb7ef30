// The readers of one loop that were woken. However many are woken at once, the loop hears one word, and serves them a few at a
// time: a request does not wait behind a thousand notifications. After some more it also lets others have the core.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "net/asio.hpp"
#include "net/troubles.hpp"

namespace rois::net {

class Reader;

// Belongs to a loop, which outlives all of its readers.
class Wakes {
public:
    Wakes(Executor executor, Troubles& troubles) : executor_{std::move(executor)}, troubles_{troubles} {}

    // On the loop's thread, by each reader as it begins and ends: there is room for all of them to wait.
    void enter();
    void leave();

    // From any thread: `Reader::woken` is called on the loop's own.
    void add(std::shared_ptr<Reader>) noexcept;

    // Now and then, on the loop's thread: passes a word again that could not be passed for want of memory.
    void look_after() noexcept;

    Executor const& executor() const { return executor_; }

private:
    void post() noexcept;
    void serve();
    void approach() const;
    bool take_more();
    void make_way();

    Executor executor_;
    Troubles& troubles_;
    std::vector<std::shared_ptr<Reader>> serving_;  // the loop's thread alone
    std::size_t served_ = 0;                        // of these
    std::size_t in_a_row_ = 0;                      // since the loop was done with all of them, or has made way

    std::mutex mutex_;  // guards what follows
    std::vector<std::shared_ptr<Reader>> waiting_;
    std::size_t readers_ = 0;
    bool posted_ = false;  // `serve` will be called
};

}  // namespace rois::net
