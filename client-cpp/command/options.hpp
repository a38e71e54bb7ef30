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

namespace rois::command {

struct Options {
    std::string command;  // "profile", "search", ...

    // Of every command.
    std::string url;
    std::string token;
    std::string ca_file;
    std::string session;  // joined instead of opening one; empty: none
    bool over_http = false;
    std::chrono::milliseconds deadline{10'000};  // of each request
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

// Throws Trouble, with what was wrong. Reads ROIS_URL, ROIS_TOKEN, ROIS_CA_FILE and ROIS_SESSION.
std::variant<Options, Said> read_options(int argc, char const* const* argv);

}  // namespace rois::command
