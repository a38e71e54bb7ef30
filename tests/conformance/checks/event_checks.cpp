// Events (7.4.1.5, figure 13; tables 5, 6, 22 and 23; decisions 18 to 21).
#include <algorithm>

#include "conformance/basic_messages.hpp"
#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

using kit::where;

// A detector, whose first measurement is an event, and its owner.
class Watch {
public:
    explicit Watch(Stage& stage) : detector{stage.detector()}, owner{stage} { owner.take(detector); }

    std::string type() const { return detector.detection(); }
    Document subscribe(Guest& guest, kit::Xml const& condition = {}, bool inline_results = false) const {
        return ok(guest.subscribe(type(), condition.empty() ? only(detector) : condition, inline_results));
    }
    void detect() { owner.require_success(owner.order(command(detector, "start")), detector); }
    Document first_detection() { return owner.start_until(detector, type()); }
    // Stops detection; the owner has received all detections.
    void end() {
        owner.order(command(detector, "stop"));
        owner.settle(detector);
    }

    Component const& detector;
    Guest owner;
};

void every_event_can_be_subscribed(Stage& stage) {
    Guest guest{stage};
    for (auto const& component : stage.catalogue().components) {
        for (auto const& event : component.events) {
            auto const id = ok(guest.subscribe(event.name, only(component))).text("subscribe_id");
            require(!id.empty(), "the subscription of " + event.name + " has no id");
            ok(guest.unsubscribe(id));
        }
    }
}

void an_event_is_received_with_its_ids(Stage& stage) {
    Watch watch{stage};
    auto const id = watch.subscribe(watch.owner).text("subscribe_id");
    auto const event = watch.first_detection();
    same("subscribe_id", id, event.text("subscribe_id"));
    same("component_ref", watch.detector.ref, event.ref());
    require(!event.text("event_id").empty(), "an event has an id: " + event.whole());
    require(!event.root().child("results"), "results were not asked for: " + event.whole());
}

void each_event_has_an_id_of_its_own(Stage& stage) {
    Watch watch{stage};
    watch.subscribe(watch.owner);
    auto const first = watch.first_detection().text("event_id");
    auto const details = ok(watch.owner.get_event_detail(first)).values();
    watch.end();
    auto const second = watch.first_detection().text("event_id");
    require(first != second, "two events have the id " + first);
    require(ok(watch.owner.get_event_detail(first)).values() == details, "the details of an event changed with the next one");
}

void details_of_an_event(Stage& stage) {
    Watch watch{stage};
    watch.subscribe(watch.owner);
    auto const answer = ok(watch.owner.get_event_detail(watch.first_detection().text("event_id")));
    auto const results = answer.values();
    for (auto const& due : basic_message(watch.detector.basic(), watch.type())->results)
        require(results.contains(due.name), "the details lack " + due.name + ": " + answer.whole());
    for (auto const& known : watch.detector.event(watch.type())->results)
        if (auto const told = results.find(known.name); told != results.end())
            require(is_of_type(known.type, told->second),
                    known.name + " is not of the type " + known.type + ": " + answer.whole());
}

void details_are_chosen_by_condition(Stage& stage) {
    Watch watch{stage};
    watch.subscribe(watch.owner);
    auto const id = watch.first_detection().text("event_id");
    auto const results = ok(watch.owner.get_event_detail(id)).values();
    auto const number = value_of(results, "number");
    require(ok(watch.owner.get_event_detail(id, where(kit::equal("number", number)))).values() == results,
            "the condition number = " + number + " holds, but the results are not told");
    require(ok(watch.owner.get_event_detail(id, where(kit::equal("number", "-7")))).values().empty(),
            "the condition number = -7 does not hold, but there are results");
    refused(watch.owner.get_event_detail(id, where(kit::equal(nobody, "red"))), "BAD_PARAMETER");
}

