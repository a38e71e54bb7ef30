#include "engine/providers/inbox.hpp"

#include <utility>

namespace rois {

namespace {

thread_local bool attended = false;  // by this thread

}  // namespace

Inbox::Attended::Attended() : before_{std::exchange(attended, true)} {}

Inbox::Attended::~Attended() { attended = before_; }

void Inbox::on_arrival(std::function<void()> wake) {
    std::lock_guard const lock{mutex_};
    wake_ = std::move(wake);
}

void Inbox::wake() {
    std::lock_guard const lock{mutex_};
    wake_();
}

void Inbox::add(ProvidersEntries& of, InboxEntries&& one) {
    std::lock_guard const lock{mutex_};
    if (of.closed) return;
    bool const first = next_.empty();
    next_.splice(next_.end(), of.turn);
    of.entries.splice(of.entries.end(), one);
    is_empty_.store(false, std::memory_order_release);
    if (first && !attended) wake_();
}

void Inbox::close(ProvidersEntries& of) noexcept {
    InboxEntries dropped;  // outlives the lock
    std::lock_guard const lock{mutex_};
    of.closed = true;
    dropped.swap(of.entries);
    next_.remove(&of);
    is_empty_ = next_.empty() && returned_.empty();
}

std::size_t Inbox::waiting(ProvidersEntries const& of) const {
    std::lock_guard const lock{mutex_};
    return of.entries.size();
}

InboxEntries Inbox::take() noexcept {
    InboxEntries one;
    if (empty()) return one;
    std::lock_guard const lock{mutex_};
    one.swap(returned_);
    if (one.empty() && !next_.empty()) {
        auto& [entries, closed, turn] = *next_.front();
        one.splice(one.end(), entries, entries.begin());
        auto& from = entries.empty() ? turn : next_;
        from.splice(from.end(), next_, next_.begin());
    }
    is_empty_.store(next_.empty(), std::memory_order_release);
    return one;
}

void Inbox::put_back(InboxEntries&& one) noexcept {
    std::lock_guard const lock{mutex_};
    returned_.swap(one);
    is_empty_.store(false, std::memory_order_release);
}

void Inbox::note_lost_report() noexcept {
    std::lock_guard const lock{mutex_};
    report_lost_ = true;
}

bool Inbox::take_lost_reports() noexcept {
    std::lock_guard const lock{mutex_};
    return std::exchange(report_lost_, false);
}

}  // namespace rois
