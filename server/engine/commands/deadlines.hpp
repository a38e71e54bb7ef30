// Actions that the engine carries out at a given time.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "engine/attempts.hpp"
#include "types/instant.hpp"

namespace rois {

// Carries the actions out in the order of their times; actions of the same time in the order in which they were added.
class Deadlines {
public:
    using Action = std::function<void(Instant now)>;
    using Ticket = std::pair<Steady, std::uint64_t>;  // identifies an action; may be used after the action has ended

    Ticket add(Steady when, Action action) {
        Ticket const ticket{when, ++last_};
        actions_.emplace(ticket, std::move(action));
        return ticket;
    }

    void cancel(Ticket const& ticket) { actions_.erase(ticket); }

    // Moves an action to another time. Allocates no memory. Returns false if the action has ended or is being carried out.
    bool postpone(Ticket& ticket, Steady when) noexcept {
        auto node = actions_.extract(ticket);
        if (!node) return false;
        ticket = {when, ++last_};
        node.key() = ticket;
        actions_.insert(std::move(node));
        return true;
    }

    // A ticket that sorts before all actions.
    static Ticket first() { return {Steady::min(), 0}; }

    // Carries out the next action after `last` that is due, and sets `last` to its ticket. Returns false if none is due. An
    // action that throws stays due.
    bool carry_out_next(Ticket& last, Instant now, Attempts& attempts) {
        auto const next = actions_.upper_bound(last);
        if (next == actions_.end() || next->first.first > now.steady) return false;
        auto node = actions_.extract(next);
        last = node.key();
        if (!attempts([&] { node.mapped()(now); })) actions_.insert(std::move(node));
        return true;
    }

private:
    std::map<Ticket, Action> actions_;
    std::uint64_t last_ = 0;
};

}  // namespace rois
