// The settings that can change while the gateway runs: hosts, origins, limits and periods.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/access/host_names.hpp"
#include "main/settings.hpp"

namespace rois {

// Which names this gateway has, and which web pages may use it, for the media server. Thread-safe.
class Sites {
public:
    explicit Sites(net::Settings const& settings) { use(settings); }

    void use(net::Settings const&);
    bool is_own_host(std::string_view host) const;
    bool is_allowed_origin(std::string_view origin, std::string_view host) const;

private:
    mutable std::mutex mutex_;  // guards the next three
    std::vector<std::string> hosts_;
    std::vector<std::string> allowed_origins_;
    Scheme served_ = Scheme::any;
};

// The present settings with those of others, as far as they can change while the gateway runs.
GatewaySettings with_changes(GatewaySettings const& present, GatewaySettings const& wanted);

// Limits and times of the media server. All but the number of its connections are those of the gateway.
media::Limits media_limits(std::size_t max_connections, net::Settings const&);

// Logs which keys have changed, and which would have changed after a restart.
void report_changes(GatewaySettings const& before, GatewaySettings const& after, GatewaySettings const& wanted);

}  // namespace rois
