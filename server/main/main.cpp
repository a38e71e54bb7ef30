// The main program of rois-gateway: makes all parts and connects them.
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "basic/base/component_names.hpp"
#include "choosing/choosing.hpp"
#include "engine/engine.hpp"
#include "files/files.hpp"
#include "gateway/access/host_names.hpp"
#include "gateway/gateway.hpp"
#include "gateway/process/memory.hpp"
#include "journal/journal_file.hpp"
#include "main/audit_file.hpp"
#include "main/changing_settings.hpp"
#include "main/choosing_section.hpp"
#include "main/command_line.hpp"
#include "main/configuration_file.hpp"
#include "main/engine_profile.hpp"
#include "main/engines_file.hpp"
#include "main/exposure.hpp"
#include "main/gateway_journal.hpp"
#include "main/health_check.hpp"
#include "main/held_signals.hpp"
#include "main/logging.hpp"
#include "main/places.hpp"
#include "main/profile_folder.hpp"
#include "main/program_tokens.hpp"
#include "main/reloading.hpp"
#include "main/speech_log.hpp"
#include "main/tokens_file.hpp"
#include "main/user_components.hpp"
#include "media/server.hpp"
#include "net/http/documents.hpp"
#include "net/server.hpp"
#include "remote/remote_engines.hpp"
#include "simulation/adapters/robots.hpp"
#include "simulation/adapters/simulated_hall.hpp"
#include "simulation/plan/floor_map.hpp"
#include "simulation/plan/floor_plan_file.hpp"
#include "simulation/scenario/scenario_file.hpp"
#include "simulation/world/simulation.hpp"
#include "wire/credentials.hpp"
#include "xml/codec/codec.hpp"
#include "xml/profiles/profile_document.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

namespace {

enum Exit : int { done = 0, could_not_start = 1, profile_refused = 1, bad_configuration = 2, not_halted = 71 };

// Returns the text of the file, or of the built-in file if the name is empty.
std::string chosen(std::string const& file, std::string_view built_in) {
    return file.empty() ? std::string{files::simulation().at(std::string{built_in})} : text_of_file(file);
}

basic::Streams streams(GatewaySettings const& settings) {
    return settings.media.host.empty() ? basic::Streams::none : basic::Streams::served;
}

// Returns the names of the components that are made from the folder of profiles.
std::vector<std::string> user_names(std::shared_ptr<xml::Schemas const> const& schemas, GatewaySettings const& settings,
                                    std::vector<ComponentProfile> const& own) {
    std::vector<std::string> names;
    if (settings.profiles.empty()) return names;
    for (auto const& file : read_profile_folder(schemas, settings.profiles, own, streams(settings)))
        if (file.profile) names.push_back(basic::component_name(*file.profile));
    return names;
}

std::shared_ptr<simulation::Simulation> make_simulation(std::shared_ptr<xml::Schemas const> const& schemas,
                                                        GatewaySettings const& settings,
                                                        std::vector<ComponentProfile> const& profiles) {
    auto const named = [](std::string const& file, std::string const& built_in) { return file.empty() ? built_in : file; };
    auto plan = simulation::read_floor_plan(schemas, named(settings.floor_plan, "reception-hall.xml"),
                                            chosen(settings.floor_plan, "reception-hall.xml"));
    auto scenario =
        simulation::read_scenario(schemas, named(settings.scenario, "reception-day.xml"),
                                  chosen(settings.scenario, "reception-day.xml"), plan, user_names(schemas, settings, profiles));
    auto const robot = std::ranges::find(plan.robots, settings.engine_name, &simulation::RobotPlan::name);
    if (settings.robots == Robots::simulated && robot != plan.robots.end())
        throw BadSettings("engine_name: '" + settings.engine_name +
                          "' is the name of a robot of the floor plan; choose another name, so that conditions and profiles can "
                          "distinguish the engine from its robot");
    return std::make_shared<simulation::Simulation>(std::move(plan), std::move(scenario), settings.seed, settings.sim_speed);
}

// The host of a URL: "robots.example" of "https://robots.example:8443/media". Not for IPv6 addresses.
std::string_view host_of_url(std::string_view url) {
    auto const scheme_end = url.find("://");
    if (scheme_end == std::string_view::npos) return {};
    url.remove_prefix(scheme_end + 3);
    return url.substr(0, url.find_first_of(":/"));
}

// Returns the network settings with all names of this gateway: the names in the key `hosts`, the machine's name, and the names in
// the keys for addresses.
net::Settings with_all_hosts(GatewaySettings const& settings) {
    auto all = settings.net;
    auto const add = [&](std::string_view name) {
        if (auto host = host_name(name)) all.hosts.push_back(std::move(*host));
    };
    add(machine_name().value_or(""));
    add(settings.net.host);
    add(settings.media.host);
    add(host_of_url(settings.media.url));
    return all;
}

ClientLimits client_limits(net::Settings const& settings) {
    return {.sessions_per_connection = settings.max_sessions_per_connection,
            .sessions_per_address = settings.max_sessions_per_address,
            .streams_per_session = settings.max_streams_per_session};
}

// Raises the limit of open files to `wanted` if it is lower, as far as the system allows. Returns the limit that is then in
// force.
std::size_t raise_open_files(std::size_t wanted) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return 0;
    if (limit.rlim_cur >= wanted) return limit.rlim_cur;
    rlimit const privileged{wanted, std::max<rlim_t>(limit.rlim_max, wanted)};
    if (::setrlimit(RLIMIT_NOFILE, &privileged) == 0) return wanted;
    rlimit const allowed{std::min<rlim_t>(limit.rlim_max, wanted), limit.rlim_max};
    return ::setrlimit(RLIMIT_NOFILE, &allowed) == 0 ? allowed.rlim_cur : limit.rlim_cur;
}

