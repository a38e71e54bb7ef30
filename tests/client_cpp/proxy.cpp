#include "client_cpp/proxy.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace rois::test {

namespace {

// Closes a connection with a reset.
void close_hard(int descriptor) {
    linger const now{1, 0};
    setsockopt(descriptor, SOL_SOCKET, SO_LINGER, &now, sizeof now);
    close(descriptor);
}

}  // namespace

Proxy::Proxy(std::uint16_t gateway) : wake_{eventfd(0, EFD_CLOEXEC)}, gateway_{gateway} {
    thread_ = std::thread{[this] { run(); }};
}

Proxy::~Proxy() {
    ending_ = true;
    wake();
    thread_.join();
    cut_all();
    close(wake_);
}

void Proxy::wake() const {
    std::uint64_t const one = 1;
    if (write(wake_, &one, sizeof one) < 0) throw std::runtime_error{"the proxy cannot be woken"};
}

void Proxy::cut() {
    std::lock_guard const lock{mutex_};
    if (!pairs_.empty()) ++cuts_;
    cut_all();
}

void Proxy::cut_at_random(std::uint32_t seed, std::size_t longest, std::size_t times) {
    std::lock_guard const lock{mutex_};
    dice_.seed(seed);
    longest_ = longest;
    times_ = times;
    evenly_ = false;
    left_ = next_cut();
}

void Proxy::cut_every(std::size_t bytes, std::size_t times) {
    std::lock_guard const lock{mutex_};
    longest_ = left_ = bytes;
    times_ = times;
    evenly_ = true;
}

void Proxy::cut_before(std::string text) {
    std::lock_guard const lock{mutex_};
    before_ = std::move(text);
}

void Proxy::misquote(std::string text, std::string as) {
    if (text.size() != as.size()) throw std::invalid_argument{"misquote: both texts must have the same length"};
    std::lock_guard const lock{mutex_};
    misquoted_ = std::move(text);
    misquoted_as_ = std::move(as);
}

void Proxy::half_open() {
    std::lock_guard const lock{mutex_};
    for (auto& pair : pairs_) pair.swallows = true;
}

void Proxy::refuse(bool refuses) {
    std::lock_guard const lock{mutex_};
    refuses_ = refuses;
}

void Proxy::lead_to(std::uint16_t gateway) {
    std::lock_guard const lock{mutex_};
    gateway_ = gateway;
}

void Proxy::delay(std::chrono::milliseconds time) {
    std::lock_guard const lock{mutex_};
    delay_ = time;
    drip_ = 0;
}

void Proxy::drip(std::size_t bytes, std::chrono::milliseconds each) {
    std::lock_guard const lock{mutex_};
    delay_ = each;
    drip_ = bytes;
}

void Proxy::cut_all() {
    for (auto const& pair : pairs_) {
        close_hard(pair.client);
        close_hard(pair.gateway);
    }
    pairs_.clear();
    wake();
}

// Counts passed bytes. Returns whether a cut is due.
bool Proxy::tears(std::size_t bytes) {
    if (times_ == 0) return false;
    if (bytes < left_) {
        left_ -= bytes;
        return false;
    }
    --times_;
    left_ = next_cut();
    return true;
}

void Proxy::accept() {
    auto const accepted = listener_.accept();
    if (!accepted) return;
    auto const client = *accepted;
    ++accepted_;
    auto const gateway = refuses_ ? -1 : kit::try_connect_to(gateway_);
    if (gateway < 0) {
        close_hard(client);
        return;
    }
    pairs_.push_back({client, gateway, false, {}, {}});
}

// Reads the waiting bytes. Returns false if this side has closed.
bool Proxy::pass(Pair& pair, int from, Direction& direction) {
    std::array<char, 16 * 1024> bytes;
    auto const size = recv(from, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (size < 0) return errno == EAGAIN || errno == EINTR;
    if (size == 0) return false;
    if (pair.swallows) return true;
    if (direction.waiting.empty()) direction.due = Clock::now() + delay_;
    direction.waiting.append(bytes.data(), static_cast<std::size_t>(size));
    return true;
}

void Proxy::send_due(Pair& pair) {
    auto const now = Clock::now();
    for (auto [to, direction] : {std::pair{pair.gateway, &pair.to_gateway}, std::pair{pair.client, &pair.to_client}}) {
        if (direction->waiting.empty() || direction->due > now) continue;
        auto const size = drip_ == 0 ? direction->waiting.size() : std::min(drip_, direction->waiting.size());
        auto const sent = send(to, direction->waiting.data(), size, MSG_NOSIGNAL);
        direction->waiting.erase(0, sent < 0 ? size : static_cast<std::size_t>(sent));
        direction->due = now + delay_;
    }
}

int Proxy::wait_time() const {
    auto next = Clock::time_point::max();
    for (auto const& pair : pairs_)
        for (auto const* direction : {&pair.to_gateway, &pair.to_client})
            if (!direction->waiting.empty()) next = std::min(next, direction->due);
    if (next == Clock::time_point::max()) return -1;
    auto const left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now()).count();
    return static_cast<int>(std::max<std::int64_t>(left, 0));
}

void Proxy::run() {
    while (!ending_) {
        std::vector<pollfd> watched{{listener_.descriptor(), POLLIN, 0}, {wake_, POLLIN, 0}};
        int time = 0;
        {
            std::lock_guard const lock{mutex_};
            for (auto const& pair : pairs_) {
                watched.push_back({pair.client, POLLIN, 0});
                watched.push_back({pair.gateway, POLLIN, 0});
            }
            time = wait_time();
        }
        poll(watched.data(), watched.size(), time);
        std::lock_guard const lock{mutex_};
        if (watched[1].revents != 0) {
            std::uint64_t count = 0;
            if (read(wake_, &count, sizeof count) < 0) return;
            continue;  // pairs_ has changed
        }
        bool tear = false;
        auto index = std::size_t{2};
        for (auto pair = pairs_.begin(); pair != pairs_.end(); index += 2) {
            auto const before = pair->to_client.waiting.size() + pair->to_gateway.waiting.size();
            bool alive = true;
            if (watched[index].revents != 0) alive = pass(*pair, pair->client, pair->to_gateway);
            if (watched[index + 1].revents != 0) alive = pass(*pair, pair->gateway, pair->to_client) && alive;
            auto const quoted = pair->to_client.waiting.find(misquoted_);
            if (!misquoted_.empty() && quoted != pair->to_client.waiting.npos) {
                pair->to_client.waiting.replace(quoted, misquoted_.size(), misquoted_as_);
                misquoted_.clear();
            }
            auto const said = pair->to_client.waiting.find(before_);
            if (!before_.empty() && said != pair->to_client.waiting.npos) {
                pair->to_client.waiting.erase(said);
                before_.clear();
                tear = true;
            }
            auto const after = pair->to_client.waiting.size() + pair->to_gateway.waiting.size();
            tear = (after > before && tears(after - before)) || tear;
            if (tear && pair->to_client.waiting.size() > 1) pair->to_client.waiting.resize(pair->to_client.waiting.size() / 2);
            send_due(*pair);
            if (alive) {
                ++pair;
                continue;
            }
            close_hard(pair->client);
            close_hard(pair->gateway);
            pair = pairs_.erase(pair);
        }
        if (tear) {  // even if the other side has closed meanwhile
            ++cuts_;
            cut_all();
        }
        if (watched[0].revents != 0) accept();
    }
}

}  // namespace rois::test
