#include "types/codes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "types/engine_state.hpp"
#include "types/messages.hpp"

namespace rois {

namespace {

template <std::size_t N, class Code>
std::string_view name_in(std::array<std::string_view, N> const& names, Code code) {
    return names.at(static_cast<std::size_t>(code));
}

template <class Code, std::size_t N>
std::optional<Code> code_in(std::array<std::string_view, N> const& names, std::string_view text) {
    auto const found = std::ranges::find(names, text);
    if (found == names.end()) return std::nullopt;
    return static_cast<Code>(found - names.begin());
}

constexpr std::array<std::string_view, 6> return_codes{"OK",     "ERROR", "BAD_PARAMETER", "UNSUPPORTED", "OUT_OF_RESOURCES",
                                                       "TIMEOUT"};
constexpr std::array<std::string_view, 5> completed_statuses{"OK", "ERROR", "ABORT", "OUT_OF_RESOURCES", "TIMEOUT"};
constexpr std::array<std::string_view, 3> switchings{"none", "abort", "restart"};
constexpr std::array<std::string_view, 4> error_types{"ENGINE_INTERNAL_ERROR", "COMPONENT_INTERNAL_ERROR",
                                                      "COMPONENT_NOT_RESPONDING", "USER_DEFINED_ERROR"};
constexpr std::array<std::string_view, 5> component_statuses{"UNINITIALIZED", "READY", "BUSY", "WARNING", "ERROR"};
constexpr std::array<std::string_view, 5> stream_statuses{"STREAMING_NOT_RUNNING", "STREAMING_NOT_CONNECTED", "STREAMING_RUNNING",
                                                          "STREAMING_SUSPENDED", "STREAMING_RESUMED"};
constexpr std::array<std::string_view, 4> engine_states{"absent", "present", "lost", "given_up"};
constexpr std::array<std::string_view, 17> fault_codes{
    "not_well_formed",  "forbidden_xml",      "invalid",          "no_session",      "unauthorized", "not_allowed",
    "not_found",        "method_not_allowed", "too_slow",         "length_required", "too_large",    "unsupported_media_type",
    "upgrade_required", "too_many",           "header_too_large", "uri_too_long",    "shutting_down"};

}  // namespace

std::string_view to_text(ReturnCode code) { return name_in(return_codes, code); }
std::string_view to_text(CompletedStatus status) { return name_in(completed_statuses, status); }
std::string_view to_text(Switching switching) { return name_in(switchings, switching); }
std::string_view to_text(ErrorType type) { return name_in(error_types, type); }
std::string_view to_text(ComponentStatus status) { return name_in(component_statuses, status); }
std::string_view to_text(StreamStatus status) { return name_in(stream_statuses, status); }
std::string_view to_text(EngineState::Is is) { return name_in(engine_states, is); }
std::string_view to_text(FaultCode code) { return name_in(fault_codes, code); }

template <>
std::optional<ReturnCode> to_code(std::string_view text) {
    return code_in<ReturnCode>(return_codes, text);
}
template <>
std::optional<EngineState::Is> to_code(std::string_view text) {
    return code_in<EngineState::Is>(engine_states, text);
}
template <>
std::optional<CompletedStatus> to_code(std::string_view text) {
    return code_in<CompletedStatus>(completed_statuses, text);
}
template <>
std::optional<Switching> to_code(std::string_view text) {
    return code_in<Switching>(switchings, text);
}
template <>
std::optional<ErrorType> to_code(std::string_view text) {
    return code_in<ErrorType>(error_types, text);
}
template <>
std::optional<ComponentStatus> to_code(std::string_view text) {
    return code_in<ComponentStatus>(component_statuses, text);
}
template <>
std::optional<StreamStatus> to_code(std::string_view text) {
    return code_in<StreamStatus>(stream_statuses, text);
}
template <>
std::optional<FaultCode> to_code(std::string_view text) {
    return code_in<FaultCode>(fault_codes, text);
}

int http_status_of(FaultCode code) {
    switch (code) {
        case FaultCode::not_well_formed:
        case FaultCode::forbidden_xml:
            return 400;
        case FaultCode::invalid:
            return 422;
        case FaultCode::no_session:
        case FaultCode::not_allowed:
            return 403;
        case FaultCode::unauthorized:
            return 401;
        case FaultCode::not_found:
            return 404;
        case FaultCode::method_not_allowed:
            return 405;
        case FaultCode::too_slow:
            return 408;
        case FaultCode::length_required:
            return 411;
        case FaultCode::too_large:
            return 413;
        case FaultCode::unsupported_media_type:
            return 415;
        case FaultCode::upgrade_required:
            return 426;
        case FaultCode::too_many:
            return 429;
        case FaultCode::header_too_large:
            return 431;
        case FaultCode::uri_too_long:
            return 414;
        case FaultCode::shutting_down:
            return 503;
    }
    return 400;
}

}  // namespace rois