// Raises the limit of open files to the number that all connections need. If the system refuses, accepts fewer connections.
void make_room_for_connections(net::Settings& net, media::Settings const& media) {
    constexpr std::size_t own = 64, of_thread = 8;  // open files besides the connections, with some reserve
    auto const others = own + of_thread * net.threads + (media.host.empty() ? 0 : media.limits.max_connections);
    auto const wanted = others + net.max_connections;
    auto const possible = raise_open_files(wanted);
    if (possible >= wanted) return;
    auto const fit = std::max<std::size_t>(possible, others + 1) - others;
    spdlog::warn(
        "the limit of open files is {} and cannot be raised to {}, which max_connections = {} needs: at most {} connections are "
        "accepted; raise the hard limit (ulimit -Hn, LimitNOFILE, docker run --ulimit nofile)",
        possible, wanted, net.max_connections, fit);
    net.max_connections = fit;
}

// Returns null if no streams are served.
std::shared_ptr<media::Server> make_media(media::Settings settings, net::Settings const& net, Sites const& sites) {
    if (settings.host.empty()) return nullptr;
    settings.credentials = net.credentials;
    settings.limits = media_limits(settings.limits.max_connections, net);
    settings.is_own_host = [&sites](std::string_view host) { return sites.is_own_host(host); };
    settings.is_allowed_origin = [&sites](std::string_view origin, std::string_view host) {
        return sites.is_allowed_origin(origin, host);
    };
    return std::make_shared<media::Server>(std::move(settings), fresh_secret);
}

FloorMap without_robots(FloorMap map) {
    map.robots.clear();
    return map;
}

bool has_steering(GatewaySettings const& settings) { return settings.steering == Steering::on || settings.sim_speed == 0; }

ComponentProfile profile_of_hall(std::shared_ptr<xml::Schemas const> const& schemas) {
    auto const* const file = "simulated_hall.xml";
    return xml::read_component_profile(schemas, file, std::string{files::simulation().at(file)});
}

