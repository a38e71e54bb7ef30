// The queue of woken readers of one event loop. The loop serves a few readers in each turn, so a request does not wait behind a
// thousand notifications. After some more turns it also yields the core.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "gateway/process/troubles.hpp"

namespace rois {

class Reader;

// Belongs to a loop, which outlives all of its readers.
class Wakes {
public:
    // `request_turn` makes the loop call `serve` soon, on its own thread. It must be thread-safe, and may throw.
    Wakes(std::function<void()> request_turn, Troubles& troubles) : request_turn_{std::move(request_turn)}, troubles_{troubles} {}

    // Each reader calls these when it begins and ends, on the loop's thread. They reserve room, so that `add` cannot fail.
    void enter();
    void leave();

    // Thread-safe. The loop's thread will call `Reader::woken`. If `add` returns true, call `request_turn` soon.
    [[nodiscard]] bool add(std::shared_ptr<Reader>) noexcept;
    void request_turn() noexcept;

    // Serves some of the readers, and requests another turn if more wait. Call it on the loop's thread.
    void serve();

    // Requests again a turn that could not be requested because memory was missing. Call it regularly, on the loop's thread.
    void retry_turn() noexcept;

private:
    friend class Readers;

    bool take_more();
    void yield_core();

    std::function<void()> request_turn_;
    Troubles& troubles_;
    std::vector<std::shared_ptr<Reader>> serving_;  // used only by the loop's thread, with the next two
    std::size_t served_ = 0;                        // the first `served_` of these are done
    std::size_t in_a_row_ = 0;                      // served since the queue was empty or the core was yielded

    Wakes* next_to_wake_ = nullptr;  // used only by Readers

    std::mutex mutex_;  // guards the members below
    std::vector<std::shared_ptr<Reader>> waiting_;
    std::size_t readers_ = 0;
    bool posted_ = false;  // a turn is requested, or will be by the caller of `add`
};

}  // namespace rois
