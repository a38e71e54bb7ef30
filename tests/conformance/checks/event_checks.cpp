// Events (7.4.1.5, figure 13; tables 5, 6, 22 and 23; decisions 18 to 21).
#include <algorithm>

#include "conformance/basic_messages.hpp"
#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::where;

// A bound detection component and its owner. The first measurement after `start` is an event.
class BoundDetector {
public:
    explicit BoundDetector(Context& context) : detector{context.detector()}, owner{context} { owner.bind_or_skip(detector); }

    std::string type() const { return detector.detection_event(); }
    Document subscribe(Client& client, kit::Xml const& condition = {}, bool inline_results = false) const {
        return require_ok(client.subscribe(type(), condition.empty() ? only(detector) : condition, inline_results));
    }
    void detect() { owner.require_success(owner.execute_one(command(detector, "start")), detector); }
    Document first_detection() { return owner.start_and_receive(detector, type()); }
    // Stops detection, and waits until the owner has received all detections.
    void end() {
        owner.execute_one(command(detector, "stop"));
        owner.flush_notifications(detector);
    }

    Component const& detector;
    Client owner;
};

void every_event_can_be_subscribed(Context& context) {
    Client client{context};
    for (auto const& component : context.catalogue().components) {
        for (auto const& event : component.events) {
            auto const id = require_ok(client.subscribe(event.name, only(component))).text("subscribe_id");
            require(!id.empty(), "subscribe to " + event.name + ": expected a subscribe_id, got none");
            require_ok(client.unsubscribe(id));
        }
    }
}

void an_event_is_received_with_its_ids(Context& context) {
    BoundDetector bound{context};
    auto const id = bound.subscribe(bound.owner).text("subscribe_id");
    auto const event = bound.first_detection();
    require_equal("subscribe_id", id, event.text("subscribe_id"));
    require_equal("component_ref", bound.detector.ref, event.ref());
    require(!event.text("event_id").empty(), "expected an event_id, got " + event.whole());
    require(!event.root().child("results"), "expected no inline results without inline_results, got " + event.whole());
}

void each_event_has_a_unique_id(Context& context) {
    BoundDetector bound{context};
    bound.subscribe(bound.owner);
    auto const first = bound.first_detection().text("event_id");
    auto const details = require_ok(bound.owner.get_event_detail(first)).values();
    bound.end();
    auto const second = bound.first_detection().text("event_id");
    require(first != second, "two events have the same event_id " + first);
    require(require_ok(bound.owner.get_event_detail(first)).values() == details,
            "the details of an event changed after the next event");
}

void an_event_has_details(Context& context) {
    BoundDetector bound{context};
    bound.subscribe(bound.owner);
    auto const answer = require_ok(bound.owner.get_event_detail(bound.first_detection().text("event_id")));
    auto const results = answer.values();
    for (auto const& expected : basic_message(bound.detector.basic(), bound.type())->results)
        require(results.contains(expected.name),
                "get_event_detail: expected the result " + expected.name + ", got " + answer.whole());
    for (auto const& known : bound.detector.event(bound.type())->results)
        if (auto const reported = results.find(known.name); reported != results.end())
            require(is_of_type(known.type, reported->second),
                    known.name + ": expected a value of type " + known.type + ", got " + answer.whole());
}

void a_condition_selects_details_of_an_event(Context& context) {
    BoundDetector bound{context};
    bound.subscribe(bound.owner);
    auto const id = bound.first_detection().text("event_id");
    auto const results = require_ok(bound.owner.get_event_detail(id)).values();
    auto const number = value_of(results, "number");
    require(require_ok(bound.owner.get_event_detail(id, where(kit::equal("number", number)))).values() == results,
            "expected all results for the condition number = " + number);
    require(require_ok(bound.owner.get_event_detail(id, where(kit::equal("number", "-7")))).values().empty(),
            "expected no results for the condition number = -7");
    require_refusal(bound.owner.get_event_detail(id, where(kit::equal(unknown_name, "red"))), "BAD_PARAMETER");
}

