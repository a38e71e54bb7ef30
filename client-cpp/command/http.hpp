// Single HTTP requests: the engine's health, stop for everything, and what a session has been told.
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

// Gets "/readyz" or the like, behind the path of the URL, in this time; in this session, unless it is empty. Throws Trouble
// (no_answer) when there is no answer; (usage) for a URL that is none.
HttpAnswer http_get(HttpServer const&, std::string const& target, std::chrono::milliseconds deadline,
                    std::string const& session = {});

// Posts to "/rois/stop" or the like, without a body. Throws Trouble like `http_get`.
HttpAnswer http_post(HttpServer const&, std::string const& target, std::chrono::milliseconds deadline);

// Throws Trouble (usage) for a URL that is none, and if the file of certificates cannot be read.
void check(HttpServer const&);

// Whether both URLs name the same host, port and path over the same kind of link (TLS or plain). Throws Trouble (usage) for a URL
// that is none.
bool is_same_gateway(std::string const& url, std::string const& other);

// What may be wrong with a URL that leads to no engine; empty if nothing is known.
std::string hint_for_url(std::string const& url);

}  // namespace rois::command
