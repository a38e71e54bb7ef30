// Notifications of the engine: each is delivered once, in order, with the gaps between them.
#include <algorithm>

#include "core/core.hpp"

namespace rois::detail {

// Updates last_sequence_ at once, also for a notification that is held back: the link may break at any time.
void Core::take(xml::NumberedNotification numbered) {
    if (numbered.sequence <= last_sequence_) return;
    failures_ = 0;
    auto const missing = numbered.sequence - last_sequence_ - 1;
    last_sequence_ = numbered.sequence;
    if (auto* const lost = std::get_if<Lost>(&numbered.notification)) {
        lost->count = std::max(lost->count, missing + 1);
    } else if (missing > 0) {
        held_.push_back({numbered.sequence - 1, Lost{missing}});
    }
    held_.push_back(std::move(numbered));
    deliver_held();
}

void Core::deliver_held() {
    while (subscribing_ == 0 && !held_.empty()) deliver_first_held();
}

void Core::deliver_first_held() {
    auto numbered = std::move(held_.front());
    held_.pop_front();
    deliver(std::move(numbered));
}

void Core::deliver(xml::NumberedNotification numbered) {
    client::Subscriptions::Receivers receivers;
    auto* const event = std::get_if<ReceiveEvent>(&numbered.notification);
    if (event != nullptr) receivers = subscriptions_.receivers_of(*event);
    if (auto const* const lost = std::get_if<Lost>(&numbered.notification)) report_gap({Gap::Why::dropped, lost->count, {}});
    if (observers_.notification && !muted_) observers_.notification(numbered.notification, numbered.sequence);
    for (auto const& [id, stream] : receivers) {
        event->subscribe_id = id;
        stream->take(*event);
    }
    if (auto const* const completed = std::get_if<Completed>(&numbered.notification))
        complete(completed->command_id, completed->status);
}

void Core::report_gap(Gap const& gap) {
    for (auto const& stream : subscriptions_.streams()) stream->take_gap();
    if (observers_.gap && !muted_) observers_.gap(gap);
}

void Core::complete(CommandId const& id, CompletedStatus status) {
    std::vector<std::shared_ptr<Watch>> over;
    while (auto found = watches_.extract(id)) over.push_back(std::move(found.mapped()));
    for (auto const& watch : over) watch->complete(status);
}

}  // namespace rois::detail
