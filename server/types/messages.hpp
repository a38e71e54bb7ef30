// The messages between a service application and the engine: the operations of the RoIS interfaces (7.4.2, tables 2 to 5), the
// notifications (table 6) and the fault. An operation is a struct that contains the struct of its reply.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "types/codes.hpp"
#include "types/command_units.hpp"
#include "types/condition.hpp"
#include "types/ids.hpp"
#include "types/instant.hpp"
#include "types/profiles.hpp"
#include "types/space.hpp"
#include "types/values.hpp"

namespace rois {

// The common part of all replies. The other members of a reply are valid only if the code is OK.
struct Outcome {
    ReturnCode return_code = ReturnCode::ok;
    std::string reason;  // empty if OK
};

// --- System interface (table 2) ---

// How a WebSocket proves that its application is alive: by requests and pongs (which libraries and browsers send on their own),
// or only by requests.
enum class MotionProof : std::uint8_t { pong, request };

struct Connect {
    // The requested motion lease (decision 33), shorter than the gateway's.
    std::optional<std::chrono::milliseconds> motion_lease;
    std::optional<std::chrono::milliseconds> motion_lease_http;
    std::optional<MotionProof> motion_proof;
    bool is_engine = false;  // the client is another engine, which receives more (decision 39)
    // After this time without a link, the session ends.
    std::optional<std::chrono::milliseconds> window{};
    bool switches = false;  // notify the session of each `Switched`
    struct Reply : Outcome {
        SessionId session;
        std::optional<std::chrono::milliseconds> window{};  // if one was requested
    };
};

// Takes over a session on a WebSocket and continues after notification `last_sequence` (an extension; docs/clients.md).
struct Resume {
    SessionId session;
    std::uint64_t last_sequence = 0;
    struct Reply : Outcome {};
};

struct Disconnect {
    struct Reply : Outcome {};
};

// A component as get_profile lists it.
struct ComponentEntry {
    std::string ref;
    std::string type;    // URN of its profile
    std::string engine;  // name of its engine or sub engine
    std::shared_ptr<ComponentProfile const> profile;
    std::shared_ptr<ComponentTraits const> traits{};  // only for engines
};

struct GetProfile {
    QueryExpression condition;
    struct Reply : Outcome {
        std::shared_ptr<EngineProfile const> profile;
        std::vector<ComponentEntry> components;
        Space space{};  // only for engines
    };
};

struct GetErrorDetail {
    ErrorId error_id;
    QueryExpression condition;
    struct Reply : Outcome {
        Results results;
    };
};

// --- Command interface (table 3) ---

struct Search {
    QueryExpression condition;
    struct Reply : Outcome {
        std::vector<Identifier> component_ref_list;
    };
};

struct Bind {
    Identifier component_ref;
    Switching switching = Switching::none;
    bool take_over = false;  // from the session that has bound it (docs/trust.md)
    struct Reply : Outcome {};
};

struct BindAny {
    QueryExpression condition;
    Switching switching = Switching::none;
    struct Reply : Outcome {
        Identifier component_ref;
    };
};

struct Release {
    Identifier component_ref;
    struct Reply : Outcome {};
};

struct GetParameter {
    Identifier component_ref;
    struct Reply : Outcome {
        ParameterList parameters;
    };
};

struct SetParameter {
    Identifier component_ref;
    ParameterList parameters;
    bool check_only = false;  // nothing runs
    struct Reply : Outcome {
        CommandId command_id;  // empty after a check
    };
};

struct Execute {
    CommandUnitSequence command_unit_list;
    bool check_only = false;  // nothing runs
    struct Reply : Outcome {
        CommandUnitSequence command_unit_list;  // every command_id filled in; after a check, as it was sent
    };
};

struct GetCommandResult {
    CommandId command_id;
    QueryExpression condition;
    struct Reply : Outcome {
        Results results;
    };
};

// --- Query interface (table 4) ---

struct Query {
    std::string query_type;
    QueryExpression condition;
    struct Reply : Outcome {
        Identifier component_ref;  // of the component that answered
        Results results;
        std::vector<Results> other_rows{};  // of this component; only in the sessions of engines (decision 39)
    };
};

// --- Event interface (table 5) ---

struct Subscribe {
    std::string event_type;
    QueryExpression condition;
    bool inline_results = false;
    struct Reply : Outcome {
        SubscribeId subscribe_id;
    };
};

struct Unsubscribe {
    SubscribeId subscribe_id;
    struct Reply : Outcome {};
};

struct GetEventDetail {
    EventId event_id;
    QueryExpression condition;
    struct Reply : Outcome {
        Results results;
    };
};

// --- Stop for everything (decision 34), for applications and engines without HTTP ---

struct StopEverything {
    struct Reply : Outcome {
        std::optional<std::uint64_t> stop;    // for `ClearStop`; nullopt: everything had been stopped before, by someone else
        std::vector<std::string> not_halted;  // refs of components that have not confirmed that they stand still
    };
};

// Has no effect if everything was stopped again since.
struct ClearStop {
    static constexpr std::uint64_t own = 0;  // the one that this session has asked for
    std::uint64_t stop = own;
    struct Reply : Outcome {};
};

// All operations, in the order in which they are declared above.
using Operation = std::variant<Connect, Resume, Disconnect, GetProfile, GetErrorDetail, Search, Bind, BindAny, Release,
                               GetParameter, SetParameter, Execute, GetCommandResult, Query, Subscribe, Unsubscribe,
                               GetEventDetail, StopEverything, ClearStop>;

template <class>
struct ReplyOf;
template <class... Operations>
struct ReplyOf<std::variant<Operations...>> {
    using type = std::variant<typename Operations::Reply...>;
};
using Reply = ReplyOf<Operation>::type;

struct Request {
    Operation operation;
    std::string request_id;  // echoed in the answer; empty if absent
};

// --- Service application base (table 6): notifications ---

struct ReceiveEvent {
    EventId event_id;
    std::string event_type;
    SubscribeId subscribe_id;
    Utc expire;
    Identifier component_ref;
    std::shared_ptr<Results const> results;  // null unless the subscription has inline_results
};

struct ReceiveError {
    ErrorId error_id;
    ErrorType error_type = ErrorType::engine_internal_error;
    std::optional<Identifier> component_ref;
    std::optional<std::string> text{};  // for people; only for engines
};

struct Completed {
    CommandId command_id;
    CompletedStatus status = CompletedStatus::ok;
    // Only for engines. `reason`: why the status is not OK. `active`: a function of the component is active from now on.
    std::shared_ptr<Results const> results{};
    std::string reason{};
    std::optional<bool> active{};
};

// The state of a component; only for engines. `results`: its location, and the parameters that only it sets.
struct ComponentChanged {
    Identifier component_ref;
    ComponentStatus status = ComponentStatus::uninitialized;
    Results results;
};

// A logical component goes on with another member: the refs of the two, and why (docs/choosing.md).
struct Switched {
    Identifier component_ref;
    std::string from;
    std::string to;
    std::string reason;
};

// `count` notifications were dropped. This notification has the sequence of the last one.
struct Lost {
    std::uint64_t count = 0;
};

struct ProfileChanged {};

using Notification = std::variant<ReceiveEvent, ReceiveError, Completed, Lost, ProfileChanged, ComponentChanged, Switched>;

// --- Stop for everything: the answer to /rois/stop and /rois/clear (docs/safety.md, decision 34) ---

struct StopState {
    bool stopped = false;                 // nothing starts until it is cleared
    std::vector<std::string> not_halted;  // refs of components that have not confirmed that they stand still
};

// --- Fault: the message was rejected before any operation ran (docs/clients.md) ---

enum class FaultCode : std::uint8_t {
    not_well_formed,
    forbidden_xml,
    invalid,
    no_session,
    unauthorized,
    not_allowed,
    not_found,
    method_not_allowed,
    too_slow,
    length_required,
    too_large,
    unsupported_media_type,
    upgrade_required,
    too_many,
    header_too_large,
    uri_too_long,
    shutting_down
};

std::string_view to_text(FaultCode);

// Returns the HTTP status of an answer with this fault (docs/clients.md).
int http_status_of(FaultCode);

// A place in a document. Line and column count from 1; the column counts characters.
struct Place {
    std::uint64_t line = 1;
    std::uint64_t column = 1;
};

struct Fault {
    FaultCode code = FaultCode::invalid;
    std::string reason;
    std::optional<Place> place{};
    std::string request_id{};
};

}  // namespace rois
