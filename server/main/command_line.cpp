#include "main/command_line.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <map>

#include "main/configuration_file.hpp"
#include "main/keys.hpp"
#include "types/text/environment.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr auto what_it_is =
    "RoIS Gateway: an HRI engine (RoIS) that speaks XML over HTTP and WebSocket, with a simulated reception robot.\n";

constexpr auto examples =
    "Every key is also a variable (ROIS_SIM_SPEED) and a key of the configuration file (sim_speed).\n"
    "A flag wins over a variable, a variable over the file.\n\n"
    "Examples:\n"
    "  rois-gateway                                      on http://127.0.0.1:8080\n"
    "  rois-gateway --listen [::1]:9000 --sim-speed 20   another address, twenty times as fast\n"
    "  rois-gateway --print-config > rois-gateway.json   write a configuration file to edit\n"
    "  rois-gateway --config rois-gateway.json --check-config\n"
    "  rois-gateway --check-profiles profiles            check a folder of component profiles\n"
    "  rois-gateway token add console --role operator --tokens tokens.json\n\n"
    "Exit codes:\n"
    "  0  stopped by a signal, or did what an option asked for\n"
    "  1  cannot start, is not healthy, or a profile was refused\n"
    "  2  invalid configuration\n"
    "  70 too many exceptions in a second, or the journal cannot be trusted; all components were halted\n"
    "  71 stopped by a signal, but a component did not confirm that it stands still";

struct Flags {
    std::string config;
    bool check_config = false;
    bool print_config = false;
    bool check_health = false;
    std::string check_profiles;
    bool version = false;
    struct {
        std::string name;
        std::string role;
        std::vector<std::string> components, commands;
        std::string expires;
        bool ever_expires = false;
    } token;
    std::map<std::string, std::string> values;  // by key
};

// Without this check, CLI11 would take the next flag as the missing value.
std::string is_a_value(std::string const& text) {
    return text.starts_with("--") ? "a value is missing before " + rois::quoted(text) : "";
}

// `token add|list|revoke`. The options of the gateway may follow, above all --tokens and --config.
void declare_tokens(CLI::App& app, Flags& flags) {
    auto& token = *app.add_subcommand("token", "add, list and revoke the tokens of clients (docs/trust.md)");
    auto& given = flags.token;
    token.require_subcommand(1);
    token.footer("The file of tokens: --tokens FILE, ROIS_TOKENS, or the key tokens of the configuration.");
    token.fallthrough();
    auto const name = [&](CLI::App& command) { command.add_option("NAME", given.name, "name of the token")->required(); };
    auto& add = *token.add_subcommand("add", "make a token, and print it: it is not shown again")->fallthrough();
    name(add);
    add.add_option("--role", given.role, "what it may do: " + names_of_roles())->option_text("ROLE")->required();
    add.add_option("--components", given.components, "pattern of the components that it sees; may be repeated [*]")
        ->option_text("PATTERN")
        ->expected(1)
        ->allow_extra_args(false)  // else [a,b] would be two patterns
        ->take_all();
    add.add_option("--commands", given.commands, "pattern of those among them that it may command; may be repeated [*]")
        ->option_text("PATTERN")
        ->expected(1)
        ->allow_extra_args(false)
        ->take_all();
    add.add_option("--expires", given.expires, "30d, 12h, 45min, a day (at its end), or a time such as 2027-01-31T18:00:00Z")
        ->option_text("WHEN")
        ->each([&given](std::string const&) { given.ever_expires = true; });
    token.add_subcommand("list", "print all tokens, without their secrets")->fallthrough();
    name(*token.add_subcommand("revoke", "remove a token: its sessions end within a second")->fallthrough());
}

TokenEntry token_of(Flags const& flags) {
    auto const& given = flags.token;
    TokenEntry entry;
    entry.name = given.name;
    if (!is_token_name(entry.name))
        throw BadSettings{"NAME must be letters, digits, '_', '-' and '.', 64 at most, not " + rois::quoted(given.name)};
    auto const role = read_role(given.role);
    if (!role) throw BadSettings{"--role must be one of " + names_of_roles() + ", not " + rois::quoted(given.role)};
    entry.role = *role;
    if (entry.role == Role::observer && !given.commands.empty())
        throw BadSettings{"--commands has no effect with --role observer, which commands nothing"};
    for (auto const& [flag, patterns] : {std::pair{"--components", &given.components}, {"--commands", &given.commands}})
        if (auto const bad = std::ranges::find_if_not(*patterns, is_pattern); bad != patterns->end())
            throw BadSettings{std::string{flag} + " cannot be " + rois::quoted(*bad) + ": " + std::string{expected_pattern}};
    if (!given.components.empty()) entry.components = given.components;
    if (!given.commands.empty()) entry.commands = given.commands;
    if (!given.ever_expires) return entry;
    auto const now = std::chrono::system_clock::now();
    entry.expires = read_expiry(given.expires, now);
    if (!entry.expires || *entry.expires <= now)
        throw BadSettings{
            "--expires must be a time in the future, before 2262: 30d, 12h, 45min, a day such as 2027-01-31, or a time such as "
            "2027-01-31T18:00:00Z, not " +
            rois::quoted(given.expires)};
    return entry;
}

