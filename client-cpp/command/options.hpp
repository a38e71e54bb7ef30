// The options of the command line.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "command/http.hpp"
#include "command/output/printer.hpp"
#include "command/session/session_file.hpp"

namespace rois::command {

struct Options {
    std::string command;  // "profile", "search", ...

    // Options of all commands.
    std::string url;
    bool url_is_given = false;  // by --url or ROIS_URL
    std::string token;
    std::string ca_file;
    std::string certificate_file;
    std::string session;              // session to join; empty: opens one
    std::string session_file;         // names the session that a process in the background holds; empty: none
    std::optional<HeldSession> held;  // the content of the session file, if `session` comes from it
    bool over_http = false;
    std::chrono::milliseconds deadline{10'000};  // of each request
    bool deadline_is_given = false;              // by --timeout
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    Form form = Form::human;
    std::string colour = "auto";
    std::string record;  // file; empty: none

    // Options of some commands (see the help).
    std::string file;
    std::string ref;
    std::string name;                // of a query, an event, a command
    std::vector<std::string> words;  // refs, names, name=value
    std::string where;
    std::string condition_file;
    std::vector<std::string> starts;                // refs of components to start
    std::optional<std::chrono::milliseconds> span;  // --for
    std::optional<std::size_t> count;
    std::string listen;
    double speed = 1;
    bool wait = true;
    bool results = false;
    bool check = false;
    bool check_only = false;
    bool take_over = false;              // bind: from the session that has bound the component
    std::optional<Switching> switching;  // of bindings; empty: that of the present binding, or none
    bool quiet = false;
};

// The gateway, for requests without a session.
inline HttpServer server_of(Options const& options) {
    return {options.url, options.token, options.ca_file, options.certificate_file};
}

// The word that watch takes for the notification `switched` beside event types.
constexpr std::string_view switches = "switched";
inline bool watches_switches(Options const& options) {
    bool const is_chosen = options.words.empty() || std::ranges::find(options.words, switches) != options.words.end();
    return is_chosen && (options.command == "watch" || (options.command == "record" && options.listen.empty()));
}

// A text to print instead of running a command: help or version.
struct Printout {
    std::string text;
};

// Reads the command line, the variables ROIS_URL, ROIS_TOKEN, ROIS_CA_FILE, ROIS_CERTIFICATE_FILE, ROIS_SESSION and
// ROIS_SESSION_FILE, and the session file, whose session becomes `session` (`bind` reads the file later). Throws Trouble.
std::variant<Options, Printout> read_options(int argc, char const* const* argv);

// Sets the session and its gateway. Throws Trouble (usage) if --url or ROIS_URL names another gateway.
void join(Options&, HeldSession const&);

// Returns whether the command runs in the background: `bind` with a session file. Only the background process learns whether it
// opens a session or joins one that another process holds.
bool runs_in_background(Options const&);

// Warns on standard error of each ROIS_ variable that no program of the project reads.
void warn_of_unknown_variables();

}  // namespace rois::command
