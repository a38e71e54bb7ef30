// The errors that the engine has found and not published yet.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "types/codes.hpp"

namespace rois {

class RegisteredComponent;

struct FoundError {
    std::shared_ptr<RegisteredComponent const> component;  // null: the engine itself
    ErrorType type;
    std::string text;
};

// The error that all sessions receive when an application stops everything (decision 34).
inline FoundError everything_was_stopped() {
    return {nullptr, ErrorType::user_defined_error,
            "everything was stopped; nothing starts until it is cleared (POST /rois/clear)"};
}

class Agenda {
public:
    void add(FoundError error) { errors_.push_back(std::move(error)); }

    // The oldest error, or null. It stays until `pop`, so the engine can retry one whose publication failed for lack of memory.
    FoundError* front() { return errors_.empty() ? nullptr : &errors_.front(); }
    void pop() { errors_.pop_front(); }

private:
    std::deque<FoundError> errors_;
};

}  // namespace rois
