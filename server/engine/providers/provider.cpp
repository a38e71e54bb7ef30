#include "engine/providers/provider.hpp"

#include <algorithm>
#include <exception>
#include <thread>
#include <utility>

#include "engine/providers/hosted_component.hpp"

namespace rois {

void ProvidersToRun::add(std::shared_ptr<Provider> provider) noexcept {
    if (std::exchange(provider->is_listed_, true)) return;
    if (providers_.size() == providers_.capacity()) {  // makes room without memory: no provider is listed twice
        providers_.erase(providers_.begin(), providers_.begin() + static_cast<std::ptrdiff_t>(std::exchange(taken_, 0)));
    }
    providers_.push_back(std::move(provider));
}

std::shared_ptr<Provider> ProvidersToRun::take() noexcept {
    if (providers_.empty()) return {};
    auto first = std::move(providers_[taken_++]);
    if (taken_ == providers_.size()) {
        providers_.clear();
        taken_ = 0;
    }
    first->is_listed_ = false;
    return first;
}

// From now on there is always room for a halt of each component.
void Provider::join(std::shared_ptr<HostedComponent> const& component) {
    std::lock_guard const lock{mutex_};
    if (std::ranges::find(components_, component) != components_.end()) return;
    calls_.reserve(calls_.size() + components_.size() + 1);
    components_.push_back(component);
}

void Provider::part(HostedComponent const& component) {
    std::lock_guard const lock{mutex_};
    std::erase_if(components_, [&](auto const& each) { return each.get() == &component; });
}

void Provider::add(Call call) {
    std::lock_guard const lock{mutex_};
    auto const room = calls_.size() + components_.size() + 1;
    if (calls_.capacity() < room) calls_.reserve(2 * room);
    calls_.push_back(std::move(call));
    call_runner();
}

// Without room for another call, drops a waiting halt of the component: there is room for one halt of each. The new one comes
// after all waiting calls, because a command among them must not begin after it.
void Provider::add_halt(std::shared_ptr<HostedComponent> component, Ticket ticket, Instant now) noexcept {
    std::lock_guard const lock{mutex_};
    if (calls_.size() == calls_.capacity()) {
        auto const waiting = calls_.begin() + static_cast<std::ptrdiff_t>(begun_);
        auto const halt = std::find_if(waiting, calls_.end(), [&](Call const& c) { return c.is_halt() && c.to == component; });
        if (halt != calls_.end()) calls_.erase(halt);
    }
    // The engine repeats a halt that fails: the failure is reported once.
    calls_.push_back({.to = std::move(component), .what = {}, .awaited = ticket, .now = now, .report = Report::once});
    call_runner();
}

bool Provider::run(Runner runner) {
    if (has_own_thread()) return false;
    Inbox::Attended const attended;
    std::unique_lock lock{mutex_};
    if (is_running_) return false;  // the other thread runs them, or leaves them
    run_waiting(lock, runner);
    return begun_ < calls_.size();
}

bool Provider::has_waiting(Runner runner) const {
    return begun_ < calls_.size() && (calls_[begun_].to || runner == Runner::clock);
}

void Provider::run_waiting(std::unique_lock<std::mutex>& lock, Runner runner) {
    if (is_running_) return;
    is_running_ = true;
    while (has_waiting(runner) && !closed_) {
        auto call = std::move(calls_[begun_++]);
        if (begun_ == calls_.size()) {
            calls_.clear();
            begun_ = 0;
        }
        lock.unlock();
        carry_out(call);
        call = {};
        lock.lock();
    }
    is_running_ = false;
}

void Provider::carry_out(Call const& call) noexcept {
    std::exception_ptr failure;
    auto const component_at = [&](std::size_t place) {
        std::lock_guard const lock{mutex_};
        return place < components_.size() ? components_[place] : nullptr;
    };
    try {
        call.to ? call.to->carry_out(call) : call.what(nullptr);
    } catch (...) {
        failure = std::current_exception();
    }
    // The reports that the component made before it threw come first.
    for (std::size_t i = 0; !call.to; ++i) {
        auto const component = component_at(i);
        if (!component) break;
        after(component);
    }
    if (call.to && !call.is_question) after(call.to);
    if (failure) report_failure(call.to, call.awaited, failure, call.report);
}

void Provider::after(std::shared_ptr<HostedComponent> const& component) noexcept {
    try {
        component->after_call();
    } catch (...) {
        report_failure(component, {}, std::current_exception(), Report::once);
    }
}

void Provider::report_failure(std::shared_ptr<HostedComponent> const& from, Awaited awaited, std::exception_ptr const& failure,
                              Report each) noexcept {
    try {
        std::string text;
        try {
            std::rethrow_exception(failure);
        } catch (std::exception const& exception) {
            text = exception.what();
        } catch (...) {
            text = from ? "the component threw an unknown exception" : "a device threw an unknown exception";
        }
        report(from, CallFailed{awaited, std::move(text), each});
    } catch (...) {
        if (from) from->lose_report();
    }
}

// The thread shares the provider: a call that blocks may outlast the engine.
void Provider::call_runner() noexcept {
    if (!has_own_thread()) return to_run_.add(shared_from_this());
    arrived_.notify_one();
    if (has_thread_) return;
    try {
        std::thread{[self = shared_from_this()] { self->work(); }}.detach();
        has_thread_ = true;
    } catch (std::exception const&) {
        has_thread_ = false;  // the next call tries again
    }
}

void Provider::work() {
    std::unique_lock lock{mutex_};
    while (!closed_) {
        run_waiting(lock, Runner::clock);
        arrived_.wait(lock, [&] { return closed_ || has_waiting(Runner::clock); });
    }
}

void Provider::report(std::shared_ptr<HostedComponent> from, InboxEntry::What what) {
    InboxEntries one;
    one.emplace_back(std::move(from), std::move(what));
    inbox_->add(entries_, std::move(one));
}

void Provider::close() {
    decltype(components_) components;
    decltype(calls_) calls;
    {
        std::lock_guard const lock{mutex_};
        closed_ = true;
        components.swap(components_);
        calls.swap(calls_);
        begun_ = 0;
        arrived_.notify_one();
    }
    inbox_->close(entries_);
}

}  // namespace rois
