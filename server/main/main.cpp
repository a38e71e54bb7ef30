// The composition root of rois-gateway.
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "files/files.hpp"
#include "main/command_line.hpp"
#include "main/configuration_file.hpp"
#include "main/logging.hpp"
#include "net/documents.hpp"
#include "net/gateway.hpp"
#include "net/health_check.hpp"
#include "net/secrets.hpp"
#include "net/server.hpp"
#include "simulation/floor_plan_file.hpp"
#include "simulation/named_places.hpp"
#include "simulation/robot_components.hpp"
#include "simulation/scenario_file.hpp"
#include "simulation/simulation.hpp"
#include "xml/document.hpp"
#include "xml/schemas.hpp"

namespace rois {

namespace {

enum Exit : int { done = 0, could_not_start = 1, bad_configuration = 2 };

std::vector<ComponentProfile> read_profiles(std::shared_ptr<xml::Schemas const> const& schemas) {
    std::vector<ComponentProfile> profiles;
    for (auto const& [name, text] : files::profiles())
        profiles.push_back(xml::read_component_profile(schemas, name, std::string{text}));
    return profiles;
}

// The file's text, or that of the file inside the program when none is named.
std::string chosen(std::string const& file, std::string_view built_in) {
    return file.empty() ? std::string{files::simulation().at(std::string{built_in})} : text_of_file(file);
}

std::shared_ptr<simulation::Simulation> make_simulation(std::shared_ptr<xml::Schemas const> const& schemas,
                                                        Settings const& settings) {
    auto const named = [](std::string const& file, std::string const& built_in) { return file.empty() ? built_in : file; };
    auto plan = simulation::read_floor_plan(schemas, named(settings.floor_plan, "reception-hall.xml"),
                                            chosen(settings.floor_plan, "reception-hall.xml"));
    auto scenario = simulation::read_scenario(schemas, named(settings.scenario, "reception-day.xml"),
                                              chosen(settings.scenario, "reception-day.xml"), plan);
    return std::make_shared<simulation::Simulation>(std::move(plan), std::move(scenario), settings.seed, settings.sim_speed);
}

EngineProfile engine_profile(std::string const& name) {
    EngineProfile profile;
    profile.object.identifier = "urn:x-rois:def:HRIEngine:RoISGateway::" + name;
    profile.object.name = name;
    return profile;
}

// Builds all parts in order of need, and serves until a signal ends it.
int serve(CommandLine const& command) {
    auto const& settings = command.settings;
    auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    auto const profiles = read_profiles(schemas);
    auto const simulation = make_simulation(schemas, settings);
    if (command.wish == CommandLine::Wish::check_config) {
        std::puts("configuration ok");
        return done;
    }
    set_up_logging(settings.log_format, settings.log_level);
    net::Readers readers;
    Engine engine{engine_profile(settings.engine_name), profiles, settings.engine, readers, net::fresh_secret};
    engine.add(simulation);
    engine.describe(simulation::named_places(simulation->hall().plan()));
    for (auto& component : simulation::robot_components(simulation, profiles)) engine.add(std::move(component));
    net::Telemetry telemetry;
    net::Gateway gateway{engine, readers, telemetry};
    net::Documents const documents{gateway, telemetry, *schemas, files::web().at("index.html")};
    net::Server server{settings.net, gateway, telemetry, documents, schemas};
    spdlog::info("listening on {}", server.url());
    server.run();
    spdlog::info("stopped");
    return done;
}

int check_health(Settings const& settings) {
    auto const trouble = net::check_health(settings.net.host, settings.net.port);
    if (trouble.empty()) return done;
    std::fprintf(stderr, "rois-gateway: not healthy: %s\n", trouble.c_str());
    return could_not_start;
}

int run(int argc, char const* const* argv) {
    auto const command = read_command_line(argc, argv);
    switch (command.wish) {
        case CommandLine::Wish::say:
            std::fputs(command.words.c_str(), stdout);
            return done;
        case CommandLine::Wish::check_health:
            return check_health(command.settings);
        case CommandLine::Wish::serve:
        case CommandLine::Wish::check_config:
            break;
    }
    return serve(command);
}

int complain(std::exception const& error, Exit code) {
    std::fprintf(stderr, "rois-gateway: %s\n", error.what());
    return code;
}

}  // namespace

}  // namespace rois

int main(int argc, char** argv) {
    try {
        rois::xml::Platform const platform;
        return rois::run(argc, argv);
    } catch (rois::BadSettings const& error) {
        return rois::complain(error, rois::bad_configuration);
    } catch (rois::xml::BadDocument const& error) {
        return rois::complain(error, rois::bad_configuration);
    } catch (std::exception const& error) {
        return rois::complain(error, rois::could_not_start);
    }
}
