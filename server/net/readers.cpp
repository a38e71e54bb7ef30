#include "net/readers.hpp"

#include <algorithm>

#include "net/wakes.hpp"

namespace rois::net {

void Reader::wake() {
    if (!waiting_.exchange(true)) wakes_.add(shared_from_this());
}

void Reader::take_over() {
    taken_over_ = true;
    wake();
}

void Reader::serve() {
    waiting_ = false;
    if (taken_over_.exchange(false)) taken_over();
    woken();
}

void Readers::join(NotificationQueue& queue, Link link, Reader& reader) {
    auto& audience = audiences_[queue.session()];
    if (!audience) audience = queue.audience() ? queue.audience() : std::make_shared<Audience>();
    if (link == Link::websocket) {
        std::erase_if(audience->joined, [](Audience::Joined const& other) {
            if (other.link == Link::websocket) other.reader->take_over();
            return other.link == Link::websocket;
        });
    }
    audience->joined.push_back({link, &reader});
    queue.set_audience(audience);
}

void Readers::join(SessionId const& session, Reader& reader) {
    auto& audience = audiences_[session];
    if (!audience) audience = std::make_shared<Audience>();
    audience->joined.push_back({Link::stream, &reader});
}

void Readers::leave(SessionId const& session, Reader const& reader) {
    auto const found = audiences_.find(session);
    if (found == audiences_.end()) return;
    auto& joined = found->second->joined;
    std::erase_if(joined, [&](Audience::Joined const& one) { return one.reader == &reader; });
    for (auto const& other : joined) other.reader->wake();
    if (joined.empty()) audiences_.erase(found);
}

std::size_t Readers::count(SessionId const& session) const {
    auto const found = audiences_.find(session);
    return found == audiences_.end() ? 0 : found->second->joined.size();
}

void Readers::notify(NotificationQueue& queue) {
    if (!queue.audience()) return;
    for (auto const& joined : queue.audience()->joined) joined.reader->wake();
}

}  // namespace rois::net
