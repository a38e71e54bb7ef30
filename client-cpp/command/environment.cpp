#include "command/options.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "command/context.hpp"
#include "types/text/environment.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

// The configuration keys of rois-gateway (server/main/keys.cpp) as variables.
constexpr std::array<std::string_view, 82> keys{"ROIS_ALLOWED_ORIGINS",
                                                "ROIS_ALLOW_ANYONE",
                                                "ROIS_AUDIT_LOG",
                                                "ROIS_AUDIT_LOG_BYTES",
                                                "ROIS_AUDIT_LOG_FILES",
                                                "ROIS_COMMAND_RESULTS",
                                                "ROIS_CONNECT_TIMEOUT",
                                                "ROIS_ENGINES",
                                                "ROIS_ENGINE_NAME",
                                                "ROIS_ERROR_DETAILS",
                                                "ROIS_EVENT_DETAILS",
                                                "ROIS_FLOOR_PLAN",
                                                "ROIS_HANDSHAKE_TIMEOUT",
                                                "ROIS_HOSTS",
                                                "ROIS_IDLE_TIMEOUT",
                                                "ROIS_JOIN",
                                                "ROIS_JOIN_AS",
                                                "ROIS_JOIN_CA_FILE",
                                                "ROIS_JOIN_CERTIFICATE_FILE",
                                                "ROIS_JOIN_TOKEN_FILE",
                                                "ROIS_LISTEN",
                                                "ROIS_LOG_FORMAT",
                                                "ROIS_LOG_LEVEL",
                                                "ROIS_MAX_ATTRIBUTES",
                                                "ROIS_MAX_BODY",
                                                "ROIS_MAX_COMMAND_RESULTS",
                                                "ROIS_MAX_CONDITION_BYTES",
                                                "ROIS_MAX_CONDITION_STEPS",
                                                "ROIS_MAX_CONNECTIONS",
                                                "ROIS_MAX_CONNECTIONS_PER_ADDRESS",
                                                "ROIS_MAX_CONTROL_FRAMES",
                                                "ROIS_MAX_DEPTH",
                                                "ROIS_MAX_ELEMENTS",
                                                "ROIS_MAX_FRAGMENTS",
                                                "ROIS_MAX_HEADER",
                                                "ROIS_MAX_HEADER_FIELDS",
                                                "ROIS_MAX_MEDIA_CONNECTIONS",
                                                "ROIS_MAX_NAMESPACES",
                                                "ROIS_MAX_NAME_LENGTH",
                                                "ROIS_MAX_POLL_WAIT",
                                                "ROIS_MAX_PREDICATES",
                                                "ROIS_MAX_REQUESTS_IN_FLIGHT",
                                                "ROIS_MAX_SENT_NOTIFICATIONS",
                                                "ROIS_MAX_SESSIONS",
                                                "ROIS_MAX_SESSIONS_PER_ADDRESS",
                                                "ROIS_MAX_SESSIONS_PER_CONNECTION",
                                                "ROIS_MAX_STREAMS_PER_SESSION",
                                                "ROIS_MAX_SUBSCRIBED_PREDICATES",
                                                "ROIS_MAX_TARGET",
                                                "ROIS_MAX_WAITING_NOTIFICATIONS",
                                                "ROIS_MAX_WRONG_TOKENS",
                                                "ROIS_MEDIA",
                                                "ROIS_MEDIA_RTP",
                                                "ROIS_MEDIA_URL",
                                                "ROIS_MEMORY_BUDGET",
                                                "ROIS_MOTION_LEASE",
                                                "ROIS_MOTION_LEASE_HTTP",
                                                "ROIS_ON_SESSION_END",
                                                "ROIS_PING_INTERVAL",
                                                "ROIS_PROFILES",
                                                "ROIS_PROXIES",
                                                "ROIS_QUESTION_DEADLINE",
                                                "ROIS_REQUEST_TIMEOUT",
                                                "ROIS_RESUME_WINDOW",
                                                "ROIS_ROBOTS",
                                                "ROIS_SCENARIO",
                                                "ROIS_SEED",
                                                "ROIS_SESSION_TIMEOUT",
                                                "ROIS_SHUTDOWN_TIMEOUT",
                                                "ROIS_SIM_SPEED",
                                                "ROIS_START_TIMEOUT",
                                                "ROIS_STATE",
                                                "ROIS_STATE_BYTES",
                                                "ROIS_STEERING",
                                                "ROIS_THREADS",
                                                "ROIS_TLS_CERTIFICATE",
                                                "ROIS_TLS_CLIENTS",
                                                "ROIS_TLS_CLIENT_CA",
                                                "ROIS_TLS_KEY",
                                                "ROIS_TOKENS",
                                                "ROIS_VALIDATION",
                                                "ROIS_WRITE_TIMEOUT"};

}  // namespace

void warn_of_unknown_variables() {
    auto const is_key = [](std::string_view name) { return std::ranges::find(keys, name) != keys.end(); };
    for (auto const& name : unknown_variables(environ, is_key))
        remark("the environment variable " + rois::quoted(name) + " is unknown and ignored; man rois lists the variables");
}

}  // namespace rois::command
