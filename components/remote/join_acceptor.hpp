// The WebSockets of engines that join this one: each sends `join`, and then serves a sub engine.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <variant>

#include "core/loop.hpp"
#include "links/link.hpp"
#include "remote/remote_engine.hpp"
#include "types/unique_descriptor.hpp"
#include "xml/validation/joining.hpp"

namespace rois::remote {

// Used on the thread of the links.
class JoinAcceptor : public std::enable_shared_from_this<JoinAcceptor> {
public:
    // Returns whether the client may join as the sub engine with this name.
    using MayJoin = std::function<bool(std::string const& name)>;
    // Returns the sub engine that joins by this name, or the reason why it may not join.
    using Find = std::function<std::variant<std::shared_ptr<RemoteEngine>, std::string>(xml::Join const&, MayJoin const&)>;

    JoinAcceptor(client::Loop&, std::shared_ptr<xml::Schemas const>, Find);

    // `socket` and `head` as in client::accepted_link. Closes the socket if too many engines wait.
    void open(UniqueDescriptor socket, std::string head, MayJoin);
    // Closes the links of engines that have not joined.
    void close();

private:
    class PendingJoin;  // a link whose engine has not joined yet

    void leave(std::shared_ptr<PendingJoin> const&);

    client::Loop& loop_;
    Settings settings_;
    xml::JoinReader reader_;
    Find find_;
    std::set<std::shared_ptr<PendingJoin>> pending_;
};

}  // namespace rois::remote
