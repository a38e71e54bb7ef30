// The tokens of clients (docs/trust.md). Only their hashes are known.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <variant>
#include <vector>

#include "gateway/access/addresses.hpp"
#include "gateway/access/principal.hpp"
#include "types/instant.hpp"

namespace rois {

// Thread-safe.
class Tokens {
public:
    using Holder = std::shared_ptr<Principal const>;

    // `most_wrong`: wrong tokens of one address in a minute that are answered as such.
    explicit Tokens(std::size_t most_wrong) : most_wrong_{most_wrong} {}

    // Replaces all tokens. Withdraws the rights of those that are not among them, or have changed.
    void set(std::vector<std::shared_ptr<Principal>>);
    // Adds a token. It is removed some time after its rights were withdrawn.
    void add(std::shared_ptr<Principal>);

    void limit(std::size_t most_wrong);

    enum class Refused : std::uint8_t {
        wrong,    // unknown, revoked or expired
        too_many  // likewise, and not the first one of this address
    };
    // Takes the same time for every wrong token. A valid token is always accepted: others behind the same address cannot keep an
    // operator from `stop`.
    std::variant<Holder, Refused> holder(std::string_view token, Address const& from, Instant now);

    // Returns the holder of the rights with this id (Rights::id); null: no token has them any more.
    Holder holder_of(std::string const& rights_id);

    // Withdraws the rights of expired tokens. Returns whether any rights were withdrawn since the last call.
    bool end_expired(std::chrono::system_clock::time_point now);

private:
    bool is_too_many(Address const&, Steady now);

    struct Wrong {
        std::size_t count = 0;
        Steady since;
    };

    std::mutex mutex_;  // guards all below
    std::size_t most_wrong_;
    std::vector<Holder> all_;
    std::map<Address, Wrong> wrong_;
    Steady tidied_;  // when the old ones were last removed, because there were too many
    bool some_ended_ = false;
};

}  // namespace rois
