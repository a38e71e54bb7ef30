#include "engine/conditions/effort.hpp"

namespace rois {

thread_local Effort::Turn* Effort::present_ = nullptr;

void Effort::begin_window(Account& account, Steady now) {
    if (now - begun_ >= window) {
        begun_ = now;
        used_ = 0;
        ++window_;
    }
    if (account.window != window_) account = {.window = window_, .used = 0};
}

bool Effort::has_left(Account& account, std::size_t sessions, Steady now) {
    begin_window(account, now);
    return !is_used_up(account, share(sessions));
}

bool Effort::take(Account& account, std::size_t sessions, Steady now, std::size_t steps) {
    if (!has_left(account, sessions, now)) return false;
    used_ += steps;
    account.used += steps;
    return true;
}

Effort::Turn::Turn(Effort& effort, Account& payer, std::size_t sessions, Steady now)
    : of_{effort}, payer_{payer}, share_{effort.share(sessions)}, outer_{present_} {
    effort.begin_window(payer, now);
    present_ = this;
}

void Effort::spend(std::size_t steps) {
    if (present_ == nullptr) return;
    auto& [effort, payer, share, outer] = *present_;
    effort.used_ += steps;
    payer.used += steps;
    if (effort.is_used_up(payer, share)) throw TooMuchEffort{};
}

}  // namespace rois
