// The engine's interfaces in the C++ PSM (section 7.7): SystemIF, CommandIF, QueryIF and EventIF (tables 2 to 5).
//
// All objects of a process share one session with one gateway. Its address is the environment variable ROIS_URL
// (default http://127.0.0.1:8080), its token ROIS_TOKEN (default none); connect() reads both.
//
// Return codes. Every function blocks until the engine has answered, for at most 10 s, and throws nothing:
//   OK                the operation succeeded; only then do out parameters change
//   BAD_PARAMETER     an argument is invalid: unknown name, wrong type, XML that the schemas do not allow
//   UNSUPPORTED       no component supports the operation
//   OUT_OF_RESOURCES  another session has bound the component
//   TIMEOUT           the engine did not answer in time, though the connection works
//   ERROR             not connected, connection lost, component not bound, or any other failure
// rois::psm::reason() (reason.hpp) says why the last call of the calling thread failed.
//
// Threads: any thread may call any function, also from inside a notification (RoIS_Service.hpp).
//
// XML: conditions and command sequences are XML texts. The gateway validates them. The prefixes fes, gml, unr, rois and
// xsi need no declaration. An empty condition restricts nothing.
#pragma once

#include <string>
#include <vector>

namespace RoLo::Architecture {

// One point as text, "x, y, th": millimetre, millimetre, degree counter-clockwise. Navigation also takes names of places.
using Data = std::string;

}  // namespace RoLo::Architecture

namespace RoIS_HRI {

// Table 1.
enum ReturnCode_t { OK, ERROR, BAD_PARAMETER, UNSUPPORTED, OUT_OF_RESOURCES, TIMEOUT };

using RoIS_Identifier = std::string;  // the code of the identifier (table 9), "navigation"
using RoIS_IdentifierList = std::vector<RoIS_Identifier>;
using Condition_t = std::string;          // fes:Filter or unr:SearchCondition, optionally followed by fes:SortBy; or empty
using HRI_Engine_Profile = std::string;   // a document with the root rois:HRIEngineProfile (table 24)
using CommandUnitSequence = std::string;  // rois:CommandUnitSequence, or the CommandUnitList of 2011 in the same element
using DateTime = std::string;             // UTC, "2026-11-20T12:00:00.123Z"
using Integer = long;

// Tables 16 to 19. A list of n items is n entries with the same name, in order; a list of numbers is one entry with the
// numbers separated by spaces. The entries of one list stand next to each other.
struct Result {
    std::string name;
    RoIS_Identifier data_type_ref;  // "string", "int", "RoISIdentifier[]", ...
    std::string value;
};

struct Parameter {
    std::string name;
    RoIS_Identifier data_type_ref;
    std::string value;
};

struct Argument {
    std::string name;
    RoIS_Identifier data_type_ref;
    std::string value;
};

using ResultList = std::vector<Result>;
using ParameterList = std::vector<Parameter>;
using ArgumentList = std::vector<Argument>;

// Table 2.
class SystemIF {
public:
    // Opens the session. Waits up to 5 s for the gateway. ERROR if there is no gateway, ROIS_URL is not a URL, or the token is
    // rejected. OK if the session is open already. After a lost link the session resumes by itself.
    ReturnCode_t connect();

    // Ends the session: the engine stops its actions and releases its components. No function of a notification receiver runs
    // after disconnect() has returned, unless disconnect() was called from inside one. ERROR if the gateway does not answer
    // within 2 s; the session has ended on this side all the same.
    ReturnCode_t disconnect();

    // The profile of the engine, or of the sub engine that the condition names (`engine` equal to its name).
    ReturnCode_t get_profile(Condition_t condition, HRI_Engine_Profile& profile);

    // The details of an error, by an error_id of notify_error.
    ReturnCode_t get_error_detail(std::string error_id, Condition_t condition, ResultList& results);
};

// Table 3.
class CommandIF {
public:
    // Returns the components that meet the condition. OK also if there are none.
    ReturnCode_t search(Condition_t condition, RoIS_IdentifierList& component_ref_list);

    // Reserves a component for this session until release() or disconnect().
    ReturnCode_t bind(RoIS_Identifier component_ref);
    ReturnCode_t bind_any(Condition_t condition, RoIS_Identifier& component_ref);
    ReturnCode_t release(RoIS_Identifier component_ref);

    // get_parameter and set_parameter need a binding: ERROR otherwise. set_parameter stores the parameters; the next `start` uses
    // them.
    ReturnCode_t get_parameter(RoIS_Identifier component_ref, ParameterList& parameters);
    ReturnCode_t set_parameter(RoIS_Identifier component_ref, ParameterList parameters, std::string& command_id);

    // Returns when the engine has accepted the sequence; each command is then reported by completed(). Name the commands
    // (rois:command_id) to recognise them there: the published operation has no way to return ids that the engine gives.
    ReturnCode_t execute(CommandUnitSequence command_unit_list);

    // The status of a command, and its results when it has completed.
    ReturnCode_t get_command_result(std::string command_id, Condition_t condition, ResultList& results);
};

// Table 4.
class QueryIF {
public:
    // Needs no binding. The condition selects the component that answers.
    ReturnCode_t query(std::string query_type, Condition_t condition, ResultList& results);
};

// Table 5.
class EventIF {
public:
    // Each event of this type that meets the condition is reported by notify_event(), until unsubscribe().
    ReturnCode_t subscribe(std::string event_type, Condition_t condition, std::string& subscribe_id);
    ReturnCode_t unsubscribe(std::string subscribe_id);

    // The results of an event, until its `expire` (60 s by default).
    ReturnCode_t get_event_detail(std::string event_id, Condition_t condition, ResultList& results);
};

}  // namespace RoIS_HRI
