#include "gateway/readers.hpp"

#include <algorithm>
#include <utility>

#include "gateway/wakes.hpp"

namespace rois {

Reader::Reader(Wakes& wakes) : wakes_{wakes} { wakes_.enter(); }

Reader::~Reader() { wakes_.leave(); }

// Returns whether the loop must be woken, too.
bool Reader::line_up() noexcept {
    if (waiting_.exchange(true)) return false;
    auto self = weak_from_this().lock();
    return self && wakes_.add(std::move(self));
}

void Reader::wake() noexcept {
    if (line_up()) wakes_.request_turn();
}

void Reader::take_over() noexcept {
    taken_over_ = true;
    wake();
}

void Reader::serve() {
    waiting_ = false;
    if (taken_over_ && taken_over_.exchange(false)) taken_over();
    woken();
}

// Returns the readers of the session, with room for one more.
std::vector<Readers::Joined>& Readers::with_room(SessionId const& session) {
    auto found = joined_.find(session);
    if (found == joined_.end()) {
        std::vector<Joined> first;
        first.reserve(1);
        found = joined_.emplace(session, std::move(first)).first;
    }
    auto& joined = found->second;
    if (joined.size() == joined.capacity()) joined.reserve(2 * joined.size());
    return joined;
}

void Readers::join(NotificationQueue const& queue, LinkKind link, Reader& reader, Until until) {
    auto& joined = with_room(queue.session());
    auto const is_websocket = [](Joined const& other) { return other.link == LinkKind::websocket; };
    if (link == LinkKind::websocket) {
        for (auto const& other : joined)
            if (is_websocket(other)) other.reader->take_over();
        std::erase_if(joined, is_websocket);
    }
    joined.push_back({link, &reader, until});
}

void Readers::join(SessionId const& session, Reader& reader) {
    with_room(session).push_back({LinkKind::stream, &reader, Until::answered});
}

void Readers::leave(SessionId const& session, Reader const& reader) {
    auto const found = joined_.find(session);
    if (found == joined_.end()) return;
    auto& joined = found->second;
    std::erase_if(joined, [&](Joined const& one) { return one.reader == &reader; });
    for (auto const& other : joined) other.reader->wake();
    if (joined.empty()) joined_.erase(found);
}

std::size_t Readers::count(SessionId const& session) const {
    auto const found = joined_.find(session);
    return found == joined_.end() ? 0 : found->second.size();
}

std::size_t Readers::streams(SessionId const& session) const {
    auto const found = joined_.find(session);
    if (found == joined_.end()) return 0;
    auto const is_stream = [](auto const& one) { return one.link == LinkKind::stream && one.until == Until::closed; };
    return static_cast<std::size_t>(std::ranges::count_if(found->second, is_stream));
}

void Readers::notify(NotificationQueue& queue) {
    auto const found = joined_.find(queue.session());
    if (found == joined_.end()) return;
    for (auto const& one : found->second)
        if (one.reader->line_up()) one.reader->wakes_.next_to_wake_ = std::exchange(to_wake_, &one.reader->wakes_);
}

void Readers::flush() noexcept {
    while (auto* const wakes = to_wake_) {
        to_wake_ = wakes->next_to_wake_;
        wakes->request_turn();
    }
}

}  // namespace rois
