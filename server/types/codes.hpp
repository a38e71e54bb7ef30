// The enumerations of the specification: tables 1 (7.3), 7 and 8 (7.4.2) and 33 (7.6), and Stream_Status of 2.0. Their texts are
// the specification's.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rois {

// What an operation answers (table 1).
enum class ReturnCode : std::uint8_t { ok, error, bad_parameter, unsupported, out_of_resources, timeout };

// How a command ended (table 8).
enum class CompletedStatus : std::uint8_t { ok, error, abort, out_of_resources, timeout };

// What kind of error a receive_error tells of (table 7).
enum class ErrorType : std::uint8_t {
    engine_internal_error,
    component_internal_error,
    component_not_responding,
    user_defined_error
};

// How a component is (table 33). `busy` is relative to the asker: another session has it bound.
enum class ComponentStatus : std::uint8_t { uninitialized, ready, busy, warning, error };

// How a stream is (2.0, Stream_Status): connected without anybody who receives it, not or no longer connected, its media flow,
// they are held, they flow again after that.
enum class StreamStatus : std::uint8_t { not_running, not_connected, running, suspended, resumed };

std::string_view to_text(ReturnCode);
std::string_view to_text(CompletedStatus);
std::string_view to_text(ErrorType);
std::string_view to_text(ComponentStatus);
std::string_view to_text(StreamStatus);

// And back; nothing when none has this text. For those above, and for the codes of faults (messages.hpp).
template <class Code>
std::optional<Code> to_code(std::string_view text);

}  // namespace rois
