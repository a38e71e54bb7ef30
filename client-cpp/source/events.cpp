#include "rois/events.hpp"

#include "core/core.hpp"

namespace rois {

namespace {

// Returns a pointer that reports to the core when the last handle of the stream is destroyed.
std::shared_ptr<detail::Stream> watched(std::shared_ptr<detail::Core> const& core, std::shared_ptr<detail::Stream> stream) {
    auto* const inside = stream.get();
    return {inside, [weak = std::weak_ptr{core}, kept = std::move(stream)](detail::Stream*) mutable {
                kept.reset();
                if (auto const left = weak.lock()) left->streams_changed();
            }};
}

Task<std::optional<ReceiveEvent>> next_of(std::shared_ptr<detail::Core> core, std::shared_ptr<detail::Stream> stream,
                                          std::optional<std::chrono::milliseconds> within) {
    co_await core->here();
    bool late = false;
    client::Loop::Ticket ticket = 0;
    if (within) {
        ticket = core->loop().in(*within, [&] {
            late = true;
            stream->news.raise();
        });
    }
    auto event = stream->next();
    while (!event && !stream->ended() && !late) {
        co_await stream->news.raised();
        event = stream->next();
    }
    core->loop().cancel(ticket);
    co_return event;
}

}  // namespace

EventStream::EventStream(std::shared_ptr<detail::Core> core, std::shared_ptr<detail::Stream> stream)
    : core_{std::move(core)}, stream_{watched(core_, std::move(stream))} {}

Task<std::optional<ReceiveEvent>> EventStream::next_event(std::optional<std::chrono::milliseconds> within) {
    return next_of(core_, stream_, within);
}

void EventStream::each_event(std::function<void(ReceiveEvent const&)> handler) {
    core_->loop().post([stream = stream_, handler = std::move(handler)]() mutable { stream->deliver_to(std::move(handler)); });
}

void EventStream::skip() {
    if (!core_->loop().post([stream = stream_] { stream->skip(); })) stream_->skip();
}

std::uint64_t EventStream::gaps() const { return stream_->gaps(); }

}  // namespace rois
