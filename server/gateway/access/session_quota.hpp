// Limits the open sessions of a connection and of a remote address.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>

#include "gateway/access/addresses.hpp"

namespace rois {

// A connection that opens sessions.
struct Opener {
    Address address{};
    Limits limits = Limits::none;
    std::size_t sessions = 0;  // open sessions that it has opened; only the quota uses it
};

// A session counts for the connection that opened it and for that connection's address until the session ends, whichever
// connections use it later. Not thread-safe: the gateway's mutex guards it.
class SessionQuota {
public:
    SessionQuota(std::size_t most_of_connection, std::size_t most_of_address)
        : most_of_connection_{most_of_connection}, most_of_address_{most_of_address} {}

    enum class Verdict : std::uint8_t { open, full_connection, full_address };
    Verdict verdict(Opener const& opener) const {
        if (opener.limits == Limits::none) return Verdict::open;
        if (opener.sessions >= most_of_connection_) return Verdict::full_connection;
        if (opener.limits == Limits::of_connection) return Verdict::open;
        auto const counted = of_address_.find(opener.address);
        bool const full = counted != of_address_.end() && counted->second >= most_of_address_;
        return full ? Verdict::full_address : Verdict::open;
    }

    void opened(std::uint64_t session, std::shared_ptr<Opener> opener) {
        auto& of_address = of_address_[opener->address];
        auto& counted = *openers_.emplace(session, std::move(opener)).first->second;
        ++counted.sessions;
        ++of_address;
    }

    void ended(std::uint64_t session) {
        auto const found = openers_.find(session);
        if (found == openers_.end()) return;
        auto& opener = *found->second;
        --opener.sessions;
        auto const counted = of_address_.find(opener.address);
        if (--counted->second == 0) of_address_.erase(counted);
        openers_.erase(found);
    }

    std::size_t most_of_connection() const { return most_of_connection_; }
    std::size_t most_of_address() const { return most_of_address_; }

private:
    std::size_t most_of_connection_;
    std::size_t most_of_address_;
    std::unordered_map<std::uint64_t, std::shared_ptr<Opener>> openers_;  // by the session's number
    std::map<Address, std::size_t> of_address_;
};

}  // namespace rois
