// What components said, in the order in which they said it, until the engine takes it.
#pragma once

#include <deque>
#include <optional>
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
    Results results;
};

struct ErrorOccurred {
    RegisteredComponent const* component;  // null: the engine itself
    ErrorType type;
    std::string text;
};

// What all sessions are told when everything was stopped (decision 34).
inline ErrorOccurred everything_was_stopped() {
    return {nullptr, ErrorType::user_defined_error,
            "everything was stopped; nothing starts until it is cleared (POST /rois/clear)"};
}

using Said = std::variant<CommandStarted, CommandEnded, HaltConfirmed, EventOccurred, ErrorOccurred>;

class Agenda {
public:
    void add(Said said) { said_.push_back(std::move(said)); }

    std::optional<Said> take() {
        if (said_.empty()) return {};
        Said next = std::move(said_.front());
        said_.pop_front();
        return next;
    }

private:
    std::deque<Said> said_;
};

}  // namespace rois
