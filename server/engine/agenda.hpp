// A queue of the reports that components made through their ports, in order. The engine handles them at the end of its current
// step.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "engine/component.hpp"

namespace rois {

class RegisteredComponent;

struct CommandStarted {
    CommandHandle command;
};

struct CommandEnded {
    CommandHandle command;
    CompletedStatus status;
    Results results;
    Afterwards afterwards;
    std::string reason;
};

struct HaltConfirmed {
    RegisteredComponent* component;
};

struct EventOccurred {
    RegisteredComponent* component;
    std::string event_type;
    std::shared_ptr<Results const> results;
};

struct ErrorOccurred {
    RegisteredComponent const* component;  // null: the engine itself
    ErrorType type;
    std::string text;
};

// The error that all sessions receive when an application stops everything (decision 34).
inline ErrorOccurred everything_was_stopped() {
    return {nullptr, ErrorType::user_defined_error,
            "everything was stopped; nothing starts until it is cleared (POST /rois/clear)"};
}

using AgendaEntry = std::variant<CommandStarted, CommandEnded, HaltConfirmed, EventOccurred, ErrorOccurred>;

class Agenda {
public:
    void add(AgendaEntry entry) { entries_.push_back(std::move(entry)); }

    // The oldest entry, or null. It stays until `pop`, so the engine can retry an entry that failed for lack of memory.
    AgendaEntry* front() { return entries_.empty() ? nullptr : &entries_.front(); }
    void pop() { entries_.pop_front(); }

    // Records that the answer of some component to a command could not be stored. RegisteredComponent::answer_lost marks the
    // component.
    void note_lost_answer() noexcept { answers_lost_ = true; }
    bool take_lost_answers() noexcept { return std::exchange(answers_lost_, false); }

private:
    std::deque<AgendaEntry> entries_;
    bool answers_lost_ = false;
};

}  // namespace rois
