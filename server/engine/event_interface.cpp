// Event interface (7.4.2, table 5): subscriptions, and what becomes of events.
#include <algorithm>
#include <utility>

#include "engine/core.hpp"
#include "engine/matching.hpp"
#include "types/texts.hpp"

namespace rois {

Reply Engine::Core::perform(Session& session, Subscribe const& subscribe, Instant) {
    auto const& components = registry_.with(MessageKind::event, subscribe.event_type);
    auto references = component_references();
    for (auto const* component : components)
        for (auto const& result : find_message(component->profile(), MessageKind::event, subscribe.event_type)->results)
            references.push_back(result.name);
    if (components.empty())
        return refused<Subscribe::Reply>(ReturnCode::unsupported, "no component has the event " + quoted(subscribe.event_type));
    if (auto problem = why_unusable(subscribe.condition, references))
        return refused<Subscribe::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    if (std::ranges::none_of(components, [&](auto const* c) { return could_match(subscribe.condition, *c); }))
        return refused<Subscribe::Reply>(ReturnCode::unsupported, "no component that has the event can match the condition");
    Subscribe::Reply reply;
    reply.subscribe_id = subscriptions_.add(session, subscribe.event_type, subscribe.condition, subscribe.inline_results).id;
    return reply;
}

Reply Engine::Core::perform(Session& session, Unsubscribe const& unsubscribe, Instant) {
    subscriptions_.remove(session, unsubscribe.subscribe_id);
    return Unsubscribe::Reply{};
}

Reply Engine::Core::perform(Session&, GetEventDetail const& get, Instant now) {
    auto const found = events_.find(get.event_id.text, now);
    if (found.found == Details::Found::unknown)
        return refused<GetEventDetail::Reply>(ReturnCode::bad_parameter, "unknown event_id " + quoted(get.event_id.text));
    if (found.found == Details::Found::expired)
        return refused<GetEventDetail::Reply>(ReturnCode::bad_parameter,
                                              "the details of the event " + quoted(get.event_id.text) + " have expired");
    std::vector<std::string> references;
    references.reserve(found.message->results.size());
    for (auto const& result : found.message->results) references.push_back(result.name);
    if (auto problem = why_unusable(get.condition, references))
        return refused<GetEventDetail::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    GetEventDetail::Reply reply;
    if (matches(get.condition, *found.results)) reply.results = *found.results;
    return reply;
}

namespace {

// The notifications of one event to one subscription: one object for all who want the results inline, one for the others.
class EventNotifications {
public:
    EventNotifications(ReceiveEvent plain, std::shared_ptr<Results const> results)
        : plain_{std::move(plain)}, results_{std::move(results)} {}

    SharedNotification const& of(bool inline_results) {
        auto& made = inline_results ? with_results_ : without_results_;
        if (made) return made;
        auto event = plain_;
        if (inline_results) event.results = results_;
        made = std::make_shared<OutgoingNotification const>(std::move(event));
        return made;
    }

private:
    ReceiveEvent plain_;
    std::shared_ptr<Results const> results_;
    SharedNotification with_results_;
    SharedNotification without_results_;
};

}  // namespace

void Engine::Core::publish(EventOccurred said, Instant now) {
    ++events_published_;
    auto const results = std::make_shared<Results const>(std::move(said.results));
    std::string event_id;  // given when somebody hears of it
    for (auto* subscription : subscriptions_.of(said.event_type)) {
        bool const each = subscription->depends_on_asker;
        if (!each && !matches(subscription->condition, *said.component, *results, nullptr)) continue;
        if (event_id.empty()) {
            auto const& profile = said.component->entry().profile;
            event_id = events_.add(results, {profile, find_message(*profile, MessageKind::event, said.event_type)}, now);
        }
        EventNotifications notifications{{.event_id = {event_id},
                                          .event_type = said.event_type,
                                          .subscribe_id = subscription->id,
                                          .expire = now.utc + events_.kept_for(),
                                          .component_ref = said.component->ref(),
                                          .results = nullptr},
                                         results};
        for (auto const& [session, inline_results] : subscription->sessions)
            if (!each || matches(subscription->condition, *said.component, *results, session))
                notifier_.tell(*session, notifications.of(inline_results));
    }
}

}  // namespace rois
