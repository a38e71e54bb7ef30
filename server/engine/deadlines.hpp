// What is due at some time.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "types/instant.hpp"

namespace rois {

// Actions in the order of their times; those of one time in the order in which they were added.
class Deadlines {
public:
    using Action = std::function<void(Instant now)>;
    using Ticket = std::pair<Steady, std::uint64_t>;  // names an action; an ended one is harmless

    Ticket add(Steady when, Action action) {
        Ticket const ticket{when, ++last_};
        actions_.emplace(ticket, std::move(action));
        return ticket;
    }

    void cancel(Ticket const& ticket) { actions_.erase(ticket); }

    // Takes the next action that is due by now; an empty one when there is none.
    Action take_due(Instant now) {
        if (actions_.empty() || actions_.begin()->first.first > now.steady) return {};
        auto node = actions_.extract(actions_.begin());
        return std::move(node.mapped());
    }

private:
    std::map<Ticket, Action> actions_;
    std::uint64_t last_ = 0;
};

}  // namespace rois
