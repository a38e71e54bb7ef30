// Single HTTP requests: the engine's health, stop for everything, and the notifications of a session.
#pragma once

#include <chrono>
#include <string>

#include "command/exit.hpp"

namespace rois::command {

struct HttpAnswer {
    unsigned status = 0;
    std::string body;
};

// The server of a request: a URL as in the client library.
struct HttpServer {
    std::string url;
    std::string token{};             // empty: none
    std::string ca_file{};           // empty: only the system's certificates
    std::string certificate_file{};  // empty: none
};

// Gets `target`, for example "/readyz", after the path of the URL; in this session, unless it is empty. Throws Trouble: no_answer
// if there is no answer within `deadline`, usage if the URL is invalid.
HttpAnswer http_get(HttpServer const&, std::string const& target, std::chrono::milliseconds deadline,
                    std::string const& session = {});

// Posts to `target`, for example "/rois/stop", without a body. Throws Trouble like `http_get`.
HttpAnswer http_post(HttpServer const&, std::string const& target, std::chrono::milliseconds deadline);

// Throws Trouble (usage) if the URL is invalid or the file of certificates cannot be read.
void check(HttpServer const&);

// Returns whether both URLs have the same host, port, path and security (TLS or plain). Throws Trouble (usage) if a URL is
// invalid.
bool is_same_gateway(std::string const& url, std::string const& other);

// The trouble of a command (`command`) with an answer that it did not expect.
Trouble unexpected(std::string const& command, HttpServer const&, HttpAnswer const&);

// Returns advice about a URL at which no engine answers; empty if there is none.
std::string hint_for_url(std::string const& url);

}  // namespace rois::command
