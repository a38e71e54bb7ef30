// Single HTTP requests, for what is no session of the client library: the engine's health, and sessions that others hold.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace rois::command {

struct HttpAnswer {
    unsigned status = 0;
    std::string body;
};

struct HttpRequest {
    std::string target;  // "/rois", behind the path of the URL
    std::string body{};  // empty: GET; else POST, as application/xml
    std::string session{};
};

// Where requests go: a URL as the client library takes it.
struct HttpServer {
    std::string url;
    std::string token{};    // empty: none
    std::string ca_file{};  // empty: the system's certificates alone
};

// Waits for the answer, in this time. Throws Trouble (no_answer) when there is none; (usage) for a URL that is none.
HttpAnswer ask(HttpServer const&, HttpRequest const&, std::chrono::milliseconds deadline);

}  // namespace rois::command