void results_are_inline_if_requested(Context& context) {
    BoundDetector bound{context};
    bound.subscribe(bound.owner, "", true);
    auto const event = bound.first_detection();
    auto const inline_results = event.values();
    require(!inline_results.empty(), "expected inline results, got " + event.whole());
    require(inline_results == require_ok(bound.owner.get_event_detail(event.text("event_id"))).values(),
            "expected inline results equal to get_event_detail, got " + event.whole());
}

void details_of_an_unknown_event_are_refused(Context& context) {
    Client client{context};
    require_refusal(client.get_event_detail(unknown_name), "BAD_PARAMETER");
}

void a_repeated_subscription_keeps_its_id(Context& context) {
    BoundDetector bound{context};
    auto const id = bound.subscribe(bound.owner).text("subscribe_id");
    require_equal("the subscribe_id of a repeated subscription", id, bound.subscribe(bound.owner).text("subscribe_id"));
    auto const turned_around = where(kit::literal_first(bound.detector.ref, "component_ref"));
    require_equal("the subscribe_id of the same condition with exchanged operands", id,
                  bound.subscribe(bound.owner, turned_around, true).text("subscribe_id"));
    auto const event = bound.first_detection();
    require(!event.values().empty(), "expected inline results, as in the last subscribe, got " + event.whole());
    auto const event_id = event.text("event_id");
    bound.end();
    auto const again = std::ranges::count_if(bound.owner.history(),
                                             [&](Document const& received) { return received.text("event_id") == event_id; });
    require(again == 1, "expected each event once for a repeated subscription, received it " + std::to_string(again) + " times");
}

void inline_results_can_be_switched_off(Context& context) {
    BoundDetector bound{context};
    bound.subscribe(bound.owner, "", true);
    require_ok(bound.owner.ask("subscribe", kit::text_element("event_type", bound.type()) + only(bound.detector),
                               {{"inline_results", "false"}}));
    auto const event = bound.first_detection();
    require(!event.root().child("results"), "expected no inline results, as in the last subscribe, got " + event.whole());
}

void events_without_a_subscription_are_not_received(Context& context) {
    BoundDetector bound{context};
    Client other{context};
    bound.subscribe(bound.owner);
    auto const [one, another] = context.two_common_components();
    auto const& mine = one->ref == bound.detector.ref ? *another : *one;
    other.bind_or_skip(mine);
    bound.first_detection();
    other.flush_notifications(mine);
    require(other.count_events(bound.type()) == 0, "an application without a subscription received an event");
}

// Requires no event for 200 ms after each of `suspend`, `stop` and `release`.
void an_inactive_component_sends_no_events(Context& context) {
    constexpr int a_while = 200;  // ms
    BoundDetector bound{context};
    auto& owner = bound.owner;
    auto const [one, another] = context.two_common_components();
    auto const& other = one->ref == bound.detector.ref ? *another : *one;
    owner.bind_or_skip(other);
    bound.subscribe(owner);
    bound.first_detection();
    auto const silent = [&](std::string const& when) {
        auto const before = owner.count_events(bound.type());
        owner.run(command(other, "stop", "", a_while));
        require(owner.count_events(bound.type()) == before, "received an event of " + bound.detector.ref + " after " + when);
    };
    require_equal("the status of suspend", "OK", owner.run(command(bound.detector, "suspend")));
    silent("suspend");
    require_equal("the status of stop", "OK", owner.run(command(bound.detector, "stop")));
    silent("stop");
    bound.first_detection();
    require_ok(owner.release(bound.detector.ref));
    owner.flush_notifications(other);
    silent("release");
}

void two_applications_receive_the_same_event(Context& context) {
    BoundDetector bound{context};
    Client other{context};
    bound.subscribe(bound.owner);
    bound.subscribe(other);
    require_equal("the component", bound.detector.ref, bound.first_detection().ref());
    require_equal("the component", bound.detector.ref, other.next_event(bound.type()).ref());
}

void no_event_is_received_after_unsubscribe(Context& context) {
    BoundDetector bound{context};
    Client witness{context};
    require_ok(bound.owner.unsubscribe(bound.subscribe(bound.owner).text("subscribe_id")));
    bound.subscribe(witness);
    bound.detect();
    witness.next_event(bound.type());
    bound.end();
    require(bound.owner.count_events(bound.type()) == 0, "received an event after unsubscribe");
}

