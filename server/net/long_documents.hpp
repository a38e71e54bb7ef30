// Long documents are read on a thread of their own, one after another: what takes milliseconds for one client does not keep the
// short requests of others waiting, `stop` among them; and only one of them is in memory as a tree.
#pragma once

#include <boost/asio/thread_pool.hpp>
#include <cstddef>
#include <functional>
#include <memory>

#include "gateway/gateway.hpp"
#include "net/asio.hpp"
#include "xml/codec/codec.hpp"

namespace rois::net {

class LongDocuments {
public:
    LongDocuments(std::shared_ptr<xml::Schemas const>, xml::DocumentLimits const&, xml::Validation);

    // From about half a millisecond of work.
    static bool is_long(std::size_t bytes) { return bytes > std::size_t{32} * 1024; }

    // Answers the request on that thread, and goes on on the caller's. What the caller passes must live until then.
    Task<Answer> answer(Gateway&, SessionId const&, std::string_view text, Via, std::shared_ptr<Opener> const&);

private:
    xml::RequestReader reader_;
    asio::thread_pool thread_{1};
};

}  // namespace rois::net
