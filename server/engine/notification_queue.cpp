#include "engine/notification_queue.hpp"

#include <algorithm>
#include <utility>

namespace rois {

namespace {

Numbered gap_until(std::uint64_t until, std::uint64_t count) {
    return {until, std::make_shared<OutgoingNotification const>(Lost{count})};
}

Lost const* as_lost(Numbered const& entry) { return std::get_if<Lost>(&entry.notification->body); }

// A `Lost` stands for all that it counts: the sequence before the first of them.
std::uint64_t before(Numbered const& entry) {
    auto const* gap = as_lost(entry);
    return entry.sequence - (gap == nullptr ? 1 : gap->count);
}

}  // namespace

NotificationQueue::Pushed NotificationQueue::push(std::shared_ptr<OutgoingNotification const> notification) {
    std::lock_guard const lock{mutex_};
    if (waiting_ >= max_waiting_ && !make_room()) overflowed_ = true;
    if (overflowed_ && std::holds_alternative<ReceiveEvent>(notification->body)) return Pushed::overflow;
    newest_.store(&entries_.emplace_back(++last_sequence_, std::move(notification)), std::memory_order_relaxed);
    ++waiting_;
    return overflowed_ ? Pushed::overflow : Pushed::ok;
}

// Drops the oldest waiting event; a `Lost` takes its place, joined with one that stands right before it.
bool NotificationQueue::make_room() {
    auto const first_waiting = entries_.begin() + static_cast<std::ptrdiff_t>(sent_);
    auto const event = std::find_if(first_waiting, entries_.end(), [](Numbered const& entry) {
        return std::holds_alternative<ReceiveEvent>(entry.notification->body);
    });
    if (event == entries_.end()) return false;
    --waiting_;
    ++lost_;
    if (event != first_waiting) {
        if (auto const* gap = as_lost(*std::prev(event))) {
            *std::prev(event) = gap_until(event->sequence, gap->count + 1);
            entries_.erase(event);
            return true;
        }
    }
    *event = gap_until(event->sequence, 1);
    return true;
}

std::vector<Numbered> NotificationQueue::read(std::uint64_t after, std::size_t most) {
    std::vector<Numbered> entries;
    read(after, most, entries);
    return entries;
}

NotificationQueue::Next NotificationQueue::read(std::uint64_t after, std::size_t most, std::vector<Numbered>& into) {
    std::lock_guard const lock{mutex_};
    auto const until = visible_until();
    auto entry = first_after(after);
    auto const begin = into.size();
    if (entry != entries_.end() && entry->sequence <= until && before(*entry) != after) {
        // The position lies before all that is kept, or inside a gap: what is missing comes first, counted from the position.
        auto const missing_until = as_lost(*entry) == nullptr ? before(*entry) : entry->sequence;
        if (missing_until > after) into.push_back(gap_until(missing_until, missing_until - after));
        if (as_lost(*entry) != nullptr) ++entry;
    }
    for (; entry != entries_.end() && entry->sequence <= until && into.size() - begin < most; ++entry) into.push_back(*entry);
    if (into.size() == begin) return after_locked(after);
    mark_sent(into.back().sequence);
    return after_locked(into.back().sequence);
}

// Most readers go on where the last has stopped: at the first that waits.
std::vector<Numbered>::const_iterator NotificationQueue::first_after(std::uint64_t sequence) const {
    bool const knows_sent = sent_ == 0 || entries_[sent_ - 1].sequence <= sequence;
    auto const begin = entries_.begin() + static_cast<std::ptrdiff_t>(knows_sent ? sent_ : forgotten_);
    return std::upper_bound(begin, entries_.end(), sequence,
                            [](std::uint64_t s, Numbered const& entry) { return s < entry.sequence; });
}

NotificationQueue::Next NotificationQueue::next(std::uint64_t after) const {
    std::lock_guard const lock{mutex_};
    return after_locked(after);
}

NotificationQueue::Next NotificationQueue::after_locked(std::uint64_t sequence) const {
    auto const entry = first_after(sequence);
    if (entry != entries_.end() && entry->sequence <= visible_until()) return Next::more;
    if (!shows_closed()) return Next::wait;
    return overflowed_ ? Next::overflowed : Next::ended;
}

NotificationQueue::Hold NotificationQueue::hold() {
    std::lock_guard const lock{mutex_};
    return holds_.emplace_back(last_sequence_);
}

bool NotificationQueue::release(Hold hold) {
    std::lock_guard const lock{mutex_};
    holds_.erase(std::ranges::lower_bound(holds_, hold));
    return last_sequence_ > hold || shows_closed();
}

void NotificationQueue::close() {
    std::lock_guard const lock{mutex_};
    closed_ = true;
}

std::size_t NotificationQueue::waiting() const {
    std::lock_guard const lock{mutex_};
    return waiting_;
}

bool NotificationQueue::closed() const {
    std::lock_guard const lock{mutex_};
    return shows_closed();
}

void NotificationQueue::mark_sent(std::uint64_t until) {
    for (; sent_ < entries_.size() && entries_[sent_].sequence <= until; ++sent_)
        if (as_lost(entries_[sent_]) == nullptr) --waiting_;
    for (; sent_ - forgotten_ > max_sent_; ++forgotten_) entries_[forgotten_].notification.reset();
    if (forgotten_ * 2 <= entries_.size()) return;
    entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(forgotten_));
    sent_ -= std::exchange(forgotten_, 0);
}

}  // namespace rois
