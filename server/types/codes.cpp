#include "types/codes.hpp"

#include <array>
#include <cstddef>

#include "types/messages.hpp"

namespace rois {

namespace {

template <std::size_t N, class Code>
std::string_view name_in(std::array<std::string_view, N> const& names, Code code) {
    return names.at(static_cast<std::size_t>(code));
}

constexpr std::array<std::string_view, 6> return_codes{"OK",     "ERROR", "BAD_PARAMETER", "UNSUPPORTED", "OUT_OF_RESOURCES",
                                                       "TIMEOUT"};
constexpr std::array<std::string_view, 5> completed_statuses{"OK", "ERROR", "ABORT", "OUT_OF_RESOURCES", "TIMEOUT"};
constexpr std::array<std::string_view, 4> error_types{"ENGINE_INTERNAL_ERROR", "COMPONENT_INTERNAL_ERROR",
                                                      "COMPONENT_NOT_RESPONDING", "USER_DEFINED_ERROR"};
constexpr std::array<std::string_view, 5> component_statuses{"UNINITIALIZED", "READY", "BUSY", "WARNING", "ERROR"};
constexpr std::array<std::string_view, 5> stream_statuses{"STREAMING_NOT_RUNNING", "STREAMING_NOT_CONNECTED", "STREAMING_RUNNING",
                                                          "STREAMING_SUSPENDED", "STREAMING_RESUMED"};
constexpr std::array<std::string_view, 17> fault_codes{
    "not_well_formed",  "forbidden_xml",      "invalid",          "no_session",      "unauthorized", "not_allowed",
    "not_found",        "method_not_allowed", "too_slow",         "length_required", "too_large",    "unsupported_media_type",
    "upgrade_required", "too_many",           "header_too_large", "uri_too_long",    "shutting_down"};

}  // namespace

std::string_view to_text(ReturnCode code) { return name_in(return_codes, code); }
std::string_view to_text(CompletedStatus status) { return name_in(completed_statuses, status); }
std::string_view to_text(ErrorType type) { return name_in(error_types, type); }
std::string_view to_text(ComponentStatus status) { return name_in(component_statuses, status); }
std::string_view to_text(StreamStatus status) { return name_in(stream_statuses, status); }
std::string_view to_text(FaultCode code) { return name_in(fault_codes, code); }

}  // namespace rois
