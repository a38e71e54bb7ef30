#include "command/recording/host.hpp"

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

#include "xml/codec/codec.hpp"

namespace rois::command {

namespace {

constexpr std::size_t kept = 10'000;  // notifications of a session, for `resume`
constexpr auto longest_unused = std::chrono::seconds{90};

// Good enough for tests and development: no protection against guessing is needed.
std::string fresh_id() {
    std::random_device chance;
    std::string id;
    for (int i = 0; i < 4; ++i) {
        char part[9];
        std::snprintf(part, sizeof part, "%08x", static_cast<unsigned>(chance()));
        id += part;
    }
    return id;
}

}  // namespace

void HostedSession::notify(Notification const& notification) {
    if (ended_) return;
    ++last_;
    log_.push_back({last_, std::string{xml::notification_head(notification)} + std::to_string(last_) +
                               xml::notification_tail(notification)});
    if (log_.size() > kept) log_.pop_front();
    wake();
}

HostedSession::Numbered const* HostedSession::after(std::uint64_t sequence) const {
    auto const found = std::ranges::upper_bound(log_, sequence, {}, &Numbered::sequence);
    return found == log_.end() ? nullptr : &*found;
}

asio::awaitable<void> HostedSession::wait(asio::steady_timer& timer) {
    auto const place = waiting_.insert(waiting_.end(), &timer);
    Failure failure;
    co_await timer.async_wait(into(failure));
    waiting_.erase(place);
}

void HostedSession::end() {
    ended_ = true;
    wake();
}

void HostedSession::wake() {
    for (auto* const timer : waiting_) timer->cancel();
}

std::shared_ptr<HostedSession> Host::open(Connect const& connect) {
    auto const session = std::make_shared<HostedSession>(SessionId{fresh_id()});
    session->guest = make_(*session, connect);
    sessions_.emplace(session->id().text, session);
    return session;
}

std::shared_ptr<HostedSession> Host::find(std::string const& id) const {
    auto const found = sessions_.find(id);
    return found == sessions_.end() ? nullptr : found->second;
}

void Host::end(HostedSession& session) {
    session.end();
    session.guest.reset();
    sessions_.erase(std::string{session.id().text});
}

void Host::end_unused() {
    auto const now = std::chrono::steady_clock::now();
    std::vector<std::shared_ptr<HostedSession>> unused;
    for (auto const& [id, session] : sessions_)
        if (session->connections == 0 && now - session->used > longest_unused) unused.push_back(session);
    for (auto const& session : unused) end(*session);
}

void Host::end_all() {
    while (!sessions_.empty()) {
        auto const session = sessions_.begin()->second;
        end(*session);
    }
}

}  // namespace rois::command
