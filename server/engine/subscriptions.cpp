#include "engine/subscriptions.hpp"

#include <algorithm>
#include <utility>

#include "engine/registry.hpp"
#include "engine/session.hpp"

namespace rois {

Subscription& Subscriptions::add(Session& session, std::string const& event_type, Filter filter, bool inline_results) {
    auto& alike = by_type_[event_type];
    auto const known =
        std::ranges::find_if(alike, [&](Subscription const* s) { return s->filter.meaning() == filter.meaning(); });
    Subscription* subscription = known == alike.end() ? nullptr : *known;
    if (subscription == nullptr) {
        auto made = std::make_unique<Subscription>();
        made->id.text = "s-" + std::to_string(++last_);
        made->event_type = event_type;
        made->filter = std::move(filter);
        subscription = made.get();
        alike.push_back(subscription);
        by_id_.emplace(subscription->id, std::move(made));
    }
    subscription->sessions[&session] = inline_results;
    session.subscriptions.insert(subscription);
    return *subscription;
}

void Subscriptions::remove(Session& session, SubscribeId const& id) {
    auto const found = by_id_.find(id);
    if (found == by_id_.end()) return;
    auto& subscription = *found->second;
    if (subscription.sessions.erase(&session) == 0) return;
    session.subscriptions.erase(&subscription);
    forget_if_unheard(subscription);
}

void Subscriptions::remove_all(Session& session) {
    for (auto* subscription : std::exchange(session.subscriptions, {})) {
        subscription->sessions.erase(&session);
        forget_if_unheard(*subscription);
    }
}

std::vector<Subscription*> const& Subscriptions::of(std::string_view event_type) const {
    static std::vector<Subscription*> const none;
    auto const found = by_type_.find(event_type);
    return found == by_type_.end() ? none : found->second;
}

bool Subscriptions::hears(Session const& session, RegisteredComponent const& component, Perspective& ever) {
    return std::ranges::any_of(session.subscriptions, [&](Subscription const* subscription) {
        return find_message(component.profile(), MessageKind::event, subscription->event_type) != nullptr &&
               subscription->filter.match(ever.candidate(component)) != Match::no;
    });
}

void Subscriptions::forget_if_unheard(Subscription& subscription) {
    if (!subscription.sessions.empty()) return;
    std::erase(by_type_[subscription.event_type], &subscription);
    by_id_.erase(subscription.id);
}

}  // namespace rois
