// The limits of open connections: in total, and from one remote address.
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>
#include <variant>

#include "gateway/access/addresses.hpp"

namespace rois {

// Thread-safe. Must outlive its places.
class Admission {
public:
    // Counts a connection as long as it lives.
    class Place {
    public:
        Place(Place&& other) noexcept
            : of_{std::exchange(other.of_, nullptr)}, address_{other.address_}, limits_{other.limits_} {}
        Place& operator=(Place&&) = delete;
        ~Place() {
            if (of_ != nullptr) of_->leave(*this);
        }

        Address const& address() const { return address_; }
        Limits limits() const { return limits_; }

    private:
        friend class Admission;
        Place(Admission& of, Address const& address, Limits limits) : of_{&of}, address_{address}, limits_{limits} {}

        Admission* of_;
        Address address_;
        Limits limits_;
    };

    enum class Refused : unsigned char {
        full,            // all places are taken
        full_of_address  // this address has reached its limit
    };

    Admission(std::size_t most, std::size_t most_of_address) : most_{most}, most_of_address_{most_of_address} {}

    std::variant<Place, Refused> enter(Address const& address, Limits limits) {
        std::lock_guard const lock{mutex_};
        auto const counted = limits == Limits::all ? of_address_.find(address) : of_address_.end();
        if (counted != of_address_.end() && counted->second >= most_of_address_) return Refused::full_of_address;
        if (taken_ >= most_) return Refused::full;
        if (limits == Limits::all) ++of_address_[address];
        ++taken_;
        full_ = false;
        return Place{*this, address, limits};
    }

    void limit(std::size_t most, std::size_t most_of_address) {
        std::lock_guard const lock{mutex_};
        most_ = most;
        most_of_address_ = most_of_address;
    }

    // Returns true at the first call since the last connection entered: for a log line.
    bool is_news() { return !full_.exchange(true); }

private:
    void leave(Place const& place) {
        std::lock_guard const lock{mutex_};
        --taken_;
        if (place.limits_ != Limits::all) return;
        auto const counted = of_address_.find(place.address_);
        if (--counted->second == 0) of_address_.erase(counted);
    }

    std::mutex mutex_;  // guards the next four
    std::size_t most_;
    std::size_t most_of_address_;
    std::size_t taken_ = 0;
    std::map<Address, std::size_t> of_address_;
    std::atomic<bool> full_ = false;
};

}  // namespace rois
