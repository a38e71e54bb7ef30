// Event interface (7.4.2, table 5): subscriptions and the delivery of events.
#include <algorithm>
#include <utility>

#include "engine/core.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// Steps of an Effort: so many bytes of conditions would keep commands waiting for the journal.
std::size_t steps_of_storing(Filter const& condition) {
    constexpr std::size_t bytes_of_a_record = 200, bytes_of_a_predicate = 100, steps_of_a_byte = 4;
    constexpr std::size_t most = 3'000'000;  // fewer than the default for a tenth of a second: each condition can be stored
    auto const bytes = bytes_of_a_record + bytes_of_a_predicate * condition.predicates() + condition.text_bytes();
    return std::min(most, steps_of_a_byte * bytes);
}

}  // namespace

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
    auto const* const earlier = known != nullptr ? Subscriptions::subscriber(session, *known) : nullptr;
    bool const again = earlier != nullptr;
    bool const changes = !again || earlier->inline_results != subscribe.inline_results;
    if (auto problem = again ? std::nullopt : no_room_for(session, wanted, known != nullptr))
        return refused<Subscribe::Reply>(ReturnCode::out_of_resources, *std::move(problem));
    // The last room is for the ends of commands.
    if (auto problem = recorder_.why_no_commands(); !again && !problem.empty())
        return refused<Subscribe::Reply>(ReturnCode::out_of_resources, std::move(problem));
    if (changes && wanted.restricts() && recorder_.stores(session)) Effort::spend(steps_of_storing(wanted));
    Subscribe::Reply reply;
    reply.subscribe_id = subscriptions_.add(session, subscribe.event_type, std::move(wanted), subscribe.inline_results).id;
    if (changes)
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
    if (subscriptions_.remove(session, id) || session.absent_subscriptions.erase(id.text) > 0)
        recorder_.unsubscribed(session, id);
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

void Engine::Core::publish(RegisteredComponent& component, EventOccurred const& event, Instant now, Attempts& deliveries) {
    auto const results = component.accepted(event);
    if (!results) return;
    bool const matched = deliver(component, event.event_type, results, now, deliveries);
    ++events_published_;
    if (!matched && kept_events_.keeps_any())
        kept_events_.add({now.steady + events_.kept_for(), event.event_type, component.ref().code, results});
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
