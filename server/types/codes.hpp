// The enumerations of the specification: tables 1 (7.3), 7 and 8 (7.4.2) and 33 (7.6), and Stream_Status of 2.0.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rois {

// The result of an operation (table 1).
enum class ReturnCode : std::uint8_t { ok, error, bad_parameter, unsupported, out_of_resources, timeout };

// How a command ended (table 8).
enum class CompletedStatus : std::uint8_t { ok, error, abort, out_of_resources, timeout };

// What happens when the member that carries out a `start` for a logical component fails (docs/choosing.md). none: the command
// ends as it ended there. abort: it ends with ABORT. restart: another member goes on.
enum class Switching : std::uint8_t { none, abort, restart };

// The kind of error in a receive_error (table 7).
enum class ErrorType : std::uint8_t {
    engine_internal_error,
    component_internal_error,
    component_not_responding,
    user_defined_error
};

// The status of a component (table 33). `busy` depends on the caller: another session has bound the component.
enum class ComponentStatus : std::uint8_t { uninitialized, ready, busy, warning, error };

// The status of a stream (2.0, Stream_Status).
enum class StreamStatus : std::uint8_t {
    not_running,    // connected, but without a receiver
    not_connected,  // not yet or no longer connected
    running,
    suspended,
    resumed  // running again after a suspension
};

// Return the text of a code in messages.
std::string_view to_text(ReturnCode);
std::string_view to_text(CompletedStatus);
std::string_view to_text(Switching);
std::string_view to_text(ErrorType);
std::string_view to_text(ComponentStatus);
std::string_view to_text(StreamStatus);

// Returns the code with this text, or nothing. For the enumerations above and FaultCode (messages.hpp).
template <class Code>
std::optional<Code> to_code(std::string_view text);

}  // namespace rois
