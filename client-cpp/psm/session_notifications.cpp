// Passes the engine's notifications from the client's thread to the receivers on the notification thread.
#include <algorithm>
#include <utility>

#include "psm/documents.hpp"
#include "psm/session.hpp"

namespace rois::psm {

using RoIS_HRI::ReturnCode_t;

namespace {

constexpr std::string_view own_error = "rois-psm-";
constexpr std::size_t most_errors = 1'000;

static_assert(static_cast<RoIS_Service::Completed_Status>(CompletedStatus::timeout) == RoIS_Service::TIMEOUT);
static_assert(static_cast<RoIS_Service::ErrorType>(ErrorType::user_defined_error) == RoIS_Service::USER_DEFINED_ERROR);

}  // namespace

// --- Notifications: received on the client's thread, delivered on the notification thread ---

Observers Session::observers() {
    Observers all;
    all.notification = [this](Notification const& notification, std::uint64_t) { take(notification); };
    all.gap = [this](Gap const& gap) { take_gap(gap); };
    all.state = [this](StateChange const& change) { take_state(change); };
    return all;
}

void Session::post(Delivery::Kind kind, std::function<void()> run) {
    if (delivery_.post(kind, std::move(run)) || dropping_.exchange(true)) return;
    report("events were dropped: the application's functions take too long");
    delivery_.post(Delivery::Kind::kept, [this] { dropping_ = false; });
}

void Session::take(Notification const& notification) {
    if (auto const* const event = std::get_if<ReceiveEvent>(&notification)) take(*event);
    if (auto const* const error = std::get_if<ReceiveError>(&notification)) {
        post(Delivery::Kind::kept, [this, id = error->error_id.text,
                                    type = static_cast<RoIS_Service::ErrorType>(error->error_type)] { deliver_error(id, type); });
    }
    if (auto const* const command = std::get_if<Completed>(&notification)) {
        auto const id = command->command_id.text;
        {
            std::lock_guard const lock{mutex_};
            running_.erase(id);
        }
        post(Delivery::Kind::kept, [this, id, status = static_cast<RoIS_Service::Completed_Status>(command->status)] {
            deliver_completed(id, status);
        });
    }
}

void Session::take(ReceiveEvent const& event) {
    post(Delivery::Kind::droppable, [this, event] {
        std::vector<RoIS_Service::ServiceApplicationBase*> applications;
        std::vector<RoIS_Common::Event*> events;
        std::string id = event.subscribe_id.text;
        {
            std::lock_guard const lock{mutex_};
            auto const known =
                std::ranges::find_if(subscriptions_, [&](auto const& each) { return each.second.engine_id == id; });
            if (known == subscriptions_.end()) return;
            id = known->first;
            if (known->second.by_application) applications = applications_;
            for (auto* const each : events_) {
                auto const bound = bound_of(each->component_type());
                bool const meant = !bound || *bound == event.component_ref.code;
                if (known->second.by_receivers && meant && known->second.condition == condition_on_type(each->component_type()))
                    events.push_back(each);
            }
        }
        for (auto* const each : applications)
            delivery_.call(each, [&] { each->notify_event(event.event_id.text, event.event_type, id, to_text(event.expire)); });
        EventResults const results{event.results ? event.results->parameters : ParameterList{}};
        for (auto* const each : events) delivery_.call(each, [&] { each->deliver(event.event_type, results); });
    });
}

void Session::take_gap(Gap const& gap) {
    if (gap.why == Gap::Why::dropped) {
        report((gap.count ? std::to_string(*gap.count) : std::string{"some"}) + " notifications were lost");
        return;
    }
    std::string lost;
    {
        std::lock_guard const lock{mutex_};
        for (auto const& what : gap.not_restored) {
            std::erase_if(bound_, [&](Bound const& each) { return what.starts_with("bind " + each.ref + ": "); });
            lost += "; not restored: " + what;
        }
    }
    abort_commands();
    report("the engine's session ended with the link; a new session replaces it" + lost);
    post(Delivery::Kind::kept, [this] { subscribe_again(); });
}

void Session::take_state(StateChange const& change) {
    if (!client()) return;  // connect() reports its own failure
    if (change.state == State::lost) report("the link is lost: " + change.reason + "; connecting again");
    if (change.state != State::closed) return;
    abort_commands();
    if (!change.reason.empty()) report("the connection is closed: " + change.reason);
}

void Session::abort_commands() {
    std::set<std::string> ended;
    {
        std::lock_guard const lock{mutex_};
        ended = std::exchange(running_, {});
    }
    for (auto const& id : ended) post(Delivery::Kind::kept, [this, id] { deliver_completed(id, RoIS_Service::ABORT); });
}

void Session::report(std::string text) {
    std::string id;
    {
        std::lock_guard const lock{mutex_};
        id = std::string{own_error} + std::to_string(++last_error_);
        errors_.emplace(id, std::move(text));
        if (errors_.size() > most_errors) errors_.erase(std::string{own_error} + std::to_string(last_error_ - most_errors));
    }
    delivery_.post(Delivery::Kind::kept, [this, id] { deliver_error(id, RoIS_Service::ENGINE_INTERNAL_ERROR); });
}

ReturnCode_t Session::get_error_detail(std::string const& id, std::string_view condition, Results& results) {
    {
        std::lock_guard const lock{mutex_};
        auto const own = errors_.find(id);
        if (own != errors_.end()) {
            results = {{text("text", own->second)}, {}};
            set_reason({});
            return RoIS_HRI::OK;
        }
    }
    return send<GetErrorDetail::Reply>(condition, request_with_condition("get_error_detail", {{"error_id", id}}, condition),
                                       [&](GetErrorDetail::Reply const& reply, std::string const&) { results = reply.results; });
}

std::vector<RoIS_Service::ServiceApplicationBase*> Session::applications() const {
    std::lock_guard const lock{mutex_};
    return applications_;
}

void Session::deliver_error(std::string const& id, RoIS_Service::ErrorType type) {
    for (auto* const each : applications()) delivery_.call(each, [&] { each->notify_error(id, type); });
}

void Session::deliver_completed(std::string const& id, RoIS_Service::Completed_Status status) {
    for (auto* const each : applications()) delivery_.call(each, [&] { each->completed(id, status); });
}

// --- Receivers ---

template <class Receiver>
void Session::add_to(std::vector<Receiver*>& receivers, Receiver* receiver) {
    std::lock_guard const lock{mutex_};
    receivers.push_back(receiver);
    new_.insert(receiver);
}

template <class Receiver>
void Session::remove_from(std::vector<Receiver*>& receivers, Receiver* receiver) {
    {
        std::lock_guard const lock{mutex_};
        std::erase(receivers, receiver);
        new_.erase(receiver);
    }
    delivery_.end(receiver);
}

void Session::add(RoIS_Service::ServiceApplicationBase* application) { add_to(applications_, application); }
void Session::remove(RoIS_Service::ServiceApplicationBase* application) { remove_from(applications_, application); }
void Session::add(RoIS_Common::Event* event) { add_to(events_, event); }
void Session::remove(RoIS_Common::Event* event) { remove_from(events_, event); }

}  // namespace rois::psm
