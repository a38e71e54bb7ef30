// GET /rois/notifications: a session's notifications as server-sent events, or answered to a long poll (wire.md).
#pragma once

#include "gateway/gateway.hpp"
#include "net/http_answer.hpp"
#include "net/http_head.hpp"
#include "net/settings.hpp"
#include "net/wire.hpp"

namespace rois::net {

struct NotificationsWanted {
    enum class As : std::uint8_t { stream, poll } as = As::poll;
    std::uint64_t after = 0;
    std::chrono::seconds wait{0};
};

// Reads what a request asks for; a fault for numbers that are none.
std::variant<NotificationsWanted, Fault> read_wanted(RequestHead const&);

// Waits until there is something to answer, the time has passed or the peer has gone. Null `reading`: no such session.
Task<HttpAnswer> poll(Wire&, Gateway&, Telemetry&, Wakes&, SessionId const&, NotificationsWanted const&);

// Sends events until the session has ended or the connection breaks; answers with a fault when there is no such session.
Task<std::optional<HttpAnswer>> stream(Wire&, Gateway&, Telemetry&, Wakes&, SessionId const&, NotificationsWanted const&,
                                       Settings const&);

// Waits until all readers of a session that has disconnected have taken what was left for them, or a second has passed.
Task<> others_heard(Gateway&, SessionId const&, Executor const&, Wakes&);

}  // namespace rois::net
