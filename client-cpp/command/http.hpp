// Single HTTP requests, for what is no session: the engine's health.
#pragma once

#include <chrono>
#include <string>

namespace rois::command {

struct HttpAnswer {
    unsigned status = 0;
    std::string body;
};

// Where requests go: a URL as the client library takes it.
struct HttpServer {
    std::string url;
    std::string token{};    // empty: none
    std::string ca_file{};  // empty: the system's certificates alone
};

// Gets "/readyz" or the like, behind the path of the URL, in this time. Throws Trouble (no_answer) when there is no answer;
// (usage) for a URL that is none.
HttpAnswer http_get(HttpServer const&, std::string const& target, std::chrono::milliseconds deadline);

// For a URL of https or wss. Throws Trouble (usage) if the file of certificates cannot be read.
void check_ca_file(HttpServer const&);

// What may be wrong with a URL that leads to no engine; empty if nothing is known.
std::string hint_for_url(std::string const& url);

}  // namespace rois::command
