#include "links/websocket_link.hpp"

namespace rois::client {

std::shared_ptr<Link> websocket_link_tls(Loop& loop, Target const& target, Settings const& settings, Link::Listener& listener) {
    return std::make_shared<WebSocketLink<TlsSocket>>(loop, target, settings, listener, trust(settings));
}

}  // namespace rois::client
