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

void Readers::join(SessionId const& session, Link link, Reader& reader) {
    auto& readers = readers_[session];
    if (link == Link::websocket) {
        std::erase_if(readers, [](Joined const& other) {
            if (other.link == Link::websocket) other.reader->take_over();
            return other.link == Link::websocket;
        });
    }
    readers.push_back({link, &reader});
}

void Readers::leave(SessionId const& session, Reader const& reader) {
    auto const found = readers_.find(session);
    if (found == readers_.end()) return;
    std::erase_if(found->second, [&](Joined const& joined) { return joined.reader == &reader; });
    for (auto const& other : found->second) other.reader->wake();
    if (found->second.empty()) readers_.erase(found);
}

std::size_t Readers::count(SessionId const& session) const {
    auto const found = readers_.find(session);
    return found == readers_.end() ? 0 : found->second.size();
}

void Readers::notify(SessionId const& session) {
    auto const found = readers_.find(session);
    if (found == readers_.end()) return;
    for (auto const& joined : found->second) joined.reader->wake();
}

}  // namespace rois::net
