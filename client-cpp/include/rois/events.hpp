// Streams of events: await them one by one, or pass each to a function.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "rois/connection.hpp"

namespace rois {

namespace detail {
class Stream;
}

// The events of one subscription with their results, in order, each once. Streams of one connection with the same type and
// condition share one subscription. An EventStream is a handle: copies refer to the same stream. The stream ends with its last
// handle, and the subscription with its last stream. It may outlive its client.
class EventStream {
public:
    EventStream(std::shared_ptr<detail::Core>, std::shared_ptr<detail::Stream>);

    // Returns the next event, or nothing if none came `within` this time or the connection is closed. At most one call at a time.
    Task<std::optional<ReceiveEvent>> next_event(std::optional<std::chrono::milliseconds> within = {});

    // Calls this function on the client's thread for each event, the waiting ones first, until the last handle is destroyed. It
    // may still be running when the last handle is destroyed. It must not throw. `next_event` returns no more events then.
    void each_event(std::function<void(ReceiveEvent const&)>);

    // Discards the waiting events.
    void skip();

    // The number of gaps before the latest event. No event was missed as long as the number does not change.
    std::uint64_t gaps() const;

private:
    std::shared_ptr<detail::Core> core_;
    std::shared_ptr<detail::Stream> stream_;
};

// An EventStream with the type of the event. The types of the specification are in components.hpp. An E needs a static `name` and
// a static function `from(ReceiveEvent const&)`.
template <class E>
class Events {
public:
    explicit Events(EventStream stream) : stream_{std::move(stream)} {}

    Task<std::optional<E>> next(std::optional<std::chrono::milliseconds> within = {}) {
        auto stream = stream_;
        auto const event = co_await stream.next_event(within);
        std::optional<E> made;
        if (event) made = E::from(*event);
        co_return made;
    }

    void each(std::function<void(E const&)> handler) {
        stream_.each_event([handler = std::move(handler)](ReceiveEvent const& event) { handler(E::from(event)); });
    }

    void skip() { stream_.skip(); }
    std::uint64_t gaps() const { return stream_.gaps(); }

private:
    EventStream stream_;
};

}  // namespace rois
