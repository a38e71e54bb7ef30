#include "engine/notifications/notification_queue.hpp"

#include <algorithm>
#include <utility>

namespace rois {

namespace {

Numbered gap_until(std::uint64_t until, std::uint64_t count) {
    return {until, std::make_shared<OutgoingNotification const>(Lost{count})};
}

Lost const* as_lost(Numbered const& entry) { return std::get_if<Lost>(&entry.notification->body); }

// If this is a `Lost`, lets it count one more.
bool join(std::shared_ptr<OutgoingNotification const>& notification) {
    auto const* lost = std::get_if<Lost>(&notification->body);
    if (lost != nullptr) notification = std::make_shared<OutgoingNotification const>(Lost{lost->count + 1});
    return lost != nullptr;
}

// The sequence before this entry; before the first one that it counts, for a `Lost`.
std::uint64_t before(Numbered const& entry) {
    auto const* gap = as_lost(entry);
    return entry.sequence - (gap == nullptr ? 1 : gap->count);
}

}  // namespace

NotificationQueue::Pushed NotificationQueue::push(std::shared_ptr<OutgoingNotification const> notification, Hold cause,
                                                  ForCurrent for_current) {
    std::lock_guard const lock{mutex_};
    bool const is_lost = std::holds_alternative<Lost>(notification->body);
    if (!is_lost && waiting_ >= max_waiting_ && !make_room()) overflowed_ = true;
    if (overflowed_ && (is_lost || std::holds_alternative<ReceiveEvent>(notification->body))) return Pushed::dropped;
    ++(is_lost ? lost_ : waiting_);
    bool const has_cause = for_current == ForCurrent::does_not_wait || is_held(cause);
    auto const hold = has_cause ? cause : current_;
    reserve_for_held(1);
    bool const would_overtake = std::ranges::any_of(held_, [&](Held const& held) { return is_being_sent(held.by); });
    if (is_held(hold) || would_overtake) {
        bool const unless_delayed = !has_cause && for_current == ForCurrent::unless_delayed && is_being_sent(hold);
        if (is_lost && !held_.empty() && held_.back().by == hold && join(held_.back().notification)) return Pushed::held;
        held_.push_back({hold, unless_delayed, std::move(notification)});
        return overflowed_ ? Pushed::overflow : Pushed::held;
    }
    bool const first = shown_ == all ? sent_ == entries_.size() : given_ == last_sequence_;
    ++last_sequence_;
    if (is_lost && sent_ < entries_.size() && join(entries_.back().notification)) {
        entries_.back().sequence = last_sequence_;
        gaps_from_ = std::min(gaps_from_, last_sequence_);
    } else {
        entries_.push_back({last_sequence_, std::move(notification)});
    }
    if (overflowed_) return Pushed::overflow;
    return first ? Pushed::first : Pushed::behind;
}

bool NotificationQueue::is_held(Hold hold) const {
    return hold != 0 && std::ranges::binary_search(holds_, hold, {}, &OpenHold::number);
}

bool NotificationQueue::is_being_sent(Hold hold) const {
    auto const open = std::ranges::lower_bound(holds_, hold, {}, &OpenHold::number);
    return open != holds_.end() && open->number == hold && !open->is_delayed;
}

// Makes room in entries_ for this many more entries and for all held ones.
void NotificationQueue::reserve_for_held(std::size_t more) {
    auto const room = entries_.size() + held_.size() + more;
    if (entries_.capacity() < room) entries_.reserve(2 * room);
}

// Replaces the oldest held event of the oldest hold by a `Lost`, merged with a `Lost` right before it.
bool NotificationQueue::make_room_among_held() {
    auto const event = std::ranges::find_if(
        held_, [](Held const& held) { return std::holds_alternative<ReceiveEvent>(held.notification->body); });
    if (event == held_.end()) return false;
    auto const before = event == held_.begin() ? held_.end() : std::prev(event);
    auto const* gap = before == held_.end() || before->by != event->by ? nullptr : std::get_if<Lost>(&before->notification->body);
    auto lost = std::make_shared<OutgoingNotification const>(Lost{gap == nullptr ? 1 : gap->count + 1});
    --waiting_;
    ++lost_;
    if (gap == nullptr) {
        event->notification = std::move(lost);
    } else {
        before->notification = std::move(lost);
        held_.erase(event);
    }
    return true;
}

// Replaces the oldest waiting event by a `Lost`, merged with a `Lost` right before it. Returns false if there is no waiting
// event.
bool NotificationQueue::make_room() {
    auto const first_waiting = entries_.begin() + static_cast<std::ptrdiff_t>(sent_);
    auto const event = std::find_if(first_waiting, entries_.end(), [](Numbered const& entry) {
        return std::holds_alternative<ReceiveEvent>(entry.notification->body);
    });
    if (event == entries_.end()) return make_room_among_held();
    auto const* const gap_before = event == first_waiting ? nullptr : as_lost(*std::prev(event));
    auto gap = gap_until(event->sequence, gap_before == nullptr ? 1 : gap_before->count + 1);
    gaps_from_ = std::min(gaps_from_, event->sequence);
    --waiting_;
    ++lost_;
    if (gap_before == nullptr) {
        *event = std::move(gap);
    } else {
        *std::prev(event) = std::move(gap);
        entries_.erase(event);
    }
    return true;
}

void NotificationQueue::keep_last(std::size_t events) {
    std::lock_guard const lock{mutex_};
    auto const is_event = [](Numbered const& entry) { return std::holds_alternative<ReceiveEvent>(entry.notification->body); };
    std::size_t dropped = 0;
    auto first_dropped = all;
    auto const first_waiting = entries_.begin() + static_cast<std::ptrdiff_t>(sent_);
    auto const is_read = [this](Numbered const& entry) { return entry.sequence <= read_; };
    auto const first_unread =  // before the waiting ones after a restart only
        std::find_if_not(entries_.begin() + static_cast<std::ptrdiff_t>(forgotten_), first_waiting, is_read);
    std::vector<Numbered> kept;
    kept.reserve(entries_.size() + held_.size());
    kept.insert(kept.end(), first_unread, first_waiting);
    auto const sent = kept.size();
    auto too_many = std::count_if(first_waiting, entries_.end(), is_event) - static_cast<std::ptrdiff_t>(events);
    for (auto entry = first_waiting; entry != entries_.end(); ++entry) {
        auto const* gap = kept.size() == sent ? nullptr : as_lost(kept.back());
        if (too_many <= 0 || !is_event(*entry)) {
            kept.push_back(*entry);
            continue;
        }
        --too_many;
        ++dropped;
        first_dropped = std::min(first_dropped, entry->sequence);
        if (gap != nullptr) {
            kept.back() = gap_until(entry->sequence, gap->count + 1);
        } else {
            kept.push_back(gap_until(entry->sequence, 1));
        }
    }
    // Nothing below throws, so the queue changes as a whole or not at all.
    waiting_ -= dropped;
    lost_ += dropped;
    gaps_from_ = std::min(gaps_from_, first_dropped);
    entries_ = std::move(kept);
    sent_ = sent;
    forgotten_ = 0;
}

std::vector<Numbered> NotificationQueue::read(std::uint64_t after, std::size_t most) {
    std::vector<Numbered> entries;
    read(after, most, entries);
    return entries;
}

NotificationQueue::Next NotificationQueue::read(std::uint64_t after, std::size_t most, std::vector<Numbered>& into) {
    std::lock_guard const lock{mutex_};
    auto entry = first_after(after);
    auto const end = end_of_shown();
    auto const begin = into.size();
    if (entry < end && before(*entry) != after) {
        // The position is before the oldest entry, or inside a gap: begin with a `Lost` that counts from the position.
        auto const missing_until = as_lost(*entry) == nullptr ? before(*entry) : entry->sequence;
        if (missing_until > after) into.push_back(gap_until(missing_until, missing_until - after));
        if (as_lost(*entry) != nullptr) ++entry;
    }
    for (; entry < end && into.size() - begin < most; ++entry) into.push_back(*entry);
    if (into.size() == begin) return after_locked(after);
    mark_sent(into.back().sequence);
    read_ = std::max(read_, into.back().sequence);
    if (read_ > kept_unread_.until) kept_unread_ = {};
    forget();
    return after_locked(into.back().sequence);
}

// Most readers continue where the last read stopped: at the first waiting entry.
std::vector<Numbered>::const_iterator NotificationQueue::first_after(std::uint64_t sequence) const {
    bool const knows_sent = sent_ == 0 || entries_[sent_ - 1].sequence <= sequence;
    auto const begin = entries_.begin() + static_cast<std::ptrdiff_t>(knows_sent ? sent_ : forgotten_);
    return std::upper_bound(begin, entries_.end(), sequence,
                            [](std::uint64_t s, Numbered const& entry) { return s < entry.sequence; });
}

std::vector<Numbered>::const_iterator NotificationQueue::end_of_shown() const {
    if (shown_ == all || last_sequence_ <= shown_) return entries_.end();
    return std::ranges::upper_bound(entries_, shown_, {}, &Numbered::sequence);
}

NotificationQueue::Next NotificationQueue::next(std::uint64_t after) const {
    std::lock_guard const lock{mutex_};
    return after_locked(after);
}

NotificationQueue::Next NotificationQueue::after_locked(std::uint64_t sequence) const {
    if (first_after(sequence) < end_of_shown()) return Next::more;
    if (!shows_closed()) return Next::wait;
    return overflowed_ ? Next::overflowed : Next::ended;
}

NotificationQueue::Hold NotificationQueue::hold() {
    std::lock_guard const lock{mutex_};
    holds_.push_back({last_hold_ + 1});
    return current_ = ++last_hold_;
}

bool NotificationQueue::release(Hold hold) noexcept {
    std::lock_guard const lock{mutex_};
    holds_.erase(std::ranges::lower_bound(holds_, hold, {}, &OpenHold::number));
    return publish() || shows_closed();
}

bool NotificationQueue::delay(Hold hold) noexcept {
    std::lock_guard const lock{mutex_};
    std::ranges::lower_bound(holds_, hold, {}, &OpenHold::number)->is_delayed = true;
    for (auto& held : held_)
        if (held.by == hold && held.unless_delayed) held.by = 0;
    return publish();
}

void NotificationQueue::resume(Hold hold) noexcept {
    std::lock_guard const lock{mutex_};
    std::ranges::lower_bound(holds_, hold, {}, &OpenHold::number)->is_delayed = false;
}

// Numbers the held notifications that wait for nothing any more. Returns whether there are some.
bool NotificationQueue::publish() noexcept {
    auto const before = last_sequence_;
    bool would_overtake = false;
    auto kept = held_.begin();
    for (auto held = held_.begin(); held != held_.end(); ++held) {
        would_overtake = would_overtake || is_being_sent(held->by);
        if (would_overtake || is_held(held->by)) {
            if (kept != held) *kept = std::move(*held);
            ++kept;
            continue;
        }
        auto const* lost = std::get_if<Lost>(&held->notification->body);
        last_sequence_ += lost == nullptr ? 1 : lost->count;
        entries_.push_back({last_sequence_, std::move(held->notification)});
    }
    held_.erase(kept, held_.end());
    return last_sequence_ > before;
}

std::uint64_t NotificationQueue::last_sequence() const {
    std::lock_guard const lock{mutex_};
    return last_sequence_;
}

void NotificationQueue::close() {
    std::lock_guard const lock{mutex_};
    closed_ = true;
    shown_ = all;  // the session does not return after a restart
}

std::size_t NotificationQueue::waiting() const {
    std::lock_guard const lock{mutex_};
    return waiting_;
}

void NotificationQueue::keep_unread() {
    std::lock_guard const lock{mutex_};
    kept_unread_ = {.after = kept_unread_.until == 0 ? read_ : kept_unread_.after, .until = last_sequence_};
}

std::vector<std::shared_ptr<OutgoingNotification const>> NotificationQueue::unread_events() const {
    std::lock_guard const lock{mutex_};
    std::vector<std::shared_ptr<OutgoingNotification const>> events;
    auto const add = [&](auto const& notification) {
        if (std::holds_alternative<ReceiveEvent>(notification->body)) events.push_back(notification);
    };
    for (auto entry = forgotten_; entry < entries_.size(); ++entry) {
        auto const sequence = entries_[entry].sequence;
        bool const is_kept = sequence > kept_unread_.after && sequence <= kept_unread_.until;
        if (entry >= sent_ || is_kept) add(entries_[entry].notification);
    }
    for (auto const& held : held_) add(held.notification);
    return events;
}

void NotificationQueue::show_when_stored() {
    std::lock_guard const lock{mutex_};
    shown_ = given_ = last_sequence_;
}

bool NotificationQueue::shows_when_stored() const {
    std::lock_guard const lock{mutex_};
    return shown_ != all;
}

// The newest one stays stored: after a restart, the next sequence follows it.
NotificationQueue::Unstored NotificationQueue::unstored() const {
    std::lock_guard const lock{mutex_};
    auto const first = std::ranges::upper_bound(entries_, given_, {}, &Numbered::sequence);
    if (first == entries_.end()) return {};
    Unstored unstored{.notifications = {first, entries_.end()}, .gone = {}};
    auto const oldest = entries_.begin() + static_cast<std::ptrdiff_t>(forgotten_);
    auto const add = [&](std::uint64_t from, std::uint64_t until) {
        if (from <= until) unstored.gone.push_back({from, until});
    };
    add(1, std::min(before(*oldest), given_));
    auto entry = std::lower_bound(oldest, entries_.end(), gaps_from_,
                                  [](Numbered const& each, std::uint64_t from) { return each.sequence < from; });
    for (; entry != entries_.end() && before(*entry) < given_; ++entry)
        if (as_lost(*entry) != nullptr) add(before(*entry) + 1, std::min({entry->sequence, given_, last_sequence_ - 1}));
    return unstored;
}

void NotificationQueue::being_stored(std::uint64_t until) noexcept {
    std::lock_guard const lock{mutex_};
    given_ = until;
    gaps_from_ = all;
}

bool NotificationQueue::show(std::uint64_t until) noexcept {
    std::lock_guard const lock{mutex_};
    if (shown_ >= until) return false;
    shown_ = until;
    return true;
}

void NotificationQueue::not_stored() noexcept {
    std::lock_guard const lock{mutex_};
    given_ = std::min(given_, shown_);
    gaps_from_ = 0;
}

// A `Lost` that was stored may count notifications that were stored before it. If sequences are missing between two entries,
// their notifications were lost.
void NotificationQueue::restore(std::vector<Numbered> entries) {
    std::lock_guard const lock{mutex_};
    for (auto& entry : entries) {
        auto const last = before(entry);
        while (!entries_.empty() && entries_.back().sequence > last) entries_.pop_back();
        if (!entries_.empty() && entries_.back().sequence < last)
            entries_.push_back(gap_until(last, last - entries_.back().sequence));
        entries_.push_back(std::move(entry));
    }
    sent_ = entries_.size();
    if (!entries_.empty()) shown_ = given_ = last_sequence_ = entries_.back().sequence;
}

bool NotificationQueue::closed() const {
    std::lock_guard const lock{mutex_};
    return shows_closed();
}

void NotificationQueue::mark_sent(std::uint64_t until) {
    for (; sent_ < entries_.size() && entries_[sent_].sequence <= until; ++sent_)
        if (as_lost(entries_[sent_]) == nullptr) --waiting_;
}

// Keeps those from before a restart until they were read again: perhaps they had not been read before.
void NotificationQueue::forget() {
    for (; sent_ - forgotten_ > max_sent_ && entries_[forgotten_].sequence <= read_; ++forgotten_)
        entries_[forgotten_].notification.reset();
    if (forgotten_ * 2 <= entries_.size()) return;
    entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(forgotten_));
    sent_ -= std::exchange(forgotten_, 0);
}

}  // namespace rois
