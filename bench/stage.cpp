// rois-stage: the gateway's own libraries, connected as in server/main, with any number of probes (probe.hpp). For the benchmarks
// of fan-out, commands, growth and choosing. rois-stage PORT THREADS PROBES BYSTANDERS MEMBERS: probe0, probe1, ...; bystander0,
// bystander1, ...; and the logical component `probe` for robot0.probe, robot1.probe, ...
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "choosing/choosing.hpp"
#include "engine/engine.hpp"
#include "files/files.hpp"
#include "gateway/access/secrets.hpp"
#include "gateway/gateway.hpp"
#include "net/http/documents.hpp"
#include "net/server.hpp"
#include "probe.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::bench {

namespace {

struct Setting {
    std::uint16_t port;
    std::size_t threads;
    std::size_t probes;
    std::size_t bystanders;
    std::size_t members;
};

void add_members(std::size_t number, Gateway& gateway) {
    auto const of_probes = std::make_shared<ComponentProfile const>(probe_profile());
    choosing::Settings settings{.logical = {"probe"}, .sensing = {}, .engines = {}, .areas = {}};
    ComponentChange change{.going = {}, .coming = {}, .belongings = {.profiles = known_profiles(), .frames = {}, .places = {}}};
    for (std::size_t i = 0; i < number; ++i) {
        auto const& robot = settings.engines.emplace_back("robot" + std::to_string(i));
        change.coming.push_back(probe(robot + ".probe", of_probes, robot));
    }
    choosing::Choosing{settings, [](std::string const&) {}}.change(
        std::move(change), [&](ComponentChange all) { return gateway.change(std::move(all)); });
}

void serve(Setting const& setting) {
    auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    EngineProfile profile;
    profile.object.identifier = "urn:x-rois:def:HRIEngine:bench::Stage";
    profile.object.name = "stage";
    EngineSettings engine_settings;
    engine_settings.max_sessions = 100'000;
    engine_settings.max_predicates = 10'000'000;
    engine_settings.max_condition_steps = 1'000'000'000'000;
    engine_settings.max_waiting_notifications = 100'000;  // the benchmark of set_parameter over HTTP does not fetch them
    Readers readers;
    Engine engine{profile, known_profiles(), engine_settings, readers, fresh_secret};
    auto const of_probes = std::make_shared<ComponentProfile const>(probe_profile());
    auto const of_bystanders = std::make_shared<ComponentProfile const>(bystander_profile());
    for (std::size_t i = 0; i < setting.probes; ++i) engine.add(probe("probe" + std::to_string(i), of_probes));
    for (std::size_t i = 0; i < setting.bystanders; ++i) engine.add(probe("bystander" + std::to_string(i), of_bystanders));
    Telemetry telemetry;
    Gateway gateway{engine, readers, telemetry};
    net::Documents const documents{gateway, telemetry, *schemas, {}};
    net::Settings net_settings;
    net_settings.port = setting.port;
    net_settings.threads = setting.threads;
    net_settings.max_connections = 100'000;
    net::Server server{net_settings, gateway, telemetry, documents, schemas};
    if (setting.members > 0) add_members(setting.members, gateway);
    server.run();
}

}  // namespace

}  // namespace rois::bench

int main(int argc, char** argv) {
    if (argc != 6) {
        std::fputs("usage: rois-stage PORT THREADS PROBES BYSTANDERS MEMBERS\n", stderr);
        return 2;
    }
    auto const number = [&](int i) { return std::strtoul(argv[i], nullptr, 10); };
    try {
        rois::xml::Platform const platform;
        rois::bench::serve({static_cast<std::uint16_t>(number(1)), number(2), number(3), number(4), number(5)});
        return 0;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "rois-stage: %s\n", error.what());
        return 1;
    }
}
