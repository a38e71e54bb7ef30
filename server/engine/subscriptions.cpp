#include "engine/subscriptions.hpp"

#include <algorithm>
#include <utility>

#include "engine/matching.hpp"
#include "engine/registry.hpp"
#include "engine/session.hpp"

namespace rois {

Subscription& Subscriptions::add(Session& session, std::string const& event_type, MaybeCondition const& condition,
                                 bool inline_results) {
    auto meaning = canonical(condition);
    auto& alike = by_type_[event_type];
    auto const known = std::ranges::find(alike, meaning, &Subscription::meaning);
    Subscription* subscription = known == alike.end() ? nullptr : *known;
    if (subscription == nullptr) {
        auto made = std::make_unique<Subscription>();
        made->id.text = "s-" + std::to_string(++last_);
        made->event_type = event_type;
        made->condition = condition;
        made->meaning = std::move(meaning);
        made->depends_on_asker = rois::depends_on_asker(condition);
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

bool Subscriptions::hears(Session const& session, RegisteredComponent const& component) {
    return std::ranges::any_of(session.subscriptions, [&](Subscription const* subscription) {
        return find_message(component.profile(), MessageKind::event, subscription->event_type) != nullptr &&
               could_match(subscription->condition, component);
    });
}

void Subscriptions::forget_if_unheard(Subscription& subscription) {
    if (!subscription.sessions.empty()) return;
    std::erase(by_type_[subscription.event_type], &subscription);
    by_id_.erase(subscription.id);
}

}  // namespace rois
