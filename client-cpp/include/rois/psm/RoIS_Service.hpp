// Notifications of the engine to the application in the C++ PSM (section 7.7; tables 6 to 8).
#pragma once

#include <string>

namespace RoIS_Service {

// Table 8: how a command ended.
enum Completed_Status { OK, ERROR, ABORT, OUT_OF_RESOURCES, TIMEOUT };

// Table 7.
enum ErrorType { ENGINE_INTERNAL_ERROR, COMPONENT_INTERNAL_ERROR, COMPONENT_NOT_RESPONDING, USER_DEFINED_ERROR };

using DateTime = std::string;  // UTC, "2026-11-20T12:00:00.123Z"

// Receives the notifications of the session. Derive from it and define the functions that you need; a function that you do
// not define does nothing. Every object of a derived class receives all notifications.
//
// Begin: the constructor registers the object; it receives notifications from the next operation on that any thread calls,
// normally connect(). Construct it before connect(), or while no other thread calls an operation.
//
// End: destroy it after disconnect(), or call end_notifications() first in the destructor of the derived class. The destructor
// of this class deregisters, too, but by then the members of the derived class are gone.
//
// Threads: one background thread of the library calls the functions, one notification at a time, in order. They may call
// any operation. They must not throw. A function that takes long delays the others: at most 1,024 notifications wait, then
// the oldest event is dropped and reported by notify_error.
class ServiceApplicationBase {
public:
    ServiceApplicationBase();
    ServiceApplicationBase(ServiceApplicationBase const&);
    ServiceApplicationBase& operator=(ServiceApplicationBase const&) = default;
    virtual ~ServiceApplicationBase();

    // An error of the engine or of a component that is bound or subscribed to. get_error_detail() gives the details. The
    // library reports its own losses here as ENGINE_INTERNAL_ERROR: a lost link, a session that ended with it, dropped
    // notifications.
    virtual void notify_error(std::string error_id, ErrorType error_type);

    // A command has ended. Called once for every accepted command, with ABORT if the session ended with the link (after the
    // library has connected again; until then it only reports the lost link).
    // Commands of a component's Command class have ids like "navigation.start.7": component, command, number.
    virtual void completed(std::string command_id, Completed_Status status);

    // An event of a subscription made with EventIF::subscribe. get_event_detail() gives its results until `expire`.
    virtual void notify_event(std::string event_id, std::string event_type, std::string subscribe_id, DateTime expire);

protected:
    // Not in the specification. Prevents further calls of this object's functions, and waits until none runs; on the notification
    // thread it does not wait.
    void end_notifications();
};

}  // namespace RoIS_Service
