// Events as streams: awaited one by one, or given to a function.
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

// The events of one subscription, results inline, in the order in which they happened, each once. Several streams of one
// connection may hear the same; the engine is subscribed to once for all with the same type and condition. A handle: copies are
// the same stream. With its last handle the stream ends, and with the last stream the subscription. It may outlive its client.
class EventStream {
public:
    EventStream(std::shared_ptr<detail::Core>, std::shared_ptr<detail::Stream>);

    // The next event; nothing when none came `within` this time, or the connection is closed. One at a time.
    Task<std::optional<ReceiveEvent>> next_event(std::optional<std::chrono::milliseconds> within = {});

    // From now on each event, those that wait first, is given to this function on the client's thread, as long as there is a
    // handle; it may still run when the last handle goes. `next_event` is for others then. The function must not throw.
    void each_event(std::function<void(ReceiveEvent const&)>);

    // Throws away what waits.
    void skip();

    // How many gaps lay before the event that was given last: what is told here is all, as long as the number stays.
    std::uint64_t gaps() const;

private:
    std::shared_ptr<detail::Core> core_;
    std::shared_ptr<detail::Stream> stream_;
};

// The same with the type of the event: see components.hpp for those of the specification. An E has its `name` and is made
// `from(ReceiveEvent const&)`.
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

    void each(std::function<void(E const&)> told) {
        stream_.each_event([told = std::move(told)](ReceiveEvent const& event) { told(E::from(event)); });
    }

    void skip() { stream_.skip(); }
    std::uint64_t gaps() const { return stream_.gaps(); }

private:
    EventStream stream_;
};

}  // namespace rois
