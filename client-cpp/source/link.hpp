// One link to the gateway, from its first attempt to its end; a new one is made for each attempt.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "loop.hpp"
#include "rois/settings.hpp"
#include "target.hpp"
#include "types/messages.hpp"
#include "xml/codec.hpp"

namespace rois::client {

// Whether it is worth another attempt; too_large: yes, but without the document that the gateway does not take.
enum class Failure : std::uint8_t { passing, lasting, too_large };

// Lives on the client's thread.
class Link {
public:
    // Hears of a link until it has failed or was cut, never from inside a call of the link's functions.
    class Listener {
    public:
        virtual void connected() = 0;
        // The session's notifications come on this link from now on.
        virtual void attached() = 0;
        // An answer or a notification; valid during the call.
        virtual void document(std::string_view) = 0;
        virtual void failed(std::string const& reason, Failure) = 0;
        // The gateway asks whether somebody is there, as it does all the time while a robot moves for the session.
        virtual void pinged() = 0;

    protected:
        ~Listener() = default;
    };

    Link() = default;
    Link(Link const&) = delete;
    Link& operator=(Link const&) = delete;
    virtual ~Link() = default;

    using Document = std::shared_ptr<std::string const>;

    virtual void open() = 0;
    virtual void send(Document) = 0;

    // What brings a session's notifications, those after `last_sequence`, to this link. Over HTTP that is its event stream; who
    // hears no_session instead hears it as a document. On a WebSocket it is the document `resume`, but for the session opened on
    // it.
    virtual void attach(SessionId const&, std::uint64_t last_sequence) = 0;

    // Ends it without a word; nothing is heard of it from now on.
    virtual void cut() = 0;
};

inline Link::Document document_of(Request const& request) { return std::make_shared<std::string const>(xml::encode(request)); }

std::shared_ptr<Link> websocket_link(Loop&, Target const&, Settings const&, Link::Listener&);
std::shared_ptr<Link> http_link(Loop&, Target const&, Settings const&, Link::Listener&);

}  // namespace rois::client
