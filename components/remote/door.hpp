// The WebSockets of engines that join this one: each sends `join`, and then serves a sub engine.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>

#include "core/loop.hpp"
#include "links/link.hpp"
#include "remote/remote_engine.hpp"
#include "xml/validation/joining.hpp"

namespace rois::remote {

// Used on the thread of the links.
class Door : public std::enable_shared_from_this<Door> {
public:
    // Returns the sub engine that joins by this name, or why it may not.
    using Find = std::function<std::variant<std::shared_ptr<RemoteEngine>, std::string>(xml::Join const&)>;

    Door(client::Loop&, std::shared_ptr<xml::Schemas const>, Find);

    // `socket` and `head` as in client::accepted_link. Closes the socket if too many engines wait.
    void open(int socket, std::string head);
    // Closes the links of those that have not joined.
    void close();

private:
    class Guest;

    void leave(std::shared_ptr<Guest> const&);

    client::Loop& loop_;
    Settings settings_;
    xml::JoinReader reader_;
    Find find_;
    std::set<std::shared_ptr<Guest>> guests_;
};

}  // namespace rois::remote
