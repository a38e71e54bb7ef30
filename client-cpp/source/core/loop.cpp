#include "core/loop.hpp"

namespace rois::client {

namespace {

constexpr auto until_recovery = std::chrono::milliseconds{10};  // the system may have memory again

}  // namespace

Loop::Loop() : work_{asio::make_work_guard(io_)}, timer_{io_} {}

Loop::Ticket Loop::at(Steady time, std::function<void()> ring) {
    if (finishing_) return 0;
    auto const ticket = ++last_ticket_;
    alarms_.emplace(std::pair{time, ticket}, std::move(ring));
    times_.emplace(ticket, time);
    arm();
    return ticket;
}

void Loop::cancel(Ticket ticket) {
    auto const found = times_.find(ticket);
    if (found == times_.end()) return;
    alarms_.erase({found->second, ticket});
    times_.erase(found);
}

// Sets the timer only for an earlier alarm: most alarms are deadlines that are cancelled before they expire.
void Loop::arm() {
    if (alarms_.empty() || alarms_.begin()->first.first >= armed_) return;
    armed_ = alarms_.begin()->first.first;
    timer_.expires_at(armed_);
    timer_.async_wait([this](error_code error) {
        if (error) return;
        armed_ = Steady::max();
        auto const now = std::chrono::steady_clock::now();
        while (!alarms_.empty() && alarms_.begin()->first.first <= now) {
            auto due = alarms_.extract(alarms_.begin());
            times_.erase(due.key().second);
            due.mapped()();
        }
        arm();
    });
}

void Loop::start(std::shared_ptr<void> owner, std::function<void()> recover) {
    thread_ = std::thread{[this, owner = std::move(owner), recover = std::move(recover)] {
        own_id_ = std::this_thread::get_id();
        run(recover);  // until it is stopped by `finish`
        io_.restart();
        while (io_.poll() > 0) {  // runs the handlers of cancelled operations
        }
        finished_.set_value(io_.stopped() ? Left::nothing : Left::something);
        io_.run();
        end();
    }};
}

void Loop::run(std::function<void()> const& recover) {
    bool is_interrupted = false;
    while (true) {
        try {
            if (std::exchange(is_interrupted, false)) {
                arm();
                recover();
            }
            io_.run();
            return;
        } catch (std::exception const&) {
            if (!recover) throw;
            is_interrupted = true;
            std::this_thread::sleep_for(until_recovery);
        }
    }
}

// Functions that were posted before over_ was set still run.
void Loop::end() {
    {
        std::lock_guard const lock{over_mutex_};
        over_ = true;
    }
    io_.restart();
    io_.run();
    own_id_ = std::thread::id{};
}

void Loop::finish() {
    finishing_ = true;
    alarms_.clear();
    times_.clear();
    timer_.cancel();
    work_.reset();
    io_.stop();
}

void Loop::join() {
    if (is_here() || finished_.get_future().get() == Left::something) {
        thread_.detach();
    } else {
        thread_.join();
    }
}

}  // namespace rois::client