void unsubscribe_of_an_ended_or_unknown_subscription_returns_ok(Context& context) {
    Client client{context};
    auto const& detector = context.detector();
    auto const id = require_ok(client.subscribe(detector.detection_event())).text("subscribe_id");
    require_ok(client.unsubscribe(id));
    require_ok(client.unsubscribe(id));
    require_ok(client.unsubscribe(unknown_name));
}

void only_matching_events_are_received(Context& context) {
    BoundDetector bound{context};
    Client filtering{context};
    auto const never = bound.subscribe(filtering, where(kit::equal("number", "-7"))).text("subscribe_id");
    auto const always = bound.subscribe(filtering).text("subscribe_id");
    require(never != always, "subscriptions with different conditions have the same subscribe_id " + never);
    bound.detect();
    require_equal("the subscribe_id of the matching subscription", always,
                  filtering.next_event(bound.type()).text("subscribe_id"));
}

void a_subscription_to_an_unknown_event_is_refused(Context& context) {
    Client client{context};
    auto const& detector = context.detector();
    require_refusal(client.subscribe(unknown_name), "UNSUPPORTED");
    require_refusal(client.subscribe(detector.detection_event(), where(kit::equal("component_ref", unknown_name))),
                    "UNSUPPORTED");
    require_refusal(client.subscribe(detector.detection_event(), where(kit::equal(unknown_name, "red"))), "BAD_PARAMETER");
}

void a_subscription_without_a_condition_covers_all_components(Context& context) {
    BoundDetector bound{context};
    auto const id = require_ok(bound.owner.subscribe(bound.type())).text("subscribe_id");
    require_equal("subscribe_id", id, bound.first_detection().text("subscribe_id"));
}

}  // namespace

Clause event_clause() {
    return {
        "7.4.1.5 Event interface",
        {{"every_event_can_be_subscribed", "figure 13; tables 5, 35 to 46", every_event_can_be_subscribed},
         {"an_event_is_received_with_its_ids", "figure 13; tables 6, 22", an_event_is_received_with_its_ids},
         {"each_event_has_a_unique_id", "tables 6, 22; decision 8", each_event_has_a_unique_id},
         {"an_event_has_details", "figure 13; tables 5, 23, 35", an_event_has_details},
         {"a_condition_selects_details_of_an_event", "tables 5, 23; decision 19", a_condition_selects_details_of_an_event},
         {"results_are_inline_if_requested", "decision 21", results_are_inline_if_requested},
         {"details_of_an_unknown_event_are_refused", "table 5; decision 21", details_of_an_unknown_event_are_refused},
         {"a_repeated_subscription_keeps_its_id", "7.4.1.5; decision 20", a_repeated_subscription_keeps_its_id},
         {"inline_results_can_be_switched_off", "decision 20", inline_results_can_be_switched_off},
         {"events_without_a_subscription_are_not_received", "7.4.1.5", events_without_a_subscription_are_not_received},
         {"an_inactive_component_sends_no_events", "table 32; decisions 6, 9", an_inactive_component_sends_no_events},
         {"two_applications_receive_the_same_event", "7.4.1.5; decision 20", two_applications_receive_the_same_event},
         {"no_event_is_received_after_unsubscribe", "figure 13", no_event_is_received_after_unsubscribe},
         {"unsubscribe_of_an_ended_or_unknown_subscription_returns_ok", "7.4.1.5; decision 20",
          unsubscribe_of_an_ended_or_unknown_subscription_returns_ok},
         {"only_matching_events_are_received", "table 5; decision 19", only_matching_events_are_received},
         {"a_subscription_to_an_unknown_event_is_refused", "table 1; decision 18", a_subscription_to_an_unknown_event_is_refused},
         {"a_subscription_without_a_condition_covers_all_components", "table 5; decision 18",
          a_subscription_without_a_condition_covers_all_components}}};
}

}  // namespace rois::conformance
