// The limits of open connections: in total, and of one remote address, or one token for those that have shown it.
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "gateway/access/addresses.hpp"
#include "types/messages.hpp"

namespace rois {

// Thread-safe. Must outlive its places.
class Admission {
public:
    // Counts a connection as long as it lives.
    class Place {
    public:
        Place(Place&& other) noexcept
            : of_{std::exchange(other.of_, nullptr)},
              address_{other.address_},
              limits_{other.limits_},
              token_{std::move(other.token_)} {}
        Place& operator=(Place&&) = delete;
        ~Place() { leave(); }

        void leave() {
            if (of_ != nullptr) std::exchange(of_, nullptr)->leave(*this);
        }
        bool is_left() const { return of_ == nullptr; }
        bool has_token() const { return !token_.empty(); }

        // The connection has shown this token: from now on it counts for it, and not for its address. Returns false, and changes
        // nothing, if the token has reached its limit.
        bool show(std::string_view token) { return token == token_ || of_ == nullptr || of_->show(*this, token); }
        Address const& address() const { return address_; }
        Limits limits() const { return limits_; }
        Admission& of() const { return *of_; }  // requires !is_left()

    private:
        friend class Admission;
        Place(Admission& of, Address const& address, Limits limits) : of_{&of}, address_{address}, limits_{limits} {}

        Admission* of_;
        Address address_;
        Limits limits_;
        std::string token_{};  // its name; empty: none was shown
    };

    enum class Refused : unsigned char {
        full,            // all places are taken
        full_of_address  // this address has reached its limit
    };

    Admission(std::size_t most, std::size_t most_of_address) : most_{most}, most_of_address_{most_of_address} {}

    // `any_number`: the limit of the address does not apply.
    enum class OfAddress : unsigned char { limited, any_number };
    std::variant<Place, Refused> enter(Address const& address, Limits limits, OfAddress number = OfAddress::limited) {
        std::lock_guard const lock{mutex_};
        bool const is_limited = limits == Limits::all && number == OfAddress::limited;
        auto const counted = is_limited ? of_address_.find(address) : of_address_.end();
        if (counted != of_address_.end() && counted->second >= most_of_address_) return Refused::full_of_address;
        if (taken_ >= most_) return Refused::full;
        if (limits == Limits::all) ++of_address_[address];
        ++taken_;
        if (taken_ <= most_ / 10 * 9) full_ = false;
        return Place{*this, address, limits};
    }

    // For a connection from this process itself: it is never refused.
    Place enter_from_inside() {
        std::lock_guard const lock{mutex_};
        ++taken_;
        return Place{*this, read_address("127.0.0.1").value(), Limits::of_connection};
    }

    void limit(std::size_t most, std::size_t most_of_address) {
        std::lock_guard const lock{mutex_};
        most_ = most;
        most_of_address_ = most_of_address;
    }

    // The fault for a connection beyond the limit of its address or its token.
    Fault too_many_of(std::string_view holder) {
        std::lock_guard const lock{mutex_};
        return {FaultCode::too_many,
                std::string{holder} + " has " + std::to_string(most_of_address_) +
                    " connections open already: close one; the key max_connections_per_address sets the limit"};
    }

    // Returns true at the first call, and again after a tenth of the places was free: for a log line.
    bool is_news() { return !full_.exchange(true); }

private:
    void leave(Place const& place) {
        std::lock_guard const lock{mutex_};
        --taken_;
        uncount(place);
    }

    bool show(Place& place, std::string_view token) {
        std::lock_guard const lock{mutex_};
        std::string shown{token};
        if (place.limits_ == Limits::all) {
            auto& of_token = of_token_[shown];
            if (of_token >= most_of_address_) return false;
            ++of_token;  // nothing throws from here on
            uncount(place);
        }
        place.token_ = std::move(shown);
        return true;
    }

    void uncount(Place const& place) {
        if (place.limits_ != Limits::all) return;
        auto const remove_from = [](auto& counts, auto const& key) {
            auto const counted = counts.find(key);
            if (--counted->second == 0) counts.erase(counted);
        };
        if (place.token_.empty())
            remove_from(of_address_, place.address_);
        else
            remove_from(of_token_, place.token_);
    }

    std::mutex mutex_;  // guards the next five
    std::size_t most_;
    std::size_t most_of_address_;
    std::size_t taken_ = 0;
    std::map<Address, std::size_t> of_address_;    // without those that have shown a token
    std::map<std::string, std::size_t> of_token_;  // by its name
    std::atomic<bool> full_ = false;
};

}  // namespace rois
