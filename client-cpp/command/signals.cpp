#include "command/signals.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <utility>

#include "command/exit.hpp"

namespace rois::command {

namespace {

// One key press often sends two signals: from the terminal and from a parent process.
constexpr std::chrono::milliseconds same_signal{500};

sigset_t ends() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGUSR1);  // from the destructor
    return set;
}

}  // namespace

Signals::Signals() {
    auto const set = ends();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    signal(SIGPIPE, SIG_IGN);
    thread_ = std::thread{[this] { wait(); }};
}

Signals::~Signals() {
    {
        std::lock_guard const lock{mutex_};
        over_ = true;
    }
    pthread_kill(thread_.native_handle(), SIGUSR1);
    thread_.join();
}

void Signals::on_first(std::function<void()> callback) {
    std::lock_guard const calling{calling_};
    std::unique_lock lock{mutex_};
    callback_ = std::move(callback);
    if (!raised_ || !callback_) return;
    auto const now = callback_;
    lock.unlock();
    now();
}

bool Signals::raised() const {
    std::lock_guard const lock{mutex_};
    return raised_.has_value();
}

void Signals::wait() {
    auto const set = ends();
    while (true) {
        int number = 0;
        sigwait(&set, &number);
        {
            std::lock_guard const lock{mutex_};
            if (over_) return;
            if (number == SIGUSR1) continue;
            auto const now = std::chrono::steady_clock::now();
            if (raised_ && now - *raised_ < same_signal) continue;
            if (raised_ || !callback_) _exit(static_cast<int>(Exit::interrupted));
            raised_ = now;
        }
        std::lock_guard const calling{calling_};
        std::unique_lock lock{mutex_};
        auto const callback = callback_;
        lock.unlock();
        if (callback) callback();
    }
}

}  // namespace rois::command
