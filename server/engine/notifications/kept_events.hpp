// Events that no session has received, kept for the next subscription that matches them.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "types/instant.hpp"
#include "types/values.hpp"

namespace rois {

class KeptEvents {
public:
    struct Event {
        Steady until;
        std::string type;
        std::string ref;  // of the component
        std::shared_ptr<Results const> results;
    };

    // Keeps at most this many events, the newest ones.
    explicit KeptEvents(std::size_t most) : most_{most} {}

    bool keeps_any() const { return most_ > 0; }

    void add(Event event) {
        if (!keeps_any()) return;
        events_.push_back(std::move(event));
        keep_last(most_);
    }

    // Removes the events of this type, and returns those that have not expired, in the order of `add`.
    std::vector<Event> take(std::string_view type, Steady now) {
        forget_expired(now);
        std::vector<Event> taken;
        for (auto const& event : events_)
            if (event.type == type) taken.push_back(event);
        std::erase_if(events_, [&](Event const& event) { return event.type == type; });
        return taken;
    }

    void forget_expired(Steady now) {
        std::erase_if(events_, [&](Event const& event) { return event.until <= now; });
    }

    void keep_last(std::size_t most) {
        while (events_.size() > most) events_.pop_front();
    }

private:
    std::size_t most_;
    std::deque<Event> events_;
};

}  // namespace rois
