// GET /rois/notifications: server-sent events and long polls (docs/clients.md).
#pragma once

#include <optional>
#include <variant>

#include "gateway/gateway.hpp"
#include "net/http/http_answer.hpp"
#include "net/http/http_head.hpp"
#include "wire/wire.hpp"

namespace rois::net {

class Loop;

struct NotificationsWanted {
    enum class As : std::uint8_t { stream, poll } as = As::poll;
    std::uint64_t after = 0;
    std::chrono::seconds wait{0};
};

// Reads the header fields and the query of a request. Returns a fault for an invalid number, and for a `wait` of more than
// `longest_wait`.
std::variant<NotificationsWanted, Fault> read_wanted(RequestHead const&, std::chrono::milliseconds longest_wait);

// Waits until there are notifications, the time has passed, or the peer has closed the connection. Answers with a fault if the
// session is unknown.
Task<HttpAnswer> poll(Wire&, Loop&, SessionId const&, Rights const*, NotificationsWanted const&);

// Sends events until the session or the connection ends. Returns an answer only if the session cannot be read: a fault.
Task<std::optional<HttpAnswer>> stream(Wire&, Loop&, SessionId const&, Rights const*, NotificationsWanted const&);

// Waits until all readers of a disconnected session have received its last notifications, for at most a second.
Task<> wait_for_other_readers(Gateway&, SessionId const&, Executor const&, Wakes&);

}  // namespace rois::net
