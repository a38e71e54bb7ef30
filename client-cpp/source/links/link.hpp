// The interface of a link to the gateway: a WebSocket, or the HTTP connections of one attempt. Each attempt makes a new link.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "links/target.hpp"
#include "rois/settings.hpp"
#include "types/messages.hpp"
#include "types/unique_descriptor.hpp"
#include "xml/codec/codec.hpp"

namespace rois::client {

class Loop;

enum class Failure : std::uint8_t {
    passing,    // retry
    lasting,    // no retry: it would fail, too
    too_large,  // retry without the document that the gateway rejects
    invalid,    // retry; the other side sent something that is not a message
};

// Used on the client's thread only.
class Link {
public:
    // Called until the link has failed or was cut; never from inside the link's functions.
    class Listener {
    public:
        virtual void connected() = 0;
        // The session's notifications arrive on this link from now on.
        virtual void attached() = 0;
        // An answer or a notification; valid during the call.
        virtual void document(std::string_view) = 0;
        virtual void failed(std::string const& reason, Failure) = 0;
        // The gateway sent a ping, as it often does while a robot moves for the session.
        virtual void pinged() = 0;

    protected:
        ~Listener() = default;
    };

    explicit Link(Listener& listener) : listener_{&listener} {}
    Link(Link const&) = delete;
    Link& operator=(Link const&) = delete;
    virtual ~Link() = default;

    using Document = std::shared_ptr<std::string const>;

    virtual void open() = 0;
    virtual void send(Document) = 0;

    // Requests the session's notifications after `last_sequence` on this link. HTTP: opens the event stream; a fault, such as
    // no_session, is reported as a document. WebSocket: sends `resume` (not needed for a session that this link has opened).
    virtual void attach(SessionId const&, std::uint64_t last_sequence) = 0;

    // Reads nothing more until `go_on`, so that the sender has to wait; a document that has begun to arrive may still be
    // reported. Without effect over HTTP.
    virtual void pause() {}
    virtual void go_on() {}

    // Calls this listener from now on.
    void listen(Listener& listener) { listener_ = &listener; }

    // Closes the link at once. The listener is not called any more.
    virtual void cut() = 0;

protected:
    // Cuts the link and reports why it failed. Only the first failure is reported.
    void fail(std::string const& reason, Failure failure) {
        auto* const listener = std::exchange(listener_, nullptr);
        if (listener == nullptr) return;
        cut();
        listener->failed(reason, failure);
    }

    Listener* listener_;  // null after the link has failed or was cut
};

inline Link::Document document_of(Request const& request) { return std::make_shared<std::string const>(xml::encode(request)); }

std::shared_ptr<Link> websocket_link(Loop&, Target const&, Settings const&, Link::Listener&);
// A WebSocket on a socket that is connected to a gateway. Returns null if the socket cannot be used.
std::shared_ptr<Link> link_on(Loop&, UniqueDescriptor socket, Settings const&, Link::Listener&);
// A WebSocket that a client opens here. `socket`: a connected socket. `head`: the bytes received on it,
// with the request for the upgrade. Returns null if the socket cannot be used.
std::shared_ptr<Link> accepted_link(Loop&, UniqueDescriptor socket, std::string head, Settings const&, Link::Listener&);
std::shared_ptr<Link> http_link(Loop&, Target const&, Settings const&, Link::Listener&);

}  // namespace rois::client
