#include "gateway/readers.hpp"

#include <algorithm>
#include <boost/container/small_vector.hpp>

#include "engine/notifications/prefetch.hpp"
#include "gateway/wakes.hpp"

// Also found from the session's queue itself, since events go to many sessions at once.
struct rois::Audience {
    struct Joined {
        Link link;
        Reader* reader;
        Readers::Until until;
    };
    boost::container::small_vector<Joined, 1> joined;
};

namespace rois {

namespace {

void take_out(auto& joined, auto those) { joined.erase(std::remove_if(joined.begin(), joined.end(), those), joined.end()); }

}  // namespace

Reader::Reader(Wakes& wakes) : wakes_{wakes} { wakes_.enter(); }

Reader::~Reader() { wakes_.leave(); }

void Reader::wake() noexcept {
    if (waiting_.exchange(true)) return;
    if (auto self = weak_from_this().lock()) wakes_.add(std::move(self));
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

// With room for one more.
std::shared_ptr<Audience> const& Readers::audience_with_room(SessionId const& session, std::shared_ptr<Audience> const& known) {
    auto found = audiences_.find(session);
    if (found == audiences_.end())
        found = audiences_.emplace(session, known != nullptr ? known : std::make_shared<Audience>()).first;
    auto& joined = found->second->joined;
    if (joined.size() == joined.capacity()) joined.reserve(2 * joined.size() + 1);
    return found->second;
}

void Readers::join(NotificationQueue& queue, Link link, Reader& reader, Until until) {
    auto const& audience = audience_with_room(queue.session(), queue.audience());
    if (link == Link::websocket) {
        for (auto const& other : audience->joined)
            if (other.link == Link::websocket) other.reader->take_over();
        take_out(audience->joined, [](Audience::Joined const& other) { return other.link == Link::websocket; });
    }
    audience->joined.push_back({link, &reader, until});
    queue.set_audience(audience);
}

void Readers::join(SessionId const& session, Reader& reader) {
    audience_with_room(session, nullptr)->joined.push_back({Link::stream, &reader, Until::answered});
}

void Readers::leave(SessionId const& session, Reader const& reader) {
    auto const found = audiences_.find(session);
    if (found == audiences_.end()) return;
    auto& joined = found->second->joined;
    take_out(joined, [&](Audience::Joined const& one) { return one.reader == &reader; });
    for (auto const& other : joined) other.reader->wake();
    if (joined.empty()) audiences_.erase(found);
}

std::size_t Readers::count(SessionId const& session) const {
    auto const found = audiences_.find(session);
    return found == audiences_.end() ? 0 : found->second->joined.size();
}

std::size_t Readers::streams(NotificationQueue const& queue) {
    if (!queue.audience()) return 0;
    return static_cast<std::size_t>(std::ranges::count_if(queue.audience()->joined, [](Audience::Joined const& one) {
        return one.link == Link::stream && one.until == Until::closed;
    }));
}

void Readers::notify(NotificationQueue& queue) {
    if (!queue.audience()) return;
    for (auto const& joined : queue.audience()->joined) joined.reader->wake();
}

void Readers::approach(NotificationQueue const& queue) const {
    if (queue.audience() && !queue.audience()->joined.empty()) prefetch(queue.audience()->joined.front().reader);
}

}  // namespace rois
