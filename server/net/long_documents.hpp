// Reads long documents on a separate thread, one at a time. So short requests of other clients, such as `stop`, do not wait for
// them, and only one long document is in memory as a tree.
#pragma once

#include <boost/asio/thread_pool.hpp>
#include <cstddef>
#include <memory>
#include <utility>

#include "gateway/gateway.hpp"
#include "net/settings.hpp"
#include "wire/asio.hpp"
#include "xml/codec/codec.hpp"

namespace rois::net {

class LongDocuments {
public:
    explicit LongDocuments(std::shared_ptr<xml::Schemas const> schemas) : reader_{std::move(schemas)} {}

    // Reading a long document takes half a millisecond or more.
    static bool is_long(std::size_t bytes) { return bytes > std::size_t{32} * 1024; }

    // Thread-safe. Calls Gateway::answer on the separate thread, and resumes the caller on the caller's thread. The caller owns
    // all arguments, which must live until then.
    Task<PendingAnswer> answer(Settings const&, Gateway&, SessionId const&, std::string_view text, Via,
                               std::weak_ptr<Waker> waits, std::shared_ptr<Client> const&, Wakes&);

private:
    xml::RequestReader reader_;
    asio::thread_pool thread_{1};
};

}  // namespace rois::net
