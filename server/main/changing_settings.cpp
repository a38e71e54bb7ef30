#include "main/changing_settings.hpp"

#include <spdlog/spdlog.h>

#include "main/keys.hpp"

namespace rois {

void Sites::use(net::Settings const& settings) {
    std::lock_guard const lock{mutex_};
    hosts_ = settings.hosts;
    allowed_origins_ = settings.allowed_origins;
    served_ = settings.credentials ? Scheme::https : Scheme::any;
}

bool Sites::is_own_host(std::string_view host) const {
    std::lock_guard const lock{mutex_};
    return rois::is_own_host(host, hosts_);
}

bool Sites::is_allowed_origin(std::string_view origin, std::string_view host) const {
    std::lock_guard const lock{mutex_};
    return rois::is_allowed_origin(origin, host, allowed_origins_, served_);
}

GatewaySettings with_changes(GatewaySettings const& present, GatewaySettings const& wanted) {
    auto next = present;
    next.net = net::with_changes(present.net, wanted.net);
    next.engine = with_changes(present.engine, wanted.engine);
    next.media.limits = wanted.media.limits;
    next.max_wrong_tokens = wanted.max_wrong_tokens;
    next.audit_log_bytes = wanted.audit_log_bytes;
    next.audit_log_files = wanted.audit_log_files;
    next.state_bytes = wanted.state_bytes;
    return next;
}

media::Limits media_limits(std::size_t max_connections, net::Settings const& net) {
    return {.max_connections = max_connections,
            .max_header = net.max_header,
            .max_header_fields = net.max_header_fields,
            .max_target = net.max_target,
            .handshake_timeout = net.handshake_timeout,
            .request_timeout = net.request_timeout,
            .write_timeout = net.write_timeout};
}

void report_changes(GatewaySettings const& before, GatewaySettings const& after, GatewaySettings const& wanted) {
    for (auto const& key : keys()) {
        auto const now = key.show(after);
        if (now != key.show(before)) spdlog::info("{} is now {}", key.name, now.empty() ? "empty" : now);
        if (now != key.show(wanted)) spdlog::warn("a change of {} has no effect before the gateway starts again", key.name);
    }
}

}  // namespace rois
