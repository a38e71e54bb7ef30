// How the engine calls components and devices, and handles what they report (docs/engine.md).
#include <optional>
#include <thread>
#include <utility>

#include "engine/core.hpp"

namespace rois {

// Calls the components of one provider at a time, and handles the reports after each.
void Engine::Core::work(std::unique_lock<std::mutex>& lock, Instant now, Provider::Runner runner) {
    constexpr int most_turns = 100;   // of devices in one tick; later turns wait for the next tick
    constexpr int most_batches = 16;  // of reports that a client handles; the clock handles the rest
    Attempts attempts;
    for (int batches = 0;;) {
        auto provider = to_run_.take();
        if (!provider && runner == Provider::Runner::clock) provider = left_for_clock_.take();
        if (provider) {
            flush();
            lock.unlock();
            bool const left = provider->run(runner);
            lock.lock();
            if (left) leave_for_clock(std::move(provider));
        } else if (has_reports()) {  // more than `settle` has handled
            if (runner == Provider::Runner::client && ++batches > most_batches) {
                inbox_->wake();
                break;
            }
            flush();
            lock.unlock();
            std::this_thread::yield();
            lock.lock();
        } else if (runner == Provider::Runner::clock && turns_ < most_turns && devices_go_on()) {
            attempts([&] { advance_devices(now); });
        } else if (runner == Provider::Runner::client || !deadlines_.carry_out_next(last_due_, now, attempts)) {
            break;
        }
        if (!attempts([&] { settle(now); })) break;
    }
    flush();
    if (runner == Provider::Runner::clock) attempts.rethrow();
    if (!attempts.failure()) return;
    if (is_handled_again_)
        inbox_->wake();
    else
        unsettled_ = attempts.failure();
}

void Engine::Core::leave_for_clock(std::shared_ptr<Provider> provider) {
    left_for_clock_.add(std::move(provider));
    inbox_->wake();
}

// A failing device is reported once, until it succeeds again. Each tick advances it, because the cause may have been a lack of
// memory.
void Engine::Core::advance_devices(Instant now) {
    ++turns_;
    for (auto const& state : devices_) {
        if (state->is_due.exchange(true)) continue;
        auto const advance = [state, now](Component*) {
            bool const reported = std::exchange(state->failed, true);
            state->is_due = false;
            try {
                state->device->advance(now);
                state->goes_on = state->device->goes_on();
                state->failed = false;
            } catch (...) {
                if (!reported) throw;
            }
        };
        state->provider->add({.to = {}, .what = advance});
    }
}

// Returns whether a device has another turn in this tick. A device that fails has none.
bool Engine::Core::devices_go_on() {
    return std::ranges::any_of(devices_, [](auto const& state) { return state->goes_on.exchange(false); });
}

// Handles the errors that the engine has found and the reports of components, also those that are added meanwhile, but not more
// than fit into a short time. The next tick retries what fails.
void Engine::Core::settle(Instant now) {
    Attempts attempts;
    is_handled_again_ = false;
    handle_reports(now, attempts);
    while (notifier_.take_overflowed()) {
        mark_overflowed();
        end_marked_sessions(now, attempts);
        handle_reports(now, attempts);
    }
    attempts([&] { call_owners(now); });
    attempts.rethrow();
}

void Engine::Core::handle_reports(Instant now, Attempts& attempts) {
    constexpr int most_entries = 64;
    constexpr std::uint64_t most_notifications = 4'000;
    auto const enough = notifier_.pushed() + most_notifications;
    Notifier::Meanwhile const meanwhile{notifier_, NotificationQueue::ForCurrent::unless_delayed};
    for (int entries = 0; entries < most_entries && notifier_.pushed() < enough; ++entries) {
        while (auto* error = agenda_.front()) {
            is_handled_again_ = !attempts([&] { publish(*error, now, attempts); });
            if (is_handled_again_) return;
            agenda_.pop();
        }
        auto entry = inbox_->take();
        if (entry.empty()) return;
        if (attempts([&] { handle(entry.front(), now, attempts); })) continue;
        inbox_->put_back(std::move(entry));
        is_handled_again_ = true;
        return;
    }
}

void Engine::Core::handle(InboxEntry& entry, Instant now, Attempts& deliveries) {
    if (!entry.from) return agenda_.add({nullptr, ErrorType::engine_internal_error, std::get<CallFailed>(entry.report).text});
    if (entry.from->registered == nullptr) return;
    auto& component = *entry.from->registered;
    component.end_silence();
    // A component of another engine also reports while an operation is performed that does not concern it.
    std::optional<Notifier::Meanwhile> meanwhile;
    if (component.confirms_binding()) meanwhile.emplace(notifier_, NotificationQueue::ForCurrent::does_not_wait);
    struct Handler {
        Core& core;
        RegisteredComponent& component;
        Instant now;
        Attempts& deliveries;
        void operator()(CommandStarted const& report) { core.executor_.started(report.command); }
        void operator()(CommandEnded& report) { core.executor_.completed(report, now); }
        void operator()(HaltConfirmed const& report) { core.executor_.halted(component, report.ticket, now); }
        void operator()(HaltFailed const& report) { core.executor_.halt_failed(component, report.ticket, now); }
        void operator()(EventOccurred const& report) { core.publish(component, report, now, deliveries); }
        void operator()(ErrorOccurred const& report) {
            bool const is_silence = report.type == ErrorType::component_not_responding;
            if (is_silence) return component.report_no_response(report.text, report.report, now.steady);
            // A halt that fails is repeated, and fails for the same reason.
            component.report(report.type, report.text, component.has_failed_to_halt() ? Report::once : report.report);
        }
        void operator()(StateChanged const& state) {
            auto const before = component.status_for(component.bound_to);
            component.accept(*state);
            if (component.is_member && component.status_for(component.bound_to) != before) core.notify_owners(component, now);
        }
        void operator()(OperationAsked& report) { core.perform(component, std::move(report), now); }
        void operator()(MemberSwitched& report) { core.publish(component, std::move(report)); }
        void operator()(Answered& report) {
            if (!core.questions_.answered(report.ticket, std::move(report.answer), now)) core.executor_.count_stray_answer();
        }
    };
    if (auto* failure = std::get_if<CallFailed>(&entry.report)) return handle(component, *failure, now);
    std::visit(Handler{*this, component, now, deliveries}, std::get<ComponentReport>(entry.report));
}

void Engine::Core::handle(RegisteredComponent& component, CallFailed& failure, Instant now) {
    auto const* ticket = std::get_if<Ticket>(&failure.awaited);
    bool const of_halt = ticket != nullptr && !questions_.is_open(*ticket);
    bool const was_reported = of_halt && component.has_failed_to_halt();
    component.report_failure(failure.text, was_reported ? Report::once : failure.report);
    if (auto const* command = std::get_if<CommandHandle>(&failure.awaited)) executor_.failed(*command, now);
    if (ticket == nullptr) return;
    if (of_halt) return executor_.halt_failed(component, *ticket, now);
    questions_.answered(*ticket, Failed{std::move(failure.text)}, now);
}

}  // namespace rois
