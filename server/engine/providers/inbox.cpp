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

void Inbox::add(std::shared_ptr<ProvidersEntries> const& of, InboxEntry&& entry) {
    std::lock_guard const lock{mutex_};
    if (of->closed) return;
    bool const first = next_.empty();
    of->entries.push_back(std::move(entry));
    if (of->entries.size() > 1) return;
    try {
        next_.push_back(of);
    } catch (...) {
        of->entries.pop_back();
        throw;
    }
    if (first && !attended) wake_();
}

void Inbox::close(ProvidersEntries& of) {
    std::deque<InboxEntry> dropped;  // outlives the lock
    std::lock_guard const lock{mutex_};
    of.closed = true;
    dropped.swap(of.entries);
    std::erase_if(next_, [&](auto const& each) { return each.get() == &of; });
}

std::optional<InboxEntry> Inbox::take() {
    std::lock_guard const lock{mutex_};
    if (returned_) return std::exchange(returned_, {});
    if (next_.empty()) return {};
    auto& entries = next_.front()->entries;
    std::optional entry{std::move(entries.front())};
    entries.pop_front();
    if (entries.empty()) {
        next_.pop_front();
    } else {
        next_.splice(next_.end(), next_, next_.begin());
    }
    return entry;
}

void Inbox::put_back(InboxEntry entry) noexcept {
    std::lock_guard const lock{mutex_};
    returned_ = std::move(entry);
}

bool Inbox::empty() const {
    std::lock_guard const lock{mutex_};
    return !returned_ && next_.empty();
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
