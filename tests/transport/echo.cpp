// A WebSocket server for suites that test WebSockets: the gateway's own sessions, which return each message. Binary messages are
// refused with 1003, as by the gateway.
//     rois-echo [PORT]        prints its URL
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "engine/engine.hpp"
#include "files/files.hpp"
#include "gateway/access/secrets.hpp"
#include "gateway/gateway.hpp"
#include "net/server.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

EngineProfile profile() {
    EngineProfile profile;
    profile.object = {
        .identifier = "urn:x-rois:def:HRIEngine:echo", .code_space = {}, .name = "main", .description = {}, .meta_data = {}};
    return profile;
}

net::Settings settings(int port) {
    net::Settings settings;
    settings.port = static_cast<std::uint16_t>(port);
    settings.echo = true;
    settings.document.bytes = std::size_t{16} << 20;    // the longest message of the usual suites
    settings.max_fragments = std::size_t{1} << 20;      // a message of 4 MB in frames of 64 bytes
    settings.connect_timeout = std::chrono::hours{24};  // no session is ever opened
    settings.ping_interval = std::chrono::hours{24};    // suites count what they receive
    return settings;
}

void serve(int port) {
    xml::Platform const platform;
    auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    Readers readers;
    Engine engine{profile(), {}, {}, readers, fresh_secret};
    Telemetry telemetry;
    MemoryBudget memory;
    Gateway gateway{engine, readers, telemetry, ClientLimits{}, memory};
    net::Documents const documents{gateway, telemetry, *schemas, net::Site{"", WebFiles{{}}, ""}};
    net::Server server{settings(port), gateway, telemetry, documents, schemas};
    std::printf("%s\n", server.url().c_str());
    std::fflush(stdout);
    server.run();
}

}  // namespace rois

int main(int count, char** arguments) {
    try {
        rois::serve(count > 1 ? std::atoi(arguments[1]) : 0);
    } catch (std::exception const& problem) {
        std::fprintf(stderr, "rois-echo: %s\n", problem.what());
        return 1;
    }
}
