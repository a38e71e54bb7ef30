#include "sdk/cpp/component_program.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <utility>

#include "basic/adapters/robots.hpp"
#include "engine/engine.hpp"
#include "files/files.hpp"
#include "gateway/access/secrets.hpp"
#include "gateway/gateway.hpp"
#include "net/http/documents.hpp"
#include "net/server.hpp"
#include "remote/remote_engines.hpp"
#include "xml/profiles/profile_document.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::sdk {

namespace {

constexpr int could_not_start = 70, not_halted = 71;
constexpr std::size_t most_unsent_events = 10'000;

std::shared_ptr<xml::Schemas const> const& schemas() {
    static xml::Platform const platform;  // outlives the schemas
    static auto const all = std::make_shared<xml::Schemas const>(files::schemas());
    return all;
}

using Profiles = std::vector<ComponentProfile>;

// What a program adds to its engine.
struct Parts {
    Components components{};
    std::shared_ptr<Device> device{};  // null: none
    std::string provider{};            // of the device
    bool returns_at_once = true;       // the device and its components
    std::string crs{};                 // the engine's frame; empty: none
};
using Make = std::function<Parts(Profiles const& built_in)>;

ParameterProfile text_parameter(std::string name, std::string value) {
    return {.name = std::move(name),
            .data_type_ref = {.code = "string", .authority = {}, .codebook_ref = {}, .version = {}},
            .default_value = std::move(value),
            .description = {}};
}

EngineProfile profile_of_program(std::string const& name, std::string const& instance, std::string const& crs) {
    EngineProfile profile;
    profile.object.identifier = "urn:x-rois:def:HRIEngine:program::" + name;
    profile.object.code_space = "urn:ietf:rfc:2141";
    profile.object.name = name;
    profile.parameters = {text_parameter("instance", instance)};
    if (!crs.empty()) profile.parameters.push_back(text_parameter("crs", crs));
    return profile;
}

// The program is a small engine with a gateway that listens nowhere, and joins as a robot's gateway does.
bool serve(remote::Joining const& joining, Make const& make) {
    auto const& name = joining.name;
    Readers readers;
    auto const instance = fresh_secret();
    auto const profiles = xml::read_component_profiles(schemas(), files::profiles());
    auto parts = make(profiles);
    EngineSettings limits;
    limits.max_kept_events = limits.max_waiting_notifications = most_unsent_events;
    Engine engine{profile_of_program(name, instance, parts.crs), profiles, limits, readers, fresh_secret};
    if (!parts.crs.empty()) engine.describe({.frames = {parts.crs}, .all = {}});
    if (parts.device) engine.add(parts.device, parts.provider, parts.returns_at_once);
    for (auto& component : parts.components) engine.add(std::move(component));
    Telemetry telemetry;
    Gateway gateway{engine, readers, telemetry};
    net::Documents const documents{gateway, telemetry, *schemas(), {}};
    net::Settings settings;
    settings.host.clear();
    net::Server server{settings, gateway, telemetry, documents, schemas()};
    remote::RemoteEngines engines{
        {.name = name,
         .instance = instance,
         .schemas = schemas(),
         .change = [](ComponentChange const&) { return std::vector<std::string>{}; },
         .report = [](std::string const& whose, std::string const& what) { spdlog::info("{}: {}", whose, what); }}};
    auto own = joining;
    own.own_gateway = [&server] { return server.connect(); };
    engines.join(std::move(own));
    return server.run();
}

int serve(int argc, char const* const* argv, std::string name, Make const& make) {
    CLI::App program{"Components of a RoIS engine"};
    remote::Joining joining{.url = "ws://127.0.0.1:8080", .name = std::move(name), .own_gateway = {}};
    program.add_option("--url", joining.url, "the gateway to join")->envname("ROIS_URL")->capture_default_str();
    program.add_option("--name", joining.name, "the name by which the program joins")
        ->envname("ROIS_NAME")
        ->capture_default_str();
    program.add_option("--token", joining.token, "the token that the gateway expects")->envname("ROIS_TOKEN");
    program.add_option("--ca-file", joining.ca_file, "certificates that the gateway may have, besides those of the system")
        ->envname("ROIS_CA_FILE");
    program.add_option("--certificate-file", joining.certificate_file, "the program's own certificate and its key")
        ->envname("ROIS_CERTIFICATE_FILE");
    CLI11_PARSE(program, argc, argv);
    try {
        return serve(joining, make) ? 0 : not_halted;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return could_not_start;
    }
}

}  // namespace

ComponentDescription describe(std::string ref, std::string const& profile) {
    ComponentDescription description;
    auto read = xml::read_component_profile(schemas(), ref, profile);
    description.ref = {
        .code = std::move(ref), .authority = read.object.code_space, .codebook_ref = read.object.identifier, .version = {}};
    description.profile = std::make_shared<ComponentProfile const>(std::move(read));
    return description;
}

int serve(int argc, char const* const* argv, std::string name, std::function<Components()> const& make) {
    return serve(argc, argv, std::move(name), Make{[&](Profiles const&) { return Parts{.components = make()}; }});
}

int serve_robot(int argc, char const* const* argv, std::string name, std::function<Robot()> const& make) {
    return serve(argc, argv, std::move(name), Make{[&](Profiles const& built_in) {
                     auto const [body, device] = make();
                     return Parts{.components = basic::robot_components({.bodies = {body}, .media = nullptr}, built_in),
                                  .device = device,
                                  .provider = body->provider(),
                                  .returns_at_once = body->returns_at_once(),
                                  .crs = body->crs()};
                 }});
}

}  // namespace rois::sdk