void results_come_inline_when_asked_for(Stage& stage) {
    Watch watch{stage};
    watch.subscribe(watch.owner, "", true);
    auto const event = watch.first_detection();
    auto const inline_results = event.values();
    require(!inline_results.empty(), "the results should come with the event: " + event.whole());
    require(inline_results == ok(watch.owner.get_event_detail(event.text("event_id"))).values(),
            "the results that come with the event are not its details: " + event.whole());
}

void details_of_an_unknown_event_are_refused(Stage& stage) {
    Guest guest{stage};
    refused(guest.get_event_detail(nobody), "BAD_PARAMETER");
}

void the_same_subscription_again_changes_nothing(Stage& stage) {
    Watch watch{stage};
    auto const id = watch.subscribe(watch.owner).text("subscribe_id");
    same("the subscribe_id of the same again", id, watch.subscribe(watch.owner).text("subscribe_id"));
    auto const turned_around = where(kit::literal_first(watch.detector.ref, "component_ref"));
    same("the subscribe_id of the same, operands in the other order", id,
         watch.subscribe(watch.owner, turned_around, true).text("subscribe_id"));
    auto const event = watch.first_detection();
    require(!event.values().empty(), "the last inline_results should win: " + event.whole());
    auto const event_id = event.text("event_id");
    watch.end();
    auto const again =
        std::ranges::count_if(watch.owner.history(), [&](Document const& heard) { return heard.text("event_id") == event_id; });
    require(again == 1, "an event came " + std::to_string(again) + " times to one subscription");
}

void inline_results_are_taken_back(Stage& stage) {
    Watch watch{stage};
    watch.subscribe(watch.owner, "", true);
    ok(watch.owner.ask("subscribe", kit::text_element("event_type", watch.type()) + only(watch.detector),
                       {{"inline_results", "false"}}));
    auto const event = watch.first_detection();
    require(!event.root().child("results"), "the last time, results were not asked for: " + event.whole());
}

void what_was_not_subscribed_is_not_received(Stage& stage) {
    Watch watch{stage};
    Guest other{stage};
    watch.subscribe(watch.owner);
    auto const [one, another] = stage.two_common();
    auto const& mine = one->ref == watch.detector.ref ? *another : *one;
    other.take(mine);
    watch.first_detection();
    other.settle(mine);
    require(other.heard_events(watch.type()) == 0, "an event came to an application that has not subscribed");
}

// After `suspend`, `stop` and `release`, a component sends no events for at least `a_while`.
void what_does_not_run_is_silent(Stage& stage) {
    constexpr int a_while = 200;  // ms
    Watch watch{stage};
    auto& owner = watch.owner;
    auto const [one, another] = stage.two_common();
    auto const& other = one->ref == watch.detector.ref ? *another : *one;
    owner.take(other);
    watch.subscribe(owner);
    watch.first_detection();
    auto const silent = [&](std::string const& when) {
        auto const before = owner.heard_events(watch.type());
        owner.ending(command(other, "stop", "", a_while));
        require(owner.heard_events(watch.type()) == before, "an event came after " + when + " of " + watch.detector.ref);
    };
    same("the status of suspend", "OK", owner.ending(command(watch.detector, "suspend")));
    silent("suspend");
    same("the status of stop", "OK", owner.ending(command(watch.detector, "stop")));
    silent("stop");
    watch.first_detection();
    ok(owner.release(watch.detector.ref));
    owner.settle(other);
    silent("release");
}

void two_applications_receive_the_same_event(Stage& stage) {
    Watch watch{stage};
    Guest other{stage};
    watch.subscribe(watch.owner);
    watch.subscribe(other);
    same("the component", watch.detector.ref, watch.first_detection().ref());
    same("the component", watch.detector.ref, other.hear_event(watch.type()).ref());
}

