// The grammar of the command line.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "command/printer.hpp"
#include "command/session_file.hpp"

namespace rois::command {

struct Options {
    std::string command;  // "profile", "search", ...

    // Of every command.
    std::string url;
    bool url_is_given = false;  // by --url or ROIS_URL
    std::string token;
    std::string ca_file;
    std::string session;              // joined instead of opening one; empty: none
    std::string session_file;         // names the session that a process in the background holds; empty: none
    std::optional<HeldSession> held;  // what the session file named, if `session` is from there
    bool over_http = false;
    std::chrono::milliseconds deadline{10'000};  // of each request
    bool deadline_is_given = false;              // by --timeout
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    Form form = Form::human;
    std::string colour = "auto";
    std::string record;  // file; empty: none

    // Of some; which, the help says.
    std::string file;
    std::string ref;
    std::string name;                // of a query, an event, a command
    std::vector<std::string> words;  // refs, names, name=value
    std::string where;
    std::string condition_file;
    std::vector<std::string> starts;                // components that are started
    std::optional<std::chrono::milliseconds> span;  // --for
    std::optional<std::size_t> count;
    std::string listen;
    double speed = 1;
    bool wait = true;
    bool results = false;
    bool check = false;
    bool quiet = false;
};

// What to say instead: help or version.
struct Said {
    std::string words;
};

// Reads the command line, the variables ROIS_URL, ROIS_TOKEN, ROIS_CA_FILE, ROIS_SESSION and ROIS_SESSION_FILE, and the session
// file, whose session becomes `session`; `bind` looks into the file later. Throws Trouble with the reason.
std::variant<Options, Said> read_options(int argc, char const* const* argv);

// The command then acts in this session, at its gateway. Throws Trouble (usage) if --url or ROIS_URL names another gateway.
void join(Options&, HeldSession const&);

// Whether the command goes on in the background: bind with a session file. Only there it finds out whether it opens a session or
// acts in one that another process holds.
bool runs_in_background(Options const&);

}  // namespace rois::command
