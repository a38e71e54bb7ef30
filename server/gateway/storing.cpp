// What the journal and the sub engines tell the engine (docs/journal.md).
#include <chrono>
#include <memory>
#include <utility>

#include "engine/attempts.hpp"
#include "gateway/gateway.hpp"

namespace rois {

namespace {

Instant present() { return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()}; }

}  // namespace

// A stop, or its end, is answered when it is stored. A slow disk does not keep the answer back.
void Gateway::await_journal(Lock& lock) {
    constexpr std::chrono::milliseconds longest{20};
    auto const is_done = std::make_shared<bool>(false);
    engine_.when_stored([is_done] { *is_done = true; });
    engine_.flush();
    journal_done_.wait_for(lock, longest, [&] { return *is_done; });
}

Engine::EarlierSession Gateway::earlier_session(std::string const& provider) const {
    std::lock_guard const lock{mutex_};
    return engine_.earlier_session(provider);
}

void Gateway::session_opened_there(std::string const& provider, SessionId const& id, std::function<void()> then) {
    Lock const lock{*this};
    engine_.session_opened_there(provider, id);
    engine_.when_stored(std::move(then));
}

void Gateway::stopped_there(std::string const& provider, std::optional<std::uint64_t> stop) {
    Lock const lock{*this};
    engine_.stopped_there(provider, stop);
}

void Gateway::ended_there(std::string const& provider, std::vector<CommandEnded> ended) {
    auto const now = present();
    Lock lock{*this};
    engine_.ended_there(provider, std::move(ended), now);
    engine_.work(lock, now);
}

void Gateway::stored(bool all) {
    auto const now = present();
    Lock lock{*this};
    Attempts attempts;
    attempts([&] { all ? engine_.stored(now) : engine_.not_stored(now); });
    journal_done_.notify_all();
    attempts([&] { engine_.work(lock, now); });
}

}  // namespace rois
