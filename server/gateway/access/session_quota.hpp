// Limits the open sessions of a connection, and of a remote address or token.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>

#include "gateway/access/addresses.hpp"
#include "gateway/access/principal.hpp"

namespace rois {

// A connection, and who sends its present request.
struct Client {
    Address address{};
    Limits limits = Limits::none;
    std::shared_ptr<Principal const> principal{};  // null: the gateway asks for no tokens, or the client is in this process
    std::size_t sessions = 0;                      // open sessions that it has opened; only the quota uses it

    Rights const* rights() const { return principal ? principal->rights.get() : nullptr; }
    bool sees_everything() const { return !principal || principal->rights->sees_everything(); }
    // Of its token; empty: it has none.
    std::string_view name() const { return principal ? std::string_view{principal->name()} : ""; }
};

// A session counts for the connection that opened it, and for its token, or else for that connection's address, until the session
// ends, whichever connections use it later. Not thread-safe: the gateway's mutex guards it.
class SessionQuota {
public:
    SessionQuota(std::size_t most_of_connection, std::size_t most_of_address)
        : most_of_connection_{most_of_connection}, most_of_address_{most_of_address} {}

    enum class Verdict : std::uint8_t { open, full_connection, full_address };
    Verdict verdict(Client const& client) const {
        bool const has_token = client.principal != nullptr;
        if (client.limits != Limits::none && client.sessions >= most_of_connection_) return Verdict::full_connection;
        if (client.limits != Limits::all && !has_token) return Verdict::open;
        auto const counted = of_holder_.find(holder_of(client));
        bool const full = counted != of_holder_.end() && counted->second >= most_of_address_;
        return full ? Verdict::full_address : Verdict::open;
    }

    void opened(std::uint64_t session, std::shared_ptr<Client> const& client) {
        auto holder = holder_of(*client);
        auto& of_holder = of_holder_[holder];
        auto& opened = openers_.try_emplace(session, client, std::move(holder)).first->second;
        ++opened.client->sessions;
        ++of_holder;
    }

    void ended(std::uint64_t session) {
        auto const found = openers_.find(session);
        if (found == openers_.end()) return;
        auto& [client, holder] = found->second;
        --client->sessions;
        auto const counted = of_holder_.find(holder);
        if (--counted->second == 0) of_holder_.erase(counted);
        openers_.erase(found);
    }

    void limit(std::size_t most_of_connection, std::size_t most_of_address) {
        most_of_connection_ = most_of_connection;
        most_of_address_ = most_of_address;
    }
    std::size_t most_of_connection() const { return most_of_connection_; }
    std::size_t most_of_address() const { return most_of_address_; }

private:
    // Whom a session counts for.
    struct Holder {
        Address address{};  // zero if there is a token
        std::shared_ptr<Principal const> principal;
        auto operator<=>(Holder const&) const = default;
    };
    static Holder holder_of(Client const& client) { return {client.principal ? Address{} : client.address, client.principal}; }

    struct Opener {
        std::shared_ptr<Client> client;
        Holder holder;
    };

    std::size_t most_of_connection_;
    std::size_t most_of_address_;
    std::unordered_map<std::uint64_t, Opener> openers_;  // by the session's number
    std::map<Holder, std::size_t> of_holder_;
};

}  // namespace rois