void after_unsubscribe_nothing_is_received(Stage& stage) {
    Watch watch{stage};
    Guest witness{stage};
    ok(watch.owner.unsubscribe(watch.subscribe(watch.owner).text("subscribe_id")));
    watch.subscribe(witness);
    watch.detect();
    witness.hear_event(watch.type());
    watch.end();
    require(watch.owner.heard_events(watch.type()) == 0, "an event came after unsubscribe");
}

void unsubscribe_of_what_is_over_is_ok(Stage& stage) {
    Guest guest{stage};
    auto const& detector = stage.detector();
    auto const id = ok(guest.subscribe(detector.detection())).text("subscribe_id");
    ok(guest.unsubscribe(id));
    ok(guest.unsubscribe(id));
    ok(guest.unsubscribe(nobody));
}

void only_events_that_match_are_received(Stage& stage) {
    Watch watch{stage};
    Guest picky{stage};
    auto const never = watch.subscribe(picky, where(kit::equal("number", "-7"))).text("subscribe_id");
    auto const always = watch.subscribe(picky).text("subscribe_id");
    require(never != always, "two conditions share a subscribe_id");
    watch.detect();
    same("the subscription whose condition holds", always, picky.hear_event(watch.type()).text("subscribe_id"));
}

void what_cannot_happen_is_unsupported(Stage& stage) {
    Guest guest{stage};
    auto const& detector = stage.detector();
    refused(guest.subscribe(nobody), "UNSUPPORTED");
    refused(guest.subscribe(detector.detection(), where(kit::equal("component_ref", nobody))), "UNSUPPORTED");
    refused(guest.subscribe(detector.detection(), where(kit::equal(nobody, "red"))), "BAD_PARAMETER");
}

void without_a_condition_events_of_all_components_come(Stage& stage) {
    Watch watch{stage};
    auto const id = ok(watch.owner.subscribe(watch.type())).text("subscribe_id");
    same("subscribe_id", id, watch.first_detection().text("subscribe_id"));
}

}  // namespace

Clause event_clause() {
    return {"7.4.1.5 Event interface",
            {{"every_event_can_be_subscribed", "figure 13; tables 5, 35 to 46", every_event_can_be_subscribed},
             {"an_event_is_received_with_its_ids", "figure 13; tables 6, 22", an_event_is_received_with_its_ids},
             {"each_event_has_an_id_of_its_own", "tables 6, 22; decision 8", each_event_has_an_id_of_its_own},
             {"details_of_an_event", "figure 13; tables 5, 23, 35", details_of_an_event},
             {"details_are_chosen_by_condition", "tables 5, 23; decision 19", details_are_chosen_by_condition},
             {"results_come_inline_when_asked_for", "decision 21", results_come_inline_when_asked_for},
             {"details_of_an_unknown_event_are_refused", "table 5; decision 21", details_of_an_unknown_event_are_refused},
             {"the_same_subscription_again_changes_nothing", "7.4.1.5; decision 20", the_same_subscription_again_changes_nothing},
             {"inline_results_are_taken_back", "decision 20", inline_results_are_taken_back},
             {"what_was_not_subscribed_is_not_received", "7.4.1.5", what_was_not_subscribed_is_not_received},
             {"what_does_not_run_is_silent", "table 32; decisions 6, 9", what_does_not_run_is_silent},
             {"two_applications_receive_the_same_event", "7.4.1.5; decision 20", two_applications_receive_the_same_event},
             {"after_unsubscribe_nothing_is_received", "figure 13", after_unsubscribe_nothing_is_received},
             {"unsubscribe_of_what_is_over_is_ok", "7.4.1.5; decision 20", unsubscribe_of_what_is_over_is_ok},
             {"only_events_that_match_are_received", "table 5; decision 19", only_events_that_match_are_received},
             {"what_cannot_happen_is_unsupported", "table 1; decision 18", what_cannot_happen_is_unsupported},
             {"without_a_condition_events_of_all_components_come", "table 5; decision 18",
              without_a_condition_events_of_all_components_come}}};
}

}  // namespace rois::conformance