void declare(CLI::App& app, Flags& flags) {
    app.set_help_flag("-h,--help", "print this help and exit");
    app.add_option("--check-profiles", flags.check_profiles, "check the component profiles in a folder, and exit")
        ->option_text("DIR");
    app.add_flag("--version", flags.version, "print the version and exit");
    app.add_option("--config", flags.config, "configuration file (ROIS_CONFIG)")->option_text("FILE");
    app.add_flag("--check-config", flags.check_config, "check the configuration, and exit");
    app.add_flag("--print-config", flags.print_config, "print a commented configuration file, and exit");
    app.add_flag("--check-health", flags.check_health, "check that the gateway with this configuration is healthy, and exit");
    for (auto const& key : keys()) {
        auto const now = key.show(GatewaySettings{});
        app.add_option(flag_of(key), flags.values[key.name], key.help)
            ->option_text(key.value + (now.empty() ? "" : " [" + now + "]"))
            ->type_name(key.value)
            ->check(is_a_value);
    }
    app.get_option("--allow-anyone")->expected(0, 1)->default_str("yes");
    declare_tokens(app, flags);
    app.footer(examples);
}

std::string variable(std::string const& name) {
    auto const* const value = std::getenv(name.c_str());
    return value ? value : "";
}

void set(GatewaySettings& settings, Key const& key, std::string const& where, std::string const& value) {
    if (key.set(settings, value)) return;
    throw BadSettings{where + " must be " + key.must_be + ", not " + rois::quoted(value)};
}

void check_ports(GatewaySettings const& settings) {
    bool const same = !settings.media.host.empty() && settings.media.port != 0 && settings.media.port == settings.net.port;
    if (same)
        throw BadSettings{"media and listen must not have the same port, " + std::to_string(settings.net.port) +
                          "; choose another port for media"};
}

void check_tls(tls::Files const& files) {
    auto const require = [](bool is_there, std::string const& key, std::string const& other) {
        if (!is_there) throw BadSettings{other + " needs " + key + ": expected the name of a file"};
    };
    require(files.key.empty() || !files.certificate.empty(), "tls_certificate", "tls_key");
    require(files.certificate.empty() || !files.key.empty(), "tls_key", "tls_certificate");
    require(files.client_ca.empty() || !files.certificate.empty(), "tls_certificate", "tls_client_ca");
    require(!files.client_must || !files.client_ca.empty(), "tls_client_ca", "tls_clients = required");
}

GatewaySettings gather(CLI::App const& app, Flags const& flags) {
    GatewaySettings settings;
    bool const named = app.count("--config") > 0;
    if (named && flags.config.empty()) throw BadSettings{"--config must be a FILE, not ''"};
    auto const file = named ? flags.config : variable("ROIS_CONFIG");
    if (!file.empty()) read_configuration_file(file, settings);
    for (auto const& key : keys()) {
        if (app.count(flag_of(key)) > 0) {
            set(settings, key, flag_of(key), flags.values.at(key.name));
        } else if (auto const value = variable(variable_of(key)); !value.empty()) {
            set(settings, key, variable_of(key), value);
        }
    }
    check_ports(settings);
    check_tls(settings.tls);
    return settings;
}

std::vector<std::string> warnings() {
    auto const is_key = [](std::string_view name) { return std::ranges::find(keys(), name, variable_of) != keys().end(); };
    auto all = unknown_variables(environ, is_key);
    for (auto& name : all)
        name = "the environment variable " + rois::quoted(name) + " is unknown and ignored; --help lists the keys";
    return all;
}

CommandLine say(std::string words) {
    CommandLine command;
    command.wish = CommandLine::Wish::say;
    command.words = std::move(words);
    return command;
}

CommandLine with(CommandLine::Wish wish, GatewaySettings settings, std::vector<std::string> warnings = {}) {
    CommandLine command;
    command.wish = wish;
    command.settings = std::move(settings);
    command.warnings = std::move(warnings);
    return command;
}

CommandLine about_tokens(CLI::App const& token, Flags const& flags, GatewaySettings settings) {
    if (settings.tokens.empty())
        throw BadSettings{
            "token: expected the file of tokens in --tokens FILE, ROIS_TOKENS, or the key tokens of the configuration"};
    if (token.got_subcommand("list")) return with(CommandLine::Wish::list_tokens, std::move(settings));
    bool const adds = token.got_subcommand("add");
    auto command = with(adds ? CommandLine::Wish::add_token : CommandLine::Wish::revoke_token, std::move(settings));
    if (adds) command.token = token_of(flags);
    command.token.name = flags.token.name;
    return command;
}

}  // namespace

CommandLine read_command_line(int argc, char const* const* argv) {
    CLI::App app{what_it_is, "rois-gateway"};
    Flags flags;
    declare(app, flags);
    try {
        app.parse(argc, argv);
    } catch (CLI::CallForHelp const&) {
        return say(app.help());
    } catch (CLI::ParseError const& error) {
        throw BadSettings{std::string{error.what()} + "; see rois-gateway --help"};
    }
    if (flags.version) return say("rois-gateway " ROIS_VERSION "\n");
    auto settings = gather(app, flags);
    if (app.got_subcommand("token")) return about_tokens(*app.get_subcommand("token"), flags, std::move(settings));
    if (app.count("--check-profiles") > 0) {
        auto command = with(CommandLine::Wish::check_profiles, std::move(settings));
        command.folder = std::move(flags.check_profiles);
        return command;
    }
    if (flags.print_config) return say(commented_configuration(settings));
    if (flags.check_health) return with(CommandLine::Wish::check_health, std::move(settings));
    return with(flags.check_config ? CommandLine::Wish::check_config : CommandLine::Wish::serve, std::move(settings), warnings());
}

}  // namespace rois
