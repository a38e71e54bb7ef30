// Event interface (7.4.2, table 5): subscriptions and the delivery of events.
#include <algorithm>
#include <utility>

#include "engine/core.hpp"
#include "types/text/texts.hpp"

namespace rois {

Reply Engine::Core::perform(Session& session, Subscribe const& subscribe, Instant now) {
    auto const& components = registry_.with(MessageKind::event, subscribe.event_type);
    if (components.possible({}, {Members::shown, session.rights.get()}).next() == nullptr)
        return refused<Subscribe::Reply>(ReturnCode::unsupported, "no component has the event " + quoted(subscribe.event_type));
    auto filter = Filter::compile(subscribe.condition, vocabulary(session, MessageKind::event, subscribe.event_type));
    if (auto* problem = std::get_if<std::string>(&filter))
        return refused<Subscribe::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    auto& wanted = std::get<Filter>(filter);
    if (!may_ever_match(wanted, components.possible(wanted.demand(), seen_by(session, wanted)), session))
        return refused<Subscribe::Reply>(ReturnCode::unsupported, "no component that has the event can match the condition");
    auto* const known = subscriptions_.find(subscribe.event_type, wanted);
    bool const again = known != nullptr && session.subscriptions.contains(known);
    if (auto problem = again ? std::nullopt : no_room_for(session, wanted, known != nullptr))
        return refused<Subscribe::Reply>(ReturnCode::out_of_resources, *std::move(problem));
    // The last room is for the ends of commands.
    if (auto problem = recorder_.why_no_commands(); !again && !problem.empty())
        return refused<Subscribe::Reply>(ReturnCode::out_of_resources, std::move(problem));
    Subscribe::Reply reply;
    reply.subscribe_id = subscriptions_.add(session, subscribe.event_type, std::move(wanted), subscribe.inline_results).id;
    recorder_.subscribed(session, reply.subscribe_id, subscribe,
                         again ? Recorder::Has::subscribed_again : Recorder::Has::subscribed);
    deliver_kept(subscribe.event_type, now);
    return reply;
}

// Returns why the session may not have one more subscription, or nullopt. `shared`: another session has the same subscription.
std::optional<std::string> Engine::Core::no_room_for(Session const& session, Filter const& wanted, bool shared) {
    auto const too_many = [](std::string_view whose, std::size_t most, std::string_view what, std::uint64_t& refused) {
        ++refused;
        return "the conditions of " + std::string{whose} + " may have at most " + std::to_string(most) + " " + std::string{what} +
               " in total: unsubscribe from events that you do not need";
    };
    if (session.predicates + wanted.predicates() > settings_.max_subscribed_predicates)
        return too_many("a session's subscriptions", settings_.max_subscribed_predicates, "predicates", refused_.predicates);
    if (session.condition_bytes + wanted.text_bytes() > settings_.max_condition_bytes)
        return too_many("a session's subscriptions", settings_.max_condition_bytes, "bytes of text", refused_.condition_bytes);
    if (!shared && subscriptions_.predicates() + wanted.predicates() > settings_.max_predicates)
        return too_many("all subscriptions", settings_.max_predicates, "predicates", refused_.all_predicates);
    if (memory_->tight()) return memory_->refuse("there is no memory for a new subscription");
    return {};
}

Reply Engine::Core::perform(Session& session, Unsubscribe const& unsubscribe, Instant) {
    auto const& id = unsubscribe.subscribe_id;
    auto const is_it = [&](StoredSubscription const& each) { return each.session == session.number && each.id == id; };
    bool const was_absent = std::erase_if(absent_subscriptions_, is_it) > 0;
    if (subscriptions_.remove(session, id) || was_absent) recorder_.unsubscribed(session, id);
    return Unsubscribe::Reply{};
}

Reply Engine::Core::perform(Session& session, GetEventDetail const& get, Instant now) {
    auto const& id = get.event_id.text;
    return reply_with<GetEventDetail::Reply>(events_.find(id, session.events, now), "event", id, get.condition, session);
}

namespace {

// The results of get_event_detail (those of the event's message) or, without a message, of get_error_detail.
Declarations declared_details(MessageProfile const* message) {
    Declarations known;
    if (message != nullptr) {
        known.add(message->results);
        return known;
    }
    for (auto const& [name, type] : {std::pair{"component_ref", "RoISIdentifier"}, {"time", "DateTime"}, {"text", "string"}})
        known.add({.name = name, .data_type_ref = {type, {}, {}, {}}, .default_value = {}, .description = {}});
    return known;
}

}  // namespace

std::optional<std::string> Engine::Core::choose_details(Results& results, Details::Answer const& details, std::string_view kind,
                                                        std::string const& id, QueryExpression const& condition,
                                                        Session const& asker) const {
    auto const kind_text = std::string{kind};
    if (details.found == Details::Found::unknown) return "unknown " + kind_text + "_id " + quoted(id);
    if (details.found == Details::Found::expired) return "the details of the " + kind_text + " " + quoted(id) + " have expired";
    results = *details.results;
    auto const* const of = details.message == nullptr ? rois::find(results.parameters, "component_ref") : nullptr;
    if (of != nullptr && hides_members(asker, of->values.front()))
        std::erase_if(results.parameters, [](Parameter const& each) { return each.name == "text"; });
    return choose(results, condition, declared_details(details.message.get()), id, asker);
}

namespace {

// The notifications of one event for one subscription: one shared by all sessions with inline results, one by the others.
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

void Engine::Core::publish(RegisteredComponent& component, EventOccurred const& event, Instant now, Attempts& deliveries) {
    auto const results = component.accepted(event);
    if (!results) return;
    bool const matched = deliver(component, event.event_type, results, now, deliveries);
    ++events_published_;
    if (!matched && kept_events_.keeps_any())
        kept_events_.add({now.steady + events_.kept_for(), event.event_type, component.ref().code, results});
}

bool Engine::Core::deliver(RegisteredComponent& component, std::string const& event_type, SharedResults const& results,
                           Instant now, Attempts& deliveries) {
    auto const subscriptions = subscriptions_.possible(event_type, component);
    std::string event_id;  // made when a subscriber matches
    auto no_asker = perspective(nullptr, Perspective::Of::present);
    MessageCandidate const candidate{no_asker.candidate(component), *results};
    auto const matches = [&](Subscription const& subscription, Session const& asker) {
        auto askers = perspective(&asker, Perspective::Of::present);
        return subscription.filter.match(MessageCandidate{askers.candidate(component), *results}) == Match::yes;
    };
    bool begun = false;  // some subscriber may have been notified
    ++event_;
    // The session has no steps left. It receives a `Lost`: perhaps it has missed this event.
    auto const miss = [&](Subscription::Subscriber const& one) {
        if (std::exchange(one.session->missed, event_) == event_) return;
        effort_.count_refusal();
        begun = true;
        deliveries([&] { notifier_.lose(*one.queue, component.answer_to(*one.session)); });
    };
    std::vector<Subscription::Subscriber const*> receivers, undecided;
    // All subscribers that may see everything share one match. The first of them with steps left pays for it.
    auto const find_receivers = [&](Subscription const& subscription) {
        bool const each = subscription.filter.depends_on_asker();
        std::optional<bool> common = subscription.filter.restricts() ? std::nullopt : std::optional{true};
        receivers.clear();
        undecided.clear();
        for (auto const& one : subscription.subscribers) {
            if (!may_see(one.rights, component.ref().code)) continue;
            bool const alone = each || (subscription.filter.restricts() && !may_see_everything(one.rights));
            auto met = alone ? std::nullopt : common;
            if (!met)
                met = paid_by(*one.session, now, [&] {
                    return alone ? matches(subscription, *one.session) : subscription.filter.match(candidate) == Match::yes;
                });
            if (!met) (alone ? miss(one) : undecided.push_back(&one));
            if (met && !alone) common = met;
            if (met.value_or(false)) receivers.push_back(&one);
        }
        for (auto const* one : undecided)
            if (!common)
                miss(*one);
            else if (*common)
                receivers.push_back(one);
    };
    auto const deliver_to = [&](Subscription& subscription) {
        find_receivers(subscription);
        if (receivers.empty()) return;
        if (event_id.empty()) {
            auto const& profile = component.entry().profile;
            event_id = events_.add(results, {profile, find_message(*profile, MessageKind::event, event_type)}, now);
        }
        EventNotifications notifications{{.event_id = {event_id},
                                          .event_type = event_type,
                                          .subscribe_id = subscription.id,
                                          .expire = now.utc + events_.kept_for(),
                                          .component_ref = component.ref(),
                                          .results = nullptr},
                                         results};
        begun = true;
        for (auto const* subscriber : receivers) {
            deliveries([&] {
                events_.add_receiver(subscriber->slot);
                notifier_.notify(*subscriber->queue, notifications.of(subscriber->inline_results),
                                 component.answer_to(*subscriber->session));
            });
        }
    };
    for (auto* subscription : subscriptions) {
        if (begun)
            deliveries([&] { deliver_to(*subscription); });
        else
            deliver_to(*subscription);
    }
    return !event_id.empty();
}

void Engine::Core::deliver_or_keep(KeptEvents::Event event, Instant now, Attempts& deliveries) {
    auto* component = registry_.find(event.ref);
    if (component == nullptr) return;
    if (!deliver(*component, event.type, event.results, now, deliveries)) kept_events_.add(std::move(event));
}

// An event that cannot be delivered for lack of memory is lost. The next tick reports that.
void Engine::Core::deliver_kept(std::string const& event_type, Instant now) {
    Attempts attempts;
    attempts([&] {
        for (auto& event : kept_events_.take(event_type, now.steady)) deliver_or_keep(std::move(event), now, attempts);
    });
    if (attempts.failure()) unsettled_ = attempts.failure();
}

// A session with a link can still read its notifications.
void Engine::Core::pass_on_unread(Session const& session, Instant now) {
    if (!kept_events_.keeps_any() || shutting_down_ || session.lease.links() > 0) return;
    Attempts attempts;
    attempts([&] {
        std::string last_id;
        for (auto const& notification : session.notifications->unread_events()) {
            auto const& event = std::get<ReceiveEvent>(notification->body);
            auto const& id = event.event_id.text;
            if (std::exchange(last_id, id) == id) continue;  // the same event, for another subscription of the session
            auto const details = events_.find(id, session.events, now);
            if (details.found != Details::Found::kept || !events_.is_only_receiver(id, session.events)) continue;
            auto const until = now.steady + std::chrono::duration_cast<Steady::duration>(event.expire - now.utc);
            deliver_or_keep({until, event.event_type, event.component_ref.code, details.results}, now, attempts);
        }
    });
    if (attempts.failure()) unsettled_ = attempts.failure();
}

}  // namespace rois
