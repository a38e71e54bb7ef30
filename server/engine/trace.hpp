// The interface to the log: receives the engine's reports about sessions, bindings, refused operations and commands.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois {

struct Command;
class Rights;

// The engine calls it from within its own calls; implementations must not call the engine. Sessions are identified by their
// numbers, because their ids are secrets. A command's id may be any text that the application chose.
class Trace {
public:
    virtual ~Trace() = default;
    virtual void session_opened(std::uint64_t /*session*/) {}
    virtual void session_resumed(std::uint64_t /*session*/) {}
    // It has returned after a restart of the engine. Null: it has no limits.
    virtual void session_restored(std::uint64_t /*session*/, Rights const* /*rights*/) {}
    virtual void session_ended(std::uint64_t /*session*/, std::string_view /*why*/) {}
    virtual void bound(std::uint64_t /*session*/, std::string const& /*ref*/) {}
    virtual void released(std::uint64_t /*session*/, std::string const& /*ref*/) {}
    // The session takes the component from another one, which then releases it.
    virtual void taken_over(std::uint64_t /*session*/, std::uint64_t /*from*/, std::string const& /*ref*/) {}
    // The session has stopped everything, perhaps as others did before; or has cleared its stop. `is_over`: commands may begin.
    virtual void stopped_everything(std::uint64_t /*session*/) {}
    virtual void cleared_stop(std::uint64_t /*session*/, bool /*is_over*/) {}
    // The component did not confirm a halt. The engine repeats the halt until it does (decision 35).
    virtual void halt_failed(std::string const& /*ref*/, std::string_view /*why*/) {}
    virtual void halted_at_last(std::string const& /*ref*/) {}
    // The operation returned a code other than OK. `ref`: of the component that it names; empty if it names none that the session
    // sees, or several.
    virtual void refused(std::uint64_t /*session*/, Operation const&, Outcome const&, std::string_view /*ref*/) {}
    // A command begins to run, or has ended.
    virtual void command_begun(Command const&) {}
    virtual void command_ended(Command const&) {}
};

}  // namespace rois
