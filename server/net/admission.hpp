// How many connections may be open at once, over all loops.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <utility>

namespace rois::net {

// Any thread. Outlives the places that it gives.
class Admission {
public:
    // What a connection has for as long as it lives.
    class Place {
    public:
        Place(Place&& other) noexcept : of_{std::exchange(other.of_, nullptr)} {}
        Place& operator=(Place&&) = delete;
        ~Place() {
            if (of_ != nullptr) --of_->taken_;
        }

    private:
        friend class Admission;
        explicit Place(Admission& of) : of_{&of} {}

        Admission* of_;
    };

    explicit Admission(std::size_t most) : most_{most} {}

    // None while all are taken.
    std::optional<Place> enter() {
        if (taken_++ >= most_) {
            --taken_;
            return {};
        }
        full_ = false;
        return Place{*this};
    }

    // Whether this is the first to be told since there was room.
    bool is_news() { return !full_.exchange(true); }

private:
    std::size_t most_;
    std::atomic<std::size_t> taken_ = 0;
    std::atomic<bool> full_ = false;
};

}  // namespace rois::net
