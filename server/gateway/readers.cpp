#include "gateway/readers.hpp"

#include <algorithm>
#include <boost/container/small_vector.hpp>

#include "gateway/wakes.hpp"

namespace rois {

// The readers of one session: usually one. Attached to its queue.
struct Readers::Audience {
    struct Joined {
        LinkKind link;
        Reader* reader;
        Until until;
    };
    boost::container::small_vector<Joined, 1> joined;
};

namespace {

void take_out(auto& joined, auto const& matches) {
    joined.erase(std::remove_if(joined.begin(), joined.end(), matches), joined.end());
}

}  // namespace

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

Readers::Audience* Readers::audience_of(NotificationQueue const& queue) {
    return static_cast<Audience*>(queue.attachment().get());
}

// Returns the readers of the session, with room for one more. `known`: those of its queue, if it had readers before.
std::shared_ptr<Readers::Audience> const& Readers::with_room(SessionId const& session, std::shared_ptr<void> const& known) {
    auto found = audiences_.find(session);
    if (found == audiences_.end()) {
        auto audience = known ? std::static_pointer_cast<Audience>(known) : std::make_shared<Audience>();
        found = audiences_.emplace(session, std::move(audience)).first;
    }
    auto& joined = found->second->joined;
    if (joined.size() == joined.capacity()) joined.reserve(2 * joined.size() + 1);
    return found->second;
}

void Readers::join(NotificationQueue& queue, LinkKind link, Reader& reader, Until until) {
    auto const& audience = with_room(queue.session(), queue.attachment());
    auto& joined = audience->joined;
    auto const is_websocket = [](Audience::Joined const& other) { return other.link == LinkKind::websocket; };
    if (link == LinkKind::websocket) {
        for (auto const& other : joined)
            if (is_websocket(other)) other.reader->take_over();
        take_out(joined, is_websocket);
    }
    joined.push_back({link, &reader, until});
    queue.attach(audience);
}

void Readers::join(SessionId const& session, Reader& reader) {
    with_room(session, nullptr)->joined.push_back({LinkKind::stream, &reader, Until::answered});
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
    auto const* const audience = audience_of(queue);
    if (audience == nullptr) return 0;
    auto const is_stream = [](auto const& one) { return one.link == LinkKind::stream && one.until == Until::closed; };
    return static_cast<std::size_t>(std::ranges::count_if(audience->joined, is_stream));
}

void Readers::notify(NotificationQueue& queue) {
    auto const* const audience = audience_of(queue);
    if (audience == nullptr) return;
    for (auto const& one : audience->joined)
        if (one.reader->line_up()) one.reader->wakes_.next_to_wake_ = std::exchange(to_wake_, &one.reader->wakes_);
}

void Readers::flush() noexcept {
    while (auto* const wakes = to_wake_) {
        to_wake_ = wakes->next_to_wake_;
        wakes->request_turn();
    }
}

}  // namespace rois
