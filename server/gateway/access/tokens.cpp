#include "gateway/access/tokens.hpp"

#include <openssl/crypto.h>

#include <algorithm>
#include <utility>

namespace rois {

namespace {

constexpr auto minute = std::chrono::minutes{1};
constexpr auto between_tidying = std::chrono::seconds{1};
constexpr std::size_t most_addresses = 10'000;  // whose wrong tokens are counted

bool is_same(Principal const& a, Principal const& b) {
    return a.name() == b.name() && a.role == b.role && a.hash == b.hash && a.expires == b.expires &&
           a.rights->seen() == b.rights->seen() && a.rights->commanded() == b.rights->commanded();
}

}  // namespace

void Tokens::set(std::vector<std::shared_ptr<Principal>> tokens) {
    std::lock_guard const lock{mutex_};
    std::vector<Holder> next;
    next.reserve(tokens.size());
    for (auto& token : tokens) {
        auto const known =
            std::ranges::find_if(all_, [&](Holder const& each) { return !each->is_over() && is_same(*each, *token); });
        next.push_back(known == all_.end() ? Holder{std::move(token)} : *known);
    }
    for (auto const& each : all_) {
        if (std::ranges::find(next, each) != next.end()) continue;
        each->rights->withdraw();
        some_ended_ = true;
    }
    all_ = std::move(next);
}

void Tokens::add(std::shared_ptr<Principal> token) {
    std::lock_guard const lock{mutex_};
    std::erase_if(all_, [](Holder const& each) { return each->is_over(); });
    all_.push_back(std::move(token));
}

void Tokens::limit(std::size_t most_wrong) {
    std::lock_guard const lock{mutex_};
    most_wrong_ = most_wrong;
}

std::variant<Tokens::Holder, Tokens::Refused> Tokens::holder(std::string_view token, Address const& from, Instant now) {
    auto const hash = sha256(token);
    std::lock_guard const lock{mutex_};
    Holder found;
    for (auto const& each : all_)
        if (CRYPTO_memcmp(each->hash.data(), hash.data(), hash.size()) == 0) found = each;
    bool const expired = found && found->expires && *found->expires <= now.utc;
    if (found && !found->is_over() && !expired) return found;
    return is_too_many(from, now.steady) ? Refused::too_many : Refused::wrong;
}

Tokens::Holder Tokens::holder_of(std::string const& rights_id) {
    std::lock_guard const lock{mutex_};
    auto const is_it = [&](Holder const& each) { return !each->is_over() && each->rights->id() == rights_id; };
    auto const found = std::ranges::find_if(all_, is_it);
    return found == all_.end() ? nullptr : *found;
}

bool Tokens::is_too_many(Address const& from, Steady now) {
    auto const is_old = [&](auto const& each) { return now - each.second.since >= minute; };
    if (wrong_.size() >= most_addresses && now - tidied_ >= between_tidying) {
        tidied_ = now;
        std::erase_if(wrong_, is_old);
    }
    if (wrong_.size() >= most_addresses && !wrong_.contains(from)) return true;
    auto& wrong = wrong_.try_emplace(from, 0U, now).first->second;
    if (now - wrong.since >= minute) wrong = {0, now};
    return ++wrong.count > most_wrong_;
}

bool Tokens::end_expired(std::chrono::system_clock::time_point now) {
    std::lock_guard const lock{mutex_};
    for (auto const& each : all_) {
        if (!each->expires || *each->expires > now || each->is_over()) continue;
        each->rights->withdraw();
        some_ended_ = true;
    }
    return std::exchange(some_ended_, false);
}

}  // namespace rois
