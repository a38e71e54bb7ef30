#include "gateway/process/troubles.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "engine/attempts.hpp"

namespace rois {

namespace {

constexpr std::chrono::milliseconds one_incident{100};
constexpr std::chrono::seconds too_short{1};  // from the first to the last of the stored incidents

void log(Telemetry::Where where, std::exception_ptr const& failure) {
    auto const name = name_of(where);
    try {
        std::rethrow_exception(failure);
    } catch (std::exception const& error) {
        spdlog::error("exception in {}, the gateway goes on: {}", name, error.what());
    } catch (...) {
        spdlog::error("exception in {}, the gateway goes on", name);
    }
}

}  // namespace

void Troubles::report(Where where, std::exception_ptr const& failure, Steady now) noexcept {
    telemetry_.survived(where);
    Attempts attempts;  // counts also if logging fails
    attempts([&] { log(where, failure); });
    if (where != Where::connection && is_too_much(now)) give_up_();
}

void Troubles::report(Where where) noexcept { report(where, std::current_exception(), std::chrono::steady_clock::now()); }

// Returns true at the third incident within a second, but only once.
bool Troubles::is_too_much(Steady now) {
    std::lock_guard const lock{mutex_};
    bool const first = incidents_.front() == Steady{};
    if (!first && now - incidents_.front() < one_incident) return false;
    incidents_ = {now, incidents_[0], incidents_[1]};
    bool const full = incidents_.back() != Steady{};
    if (!full || now - incidents_.back() > too_short) return false;
    return !std::exchange(given_up_, true);
}

}  // namespace rois
