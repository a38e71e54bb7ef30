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
    next.max_wrong_tokens = wanted.max_wrong_tokens;
    return next;
}

void report_changes(GatewaySettings const& before, GatewaySettings const& after, GatewaySettings const& wanted) {
    for (auto const& key : keys()) {
        auto const now = key.show(after);
        if (now != key.show(before)) spdlog::info("{} is now {}", key.name, now.empty() ? "empty" : now);
        if (now != key.show(wanted)) spdlog::warn("a change of {} has no effect before the gateway starts again", key.name);
    }
}

}  // namespace rois
