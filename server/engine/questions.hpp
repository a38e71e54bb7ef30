// The questions to components that are not answered yet (decision 36).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/component.hpp"

namespace rois {

class Attempts;
class RegisteredComponent;

class Questions {
public:
    // The answers to the questions of a round; nullopt: none in time.
    using Answers = std::vector<std::optional<ComponentAnswer>>;
    using Then = std::function<void(Answers&, Instant now)>;

    // Questions that are asked together.
    class Round {
    public:
        virtual ~Round() = default;

    private:
        friend class Questions;
        // Called once for each question. nullopt: no answer came in time.
        virtual void take(std::size_t place, std::optional<ComponentAnswer>&&) = 0;
        // Called after the last of these.
        virtual void end(Instant now) = 0;

        Steady due_;
        std::size_t unanswered_ = 0;
    };

    // Returns a new ticket for a halt, which is not a question.
    Ticket fresh_ticket() { return Ticket{++last_}; }

    // Begins a round. `Round` may be reused after its end. A tick after `due` ends the questions that are not answered then.
    static void begin(Round& round, Steady due) { round.due_ = due; }
    // A round that calls `then` with this number of answers, by the places of their questions, when it ends. A question that
    // could not be added, because memory was short, has no answer.
    static std::shared_ptr<Round> begin(Steady due, std::size_t questions, Then then);
    // Adds a question to the round, which the caller then asks with this ticket. `place` identifies it in the round. `what` is
    // the text of the error if no answer comes.
    Ticket add(std::shared_ptr<Round>, std::size_t place, RegisteredComponent&, char const* what);
    // A round with one question.
    Ticket ask(RegisteredComponent&, Steady due, char const* what,
               std::function<void(std::optional<ComponentAnswer>&, Instant now)> then);
    // Returns false if the question is unknown: it was answered before, or the answer is late.
    bool answered(Ticket, ComponentAnswer&&, Instant now);

    // Ends the rounds whose time is over. Each silent component reports COMPONENT_NOT_RESPONDING.
    void expire(Instant now);

    // Answers the questions to a component that leaves the engine.
    void fail_all(RegisteredComponent const&, Instant now);

    // Returns whether a ticket belongs to a question, and not to a halt.
    bool is_open(Ticket) const;

private:
    struct Open {
        Ticket ticket;
        std::shared_ptr<Round> round;
        std::size_t place = 0;
        std::shared_ptr<RegisteredComponent> component;
        char const* what = nullptr;
    };

    static void end(Open const&, std::optional<ComponentAnswer>&&, Instant now, Attempts&);

    std::vector<Open> open_;  // by ticket, ascending
    std::uint64_t last_ = 0;
};

}  // namespace rois
