// Counts and judges exceptions that the gateway survives (docs/safety.md).
#pragma once

#include <array>
#include <exception>
#include <functional>
#include <mutex>

#include "gateway/process/telemetry.hpp"
#include "types/instant.hpp"

namespace rois {

// Logs and counts exceptions. All exceptions within 0.1 s are one incident. At the third incident within a second it gives the
// gateway up. Exceptions of one connection do not count as incidents: they end that connection. Thread-safe.
class Troubles {
public:
    using Where = Telemetry::Where;

    // `give_up`: called once, by the thread that reports the third incident. Not with the engine locked.
    Troubles(Telemetry& telemetry, std::function<void()> give_up) : telemetry_{telemetry}, give_up_{std::move(give_up)} {}

    void report(Where, std::exception_ptr const&, Steady now) noexcept;
    // Reports the exception that is being handled.
    void report(Where) noexcept;

private:
    bool is_too_much(Steady now);

    Telemetry& telemetry_;
    std::function<void()> give_up_;
    std::mutex mutex_;                   // guards the next two
    std::array<Steady, 3> incidents_{};  // when the last ones began, the latest first
    bool given_up_ = false;
};

}  // namespace rois
