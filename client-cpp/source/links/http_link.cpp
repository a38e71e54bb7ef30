#include "links/http_link.hpp"

namespace rois::client {

std::shared_ptr<Link> http_link(Loop& loop, Target const& target, Settings const& settings, Link::Listener& listener) {
    if (target.security == Security::tls) return http_link_tls(loop, target, settings, listener);
    return std::make_shared<HttpLink<Socket>>(loop, target, settings, listener, nullptr);
}

}  // namespace rois::client
