// The questions to components that are not answered yet (decision 36).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/component.hpp"

namespace rois {

class RegisteredComponent;

class Questions {
public:
    // The answers to the questions of a round, in their order; nullopt: none in time.
    using Answers = std::vector<std::optional<ComponentAnswer>>;
    using Then = std::function<void(Answers&, Instant now)>;
    struct Round;

    // A ticket that identifies nothing else. For halts, which are not questions.
    Ticket fresh_ticket() { return Ticket{++last_}; }

    // Begins a round of questions. `then` is called once: when all are answered, or at a tick after `due`.
    std::shared_ptr<Round> begin(Steady due, Then then);
    // Adds a question to the round, which the caller then asks with this ticket. `what` is the text of the
    // error if no answer comes.
    Ticket add(std::shared_ptr<Round> const&, RegisteredComponent&, char const* what);
    // A round with one question.
    Ticket ask(RegisteredComponent&, Steady due, char const* what,
               std::function<void(std::optional<ComponentAnswer>&, Instant now)> then);
    // Ends the round now if nothing is to be asked.
    void end_if_empty(std::shared_ptr<Round> const&, Instant now);

    // Returns false if the question is unknown: it was answered before, or the answer is late.
    bool answered(Ticket, ComponentAnswer&&, Instant now);

    // Ends the rounds whose time is over. The silent components report that.
    void expire(Instant now);

    // Answers the questions to a component that leaves the engine.
    void fail_all(RegisteredComponent const&, Instant now);

    // Returns whether a ticket belongs to a question, and not to a halt.
    bool is_open(Ticket ticket) const { return open_.contains(static_cast<std::uint64_t>(ticket)); }

private:
    struct Open {
        std::shared_ptr<Round> round;
        std::size_t place = 0;  // in the round's answers
        std::shared_ptr<RegisteredComponent> component;
        char const* what = nullptr;
    };

    void finish(Round&, Instant now);

    std::unordered_map<std::uint64_t, Open> open_;  // by ticket
    std::uint64_t last_ = 0;
};

}  // namespace rois
