// How an event reaches the sessions that have subscribed to it (decisions 18 to 22).
#include <optional>
#include <utility>
#include <vector>

#include "engine/core.hpp"

namespace rois {

namespace {

// Steps of an Effort, besides those of the comparison itself.
constexpr std::size_t steps_of_a_perspective = 200;  // the component as one subscriber sees it
constexpr std::size_t steps_of_a_delivery = 32;
constexpr std::size_t steps_of_a_full_queue = 600;  // a waiting event gives way

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

// An event on its way to its subscribers.
class Engine::Core::Delivery {
public:
    Delivery(Core& core, RegisteredComponent& component, std::string const& event_type, SharedResults const& results, Instant now,
             Attempts& attempts)
        : core_{core}, component_{component}, event_type_{event_type}, results_{results}, now_{now}, attempts_{attempts} {
        ++core_.event_;
    }

    // Returns whether a subscription matches.
    bool to_all() {
        for (auto* subscription : core_.subscriptions_.possible(event_type_, component_)) {
            if (has_begun_)
                attempts_([&] { to_subscribers(*subscription); });
            else
                to_subscribers(*subscription);
        }
        return !event_id_.empty();
    }

private:
    using Subscriber = Subscription::Subscriber;

    void to_subscribers(Subscription const&);
    void find_receivers(Subscription const&);
    // Compares, on behalf of this subscriber. nullopt: it has no steps left.
    std::optional<bool> matches(Subscription const&, Subscriber const&, bool for_it_alone);
    bool may_receive(Subscription const&, Subscriber const&);
    void miss(Subscriber const&);
    bool has_missed(Subscriber const& one) const { return one.session->missed == core_.event_; }
    bool is_seen_with(Rights const*);

    Core& core_;
    RegisteredComponent& component_;
    std::string const& event_type_;
    SharedResults const& results_;
    Instant const now_;
    Attempts& attempts_;
    Perspective no_asker_ = core_.perspective(nullptr, Perspective::Of::present);
    MessageCandidate const candidate_{no_asker_.candidate(component_), *results_};
    std::string event_id_;    // made when a subscriber matches
    bool has_begun_ = false;  // some subscriber may have been notified
    std::vector<Subscriber const*> receivers_, undecided_;
    Rights const* rights_ = nullptr;  // for which `is_seen_` holds: many subscribers have the same
    bool is_seen_ = true;
};

void Engine::Core::Delivery::to_subscribers(Subscription const& subscription) {
    find_receivers(subscription);
    if (receivers_.empty()) return;
    if (event_id_.empty()) {
        auto const& profile = component_.entry().profile;
        event_id_ = core_.events_.add(results_, {profile, find_message(*profile, MessageKind::event, event_type_)}, now_);
    }
    EventNotifications notifications{{.event_id = {event_id_},
                                      .event_type = event_type_,
                                      .subscribe_id = subscription.id,
                                      .expire = now_.utc + core_.events_.kept_for(),
                                      .component_ref = component_.ref(),
                                      .results = nullptr},
                                     results_};
    has_begun_ = true;
    for (auto const* one : receivers_) {
        if (!may_receive(subscription, *one)) {
            miss(*one);
            continue;
        }
        attempts_([&] {
            core_.events_.add_receiver(one->slot);
            core_.notifier_.notify(*one->queue, notifications.of(one->inline_results), component_.answer_to(*one->session));
        });
    }
}

// All subscribers that may see everything share one match. The first of them with steps left pays for it.
void Engine::Core::Delivery::find_receivers(Subscription const& subscription) {
    bool const restricts = subscription.filter.restricts();
    std::optional<bool> common = restricts ? std::nullopt : std::optional{true};
    receivers_.clear();
    undecided_.clear();
    for (auto const& one : subscription.subscribers) {
        if ((restricts && has_missed(one)) || !is_seen_with(one.rights)) continue;
        bool const alone = subscription.filter.depends_on_asker() || (restricts && !may_see_everything(one.rights));
        auto met = alone ? std::nullopt : common;
        if (!met) met = matches(subscription, one, alone);
        if (!met) (alone ? miss(one) : undecided_.push_back(&one));
        if (met && !alone) common = met;
        if (met.value_or(false)) receivers_.push_back(&one);
    }
    for (auto const* one : undecided_)
        if (!common)
            miss(*one);
        else if (*common)
            receivers_.push_back(one);
}

std::optional<bool> Engine::Core::Delivery::matches(Subscription const& subscription, Subscriber const& one, bool for_it_alone) {
    return core_.paid_by(*one.session, now_, [&] {
        if (!for_it_alone) return subscription.filter.match(candidate_) == Match::yes;
        Effort::spend(steps_of_a_perspective);
        auto as_it_sees = core_.perspective(one.session, Perspective::Of::present);
        return subscription.filter.match(MessageCandidate{as_it_sees.candidate(component_), *results_}) == Match::yes;
    });
}

// A session may have very many subscriptions with a condition to one event.
bool Engine::Core::Delivery::may_receive(Subscription const& subscription, Subscriber const& one) {
    if (!subscription.filter.restricts()) return true;
    auto const steps = one.queue->is_full() ? steps_of_a_full_queue : steps_of_a_delivery;
    return core_.delivery_effort_.take(one.session->deliveries, core_.sessions_.size(), now_.steady, steps);
}

// The session has no steps left. It receives a `Lost`: perhaps it has missed this event.
void Engine::Core::Delivery::miss(Subscriber const& one) {
    if (std::exchange(one.session->missed, core_.event_) == core_.event_) return;
    core_.effort_.count_refusal();
    has_begun_ = true;
    attempts_([&] { core_.notifier_.lose(*one.queue, component_.answer_to(*one.session)); });
}

bool Engine::Core::Delivery::is_seen_with(Rights const* rights) {
    if (std::exchange(rights_, rights) != rights) is_seen_ = may_see(rights, component_.ref().code);
    return is_seen_;
}

bool Engine::Core::deliver(RegisteredComponent& component, std::string const& event_type, SharedResults const& results,
                           Instant now, Attempts& deliveries) {
    return Delivery{*this, component, event_type, results, now, deliveries}.to_all();
}

}  // namespace rois
