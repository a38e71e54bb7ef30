#include "links/websocket_link.hpp"

namespace rois::client {

std::shared_ptr<Link> websocket_link(Loop& loop, Target const& target, Settings const& settings, Link::Listener& listener) {
    if (target.security == Security::tls) return websocket_link_tls(loop, target, settings, listener);
    return std::make_shared<WebSocketLink<Socket>>(loop, target, settings, listener, nullptr);
}

std::shared_ptr<Link> link_on(Loop& loop, UniqueDescriptor socket, Settings const& settings, Link::Listener& listener) {
    auto link = std::make_shared<WebSocketLink<Socket>>(loop, read_url("http://localhost"), settings, listener, nullptr);
    return link->use(std::move(socket)) ? link : nullptr;
}

std::shared_ptr<Link> accepted_link(Loop& loop, UniqueDescriptor socket, std::string head, Settings const& settings,
                                    Link::Listener& listener) {
    auto link = std::make_shared<WebSocketLink<Socket>>(loop, Target{}, settings, listener, nullptr);
    return link->use(std::move(socket), std::move(head)) ? link : nullptr;
}

}  // namespace rois::client