// The refs of all components that do not come from the user's profiles.
std::vector<std::string> own_refs(GatewaySettings const& settings, simulation::FloorPlan const& plan) {
    auto refs = simulation::component_refs(plan);
    if (has_steering(settings)) refs.emplace_back(simulation::simulated_hall_ref);
    return refs;
}

// Returns the names of this engine and its robots: a profile with two engines of the same name is invalid.
TakenNames names_of_engines(GatewaySettings const& settings, simulation::FloorPlan const& plan) {
    TakenNames taken{{settings.engine_name, "this engine (engine_name); choose another name"}};
    if (settings.robots == Robots::simulated)
        for (auto const& robot : simulation::robot_names(plan))
            taken.emplace(robot, "a simulated robot; choose another name, or set robots to none");
    return taken;
}

// Reads the certificates that the settings name. Returns null without TLS.
std::shared_ptr<tls::Credentials> credentials_of(GatewaySettings const& settings) try {
    if (!settings.join_ca_file.empty()) tls::require_certificates("join_ca_file", settings.join_ca_file);
    if (!settings.join_certificate_file.empty()) tls::require_identity("join_certificate_file", settings.join_certificate_file);
    return settings.tls.certificate.empty() ? nullptr : std::make_shared<tls::Credentials>(settings.tls);
} catch (std::runtime_error const& problem) {
    throw BadSettings{problem.what()};
}

// Returns a warning if the certificate has expired. Clients refuse it then.
std::vector<std::string> check_expiry(tls::Credentials const& credentials) {
    auto const expiry = tls::expiry_of(*credentials.context());
    if (expiry > std::chrono::system_clock::now()) return {};
    return {"tls_certificate: the certificate expired at " + to_text(expiry) + ": clients refuse it"};
}

constexpr std::chrono::milliseconds longest_reading{300};  // of files after SIGHUP, at the end (docs/safety.md#the-end)
constexpr std::chrono::milliseconds longest_end{4'800};    // after the sessions have ended

// A file system that does not answer, such as that of the audit log, does not keep the process.
void end_in_any_case(int exit_code) try {
    std::thread{[exit_code] {
        std::this_thread::sleep_for(longest_end);
        std::_Exit(exit_code);
    }}.detach();
} catch (std::system_error const& problem) {
    spdlog::warn("the end has no deadline: {}", problem.what());
}

// Makes all parts in the order of their dependencies, and serves until a signal arrives.
int serve(CommandLine const& command) {
    auto const& settings = command.settings;
    auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    auto const profiles = xml::read_component_profiles(schemas, files::profiles());
    auto const simulation = make_simulation(schemas, settings, profiles);
    auto const taken = names_of_engines(settings, simulation->hall().plan());
    auto const sub_engines =
        settings.engines.empty() ? std::vector<remote::SubEngine>{} : read_engines_file(settings.engines, taken);
    auto const choosing_settings = settings.engines.empty() ? choosing::Settings{} : read_choosing(settings.engines, sub_engines);
    auto const credentials = credentials_of(settings);
    auto const join_token = settings.join_token_file.empty() ? std::string{} : token_in(settings.join_token_file);
    auto warnings = command.warnings;
    std::ranges::copy(check_exposure(settings), std::back_inserter(warnings));
    if (credentials) std::ranges::copy(check_expiry(*credentials), std::back_inserter(warnings));
    if (command.wish == CommandLine::Wish::check_config) {
        if (!settings.tokens.empty()) read_tokens(settings.tokens);
        check_places(settings);
        for (auto const& warning : warnings) std::fprintf(stderr, "rois-gateway: warning: %s\n", warning.c_str());
        std::puts("configuration ok");
        return done;
    }
    auto opened = opened_journal(settings, schemas);
    auto const log = set_up_logging(settings.log_format, settings.log_level);
    LogFlush const flush;
    release_large_blocks_at_once();
    auto net_settings = with_all_hosts(settings);
    net_settings.credentials = credentials;
    make_room_for_connections(net_settings, settings.media);
    for (auto const& warning : warnings) spdlog::warn("{}", warning);
    Sites sites{net_settings};
    auto const media = make_media(settings.media, net_settings, sites);
    Readers readers;
    auto const instance = fresh_secret();
    Engine engine{engine_profile(settings, simulation->hall().plan(), instance), profiles, settings.engine, readers,
                  fresh_secret};
    engine.add(simulation, std::string{simulation::Simulation::provider});
    engine.describe(simulation::named_places(simulation->hall().plan()));
    auto const robots = simulation::robots(simulation, media);
    if (settings.robots == Robots::simulated)
        for (auto& component : basic::robot_components(robots, profiles)) engine.add(std::move(component));
    if (has_steering(settings)) engine.add(simulation::simulated_hall(simulation, profile_of_hall(schemas)));
    SpeechLog const speech_log{simulation};
    Telemetry telemetry;
    telemetry.show(log);
    if (credentials) telemetry.certificate_expires(tls::expiry_of(*credentials->context()));
    MemoryBudget memory{settings.net.memory_budget, memory_in_use};
    MemoryReserve const reserve{memory};
    Tokens tokens{settings.max_wrong_tokens};
    std::optional<TokensFile> tokens_file;
    if (!settings.tokens.empty()) tokens_file.emplace(settings.tokens, tokens);
    ProgramTokens program_tokens{settings.max_wrong_tokens};
    std::optional<AuditFile> audit_file;
    if (!settings.audit_log.empty())
        audit_file.emplace(settings.audit_log,
                           AuditFile::Limits{.bytes = settings.audit_log_bytes, .files = settings.audit_log_files});
    Gateway gateway{engine, readers, telemetry, client_limits(net_settings), memory, tokens_file ? &tokens : nullptr};
    if (audit_file) {
        gateway.audit_to([&](AuditEntry const& entry) { audit_file->note(entry); });
        telemetry.show_audit([&] { return audit_file->lost(); });
    }
    std::optional<GatewayJournal> journal;
    if (opened) journal.emplace(*std::move(opened), engine, gateway, telemetry);
    UserComponents user_components{
        schemas, {robots, schemas}, profiles, own_refs(settings, simulation->hall().plan()), settings.profiles};
    if (!settings.profiles.empty()) gateway.change(user_components.read());
    user_components.keep();
    std::vector<EngineState> const none;
    choosing::Choosing choosing{choosing_settings, [](std::string const& line) { spdlog::warn("choosing: {}", line); }};
    if (!choosing_settings.engines.empty()) engine.add(choosing.device(), choosing::Choosing::provider);
    std::optional<remote::RemoteEngines> remote_engines;
    auto const map = simulation::floor_map(simulation->hall().plan());
    net::Documents const documents{gateway,
                                   telemetry,
                                   *schemas,
                                   {.page = files::web().at("index.html"),
                                    .console = WebFiles{files::console()},
                                    .floor_map = xml::encode(map),
                                    .floor_map_without_robots = xml::encode(without_robots(map)),
                                    .engines = [&] { return remote_engines ? remote_engines->states() : none; }}};
    if (!settings.engines.empty() || !settings.join.empty()) {
        remote_engines.emplace(remote::RemoteEngines::Host{
            .name = settings.engine_name,
            .instance = instance,
            .schemas = schemas,
            .change =
                [&](ComponentChange change) {
                    return choosing.change(std::move(change),
                                           [&](ComponentChange all) { return gateway.change(std::move(all)); });
                },
            .report = [](std::string const& name, std::string const& what) { spdlog::info("{}: {}", name, what); },
            .token = [&](std::string const& name) { return program_tokens.make(name); },
            .earlier_session = [&](std::string const& name) { return gateway.earlier_session(name); },
            .session_opened = [&](std::string const& name, SessionId const& id,
                                  std::function<void()> then) { gateway.session_opened_there(name, id, std::move(then)); },
            .stopped_there = [&](std::string const& name,
                                 std::optional<std::uint64_t> stop) { gateway.stopped_there(name, stop); },
            .commands_ended = [&](std::string const& name,
                                  std::vector<CommandEnded> ended) { gateway.ended_there(name, std::move(ended)); }});
        engine.add(remote_engines->pulse(), "pulse");
        engine.on_stop([&](bool is_stopped) { remote_engines->everything_stopped(is_stopped); });
    }
    if (!settings.engines.empty()) net_settings.program_tokens = &program_tokens.all();
    if (!settings.engines.empty())
        net_settings.join = [&](UniqueDescriptor socket, std::string head, std::shared_ptr<Rights const> rights) {
            remote_engines->accept(std::move(socket), std::move(head), [&, rights = std::move(rights)](std::string const& name) {
                bool const may = rights == nullptr || rights->sees_all_of(name + ".");
                if (!may && audit_file)
                    audit_file->note(
                        {.what = "refused", .token = rights->holder(), .operation = "join", .outcome = "not_allowed"});
                return may;
            });
        };
    if (journal) journal->restore(gateway.tokens());
    net::Server server{net_settings, gateway, telemetry, documents, schemas};
    hold_signals(SIG_UNBLOCK);
    std::vector<Reloading::Part> files;
    auto const read_again = [&](bool is_used, std::string name, std::function<std::function<void()>()> prepare) {
        if (is_used) files.push_back({std::move(name), std::move(prepare)});
    };
    read_again(!settings.profiles.empty(), "the folder of profiles", [&] {
        auto const change = std::make_shared<ComponentChange>(user_components.read());
        return [&, change] {
            gateway.change(std::move(*change));
            user_components.keep();
        };
    });
    read_again(true, "the settings", [&, present = settings]() mutable {
        auto const wanted = command.read_again();
        return [&, wanted] {
            auto const before = std::exchange(present, with_changes(present, wanted));
            report_changes(before, present, wanted);
            auto next = with_all_hosts(present);
            next.credentials = credentials;
            make_room_for_connections(next, wanted.media);
            server.use(next);
            gateway.use(client_limits(next), wanted.engine);
            memory.limit(next.memory_budget);
            if (media) media->use(media_limits(wanted.media.limits.max_connections, next));
            if (audit_file) audit_file->limit(wanted.audit_log_bytes, wanted.audit_log_files);
            if (journal) journal->limit(wanted.state_bytes);
            tokens.limit(wanted.max_wrong_tokens);
            program_tokens.all().limit(wanted.max_wrong_tokens);
            sites.use(next);
        };
    });
    read_again(tokens_file.has_value(), "the tokens", [&] {
        tokens_file->read();
        return [&] { tokens_file->look(); };
    });
    read_again(credentials != nullptr, "the certificate", [&] {
        return [&, context = credentials->read_again()] {
            credentials->use(context);
            telemetry.certificate_expires(tls::expiry_of(*context));
            for (auto const& warning : check_expiry(*credentials)) spdlog::warn("{}", warning);
        };
    });
    read_again(!settings.engines.empty(), "the file of engines", [&] {
        auto const wanted = read_engines_file(settings.engines, taken);
        if (read_choosing(settings.engines, wanted) != choosing_settings)
            spdlog::warn("engines: a change of \"choosing\" has no effect before the gateway starts again");
        return [&, wanted] { remote_engines->set(wanted, server.url_for_programs()); };
    });
    Reloading reloading{std::move(files), telemetry};
    server.on_hang_up([&] { reloading.ask(); });
    if (!settings.engines.empty()) remote_engines->set(sub_engines, server.url_for_programs());
    if (!settings.join.empty()) {
        auto const& name = settings.join_as.empty() ? settings.engine_name : settings.join_as;
        remote_engines->join({.url = settings.join,
                              .name = name,
                              .token = join_token,
                              .ca_file = settings.join_ca_file,
                              .certificate_file = settings.join_certificate_file,
                              .own_gateway = [&server] { return server.connect(); }});
    }
    if (media) spdlog::info("media are served under {}", media->url());
    spdlog::info("listening on {}", server.url());
    auto const exit_code = server.run() ? done : not_halted;
    hold_signals(SIG_BLOCK);
    end_in_any_case(exit_code);
    if (journal) journal->finish(exit_code);
    if (!reloading.finish(longest_reading)) {
        spdlog::error("SIGHUP: a file that is being read does not answer");
        spdlog::default_logger_raw()->flush();
        std::_Exit(exit_code);
    }
    engine.on_stop([](bool) {});
    remote_engines.reset();  // before the server, which its links use
    spdlog::info("stopped");
    return exit_code;
}

int check_health(GatewaySettings const& settings) {
    auto const trouble = rois::check_health(settings.net.host, settings.net.port, settings.tls);
    if (trouble.empty()) return done;
    std::fprintf(stderr, "rois-gateway: not healthy: %s\n", trouble.c_str());
    return could_not_start;
}

int check_profiles(std::string const& folder, GatewaySettings const& settings) {
    auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    auto const checked =
        read_profile_folder(schemas, folder, xml::read_component_profiles(schemas, files::profiles()), streams(settings));
    std::fputs(report_of(checked).c_str(), stdout);
    bool const refused = std::ranges::find(checked, ProfileFile::Verdict::refused, &ProfileFile::verdict) != checked.end();
    return refused ? profile_refused : done;
}

int about_tokens(CommandLine const& command) {
    auto const& file = command.settings.tokens;
    if (command.wish == CommandLine::Wish::add_token) {
        auto const token = add_token(file, command.token);
        if (std::puts(token.c_str()) < 0 || std::fflush(stdout) != 0) {
            revoke_token(file, command.token.name);
            throw BadSettings{"token: it cannot be written to the standard output, and was not added"};
        }
        std::fputs("rois-gateway: keep this token, it is not shown again\n", stderr);
    } else if (command.wish == CommandLine::Wish::revoke_token) {
        revoke_token(file, command.token.name);
    } else {
        std::fputs(table_of(read_tokens(file), std::chrono::system_clock::now()).c_str(), stdout);
    }
    return done;
}

int run(int argc, char const* const* argv) {
    auto command = read_command_line(argc, argv);
    command.read_again = [=] { return read_command_line(argc, argv).settings; };
    if (command.wish != CommandLine::Wish::serve) hold_signals(SIG_UNBLOCK);
    switch (command.wish) {
        case CommandLine::Wish::say:
            std::fputs(command.words.c_str(), stdout);
            return done;
        case CommandLine::Wish::check_health:
            return check_health(command.settings);
        case CommandLine::Wish::check_profiles:
            return check_profiles(command.folder, command.settings);
        case CommandLine::Wish::add_token:
        case CommandLine::Wish::list_tokens:
        case CommandLine::Wish::revoke_token:
            return about_tokens(command);
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
    rois::hold_signals(SIG_BLOCK);
    rois::protect_standard_files();
    std::signal(SIGHUP, SIG_IGN);  // until there is something to read again
    try {
        rois::xml::Platform const platform;
        return rois::run(argc, argv);
    } catch (rois::BadSettings const& error) {
        return rois::complain(error, rois::bad_configuration);
    } catch (rois::journal::BadJournal const& error) {
        return rois::complain(error, rois::bad_configuration);
    } catch (rois::xml::BadDocument const& error) {
        return rois::complain(error, rois::bad_configuration);
    } catch (std::exception const& error) {
        return rois::complain(error, rois::could_not_start);
    }
}
