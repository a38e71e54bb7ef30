#include "command/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <string_view>
#include <utility>

#include "command/exit.hpp"
#include "command/http.hpp"
#include "command/session/session_file.hpp"
#include "rois/settings.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"

namespace rois::command {

namespace {

constexpr auto description = "rois: controls a RoIS HRI engine from the command line (man rois)";

constexpr auto footer =
    "Examples:\n"
    "  rois search 'type = Navigation and status = READY'\n"
    "  rois start speech_synthesis speech_text=Welcome.\n"
    "  rois watch person_detected --start person_detection\n"
    "  rois query robot_position --json\n\n"
    "Exit codes: 0 OK, 1 ERROR, 2 wrong use, 3 BAD_PARAMETER, 4 UNSUPPORTED, 5 OUT_OF_RESOURCES, 6 TIMEOUT, 7 a command ended "
    "with\n"
    "ABORT, 8 no answer, 9 the document was rejected, 130 interrupted";

// Option values before their conversion.
struct Raw {
    double timeout = 10;
    double span = 0;
    std::size_t count = 0;
    bool xml = false;
    bool json = false;
    bool no_wait = false;
    std::vector<std::string> condition;  // words of a condition
    bool version = false;
};

// CLI::Range accepts nan.
CLI::Validator within(double least, double most) {
    return CLI::Validator{[least, most](std::string& text) -> std::string {
                              auto const value = to_number<double>(text);
                              if (value && *value >= least && *value <= most) return {};
                              std::ostringstream expected;
                              expected.precision(10);
                              expected << rois::quoted(text) << " is not a number from " << least << " to " << most;
                              return expected.str();
                          },
                          {}};
}

class Grammar {
public:
    Grammar(CLI::App& app, Options& options, Raw& raw) : app_{app}, options_{options}, raw_{raw} {
        general();
        for_asking();
        for_commanding();
        for_listening();
        for_files();
        name_values(app_);
        for (auto* const command : app_.get_subcommands({})) name_values(*command);
    }

private:
    void general() {
        app_.set_help_flag("-h,--help", "print this help");
        app_.set_help_all_flag("--help-all", "print the help of all commands");
        app_.footer(footer);
        app_.require_subcommand(0, 1);
        app_.fallthrough();
        app_.add_option("--url", options_.url, "URL of the gateway [http://127.0.0.1:8080] (ROIS_URL)")->option_text("URL");
        app_.add_option("--token", options_.token, "sent as Authorization: Bearer (ROIS_TOKEN)")
            ->envname("ROIS_TOKEN")
            ->option_text("TOKEN");
        app_.add_option("--ca-file", options_.ca_file, "trusted certificates, PEM (ROIS_CA_FILE)")
            ->envname("ROIS_CA_FILE")
            ->option_text("FILE");
        app_.add_option("--certificate-file", options_.certificate_file,
                        "own certificate and its key, PEM (ROIS_CERTIFICATE_FILE)")
            ->envname("ROIS_CERTIFICATE_FILE")
            ->option_text("FILE");
        app_.add_option("--session", options_.session, "use this session, which rois bind holds (ROIS_SESSION)")
            ->option_text("ID");
        app_.add_option("--session-file", options_.session_file,
                        "use the session that rois bind holds in the background under this file (ROIS_SESSION_FILE)")
            ->option_text("FILE");
        app_.add_flag("--http", options_.over_http, "use HTTP requests and an event stream instead of a WebSocket");
        app_.add_option("--timeout", raw_.timeout, "longest wait for an answer [10]")
            ->option_text("SECONDS")
            ->check(within(0.01, 86'400));
        auto* const xml = app_.add_flag("--xml", raw_.xml, "write XML documents");
        app_.add_flag("--json", raw_.json, "write JSON, one object per line")->excludes(xml);
        app_.add_option("--colour", options_.colour, "auto, always or never [auto]")
            ->option_text("WHEN")
            ->check(CLI::IsMember({"auto", "always", "never"}));
        app_.add_option("--record", options_.record, "also write all documents of the session to a file, for rois replay")
            ->option_text("FILE");
        app_.add_flag("--version", raw_.version, "print the version");
    }

    // Error messages name a value as the help does.
    static void name_values(CLI::App& app) {
        for (auto* const option : app.get_options())
            if (auto const& name = option->get_option_text(); !trimmed(name).empty()) option->type_name(name);
    }

    CLI::App& command(std::string const& name, std::string const& what) {
        auto& added = *app_.add_subcommand(name, what);
        added.fallthrough();
        added.callback([this, name] { options_.command = name; });
        return added;
    }

    void conditioned(CLI::App& command) {
        auto* const where =
            command.add_option("-w,--where", options_.where, "a condition, such as \"number > 0\"")->option_text("CONDITION");
        command.add_option("--condition", options_.condition_file, "a condition in XML; - is standard input")
            ->option_text("FILE")
            ->excludes(where);
    }

    void bounded(CLI::App& command, std::string const& what) {
        command.add_option("--for", raw_.span, what)->option_text("SECONDS")->check(within(0, 1e7));
    }

    void counted(CLI::App& command) {
        command.add_option("--count", raw_.count, "end after this many events")
            ->option_text("N")
            ->check(within(1, 1'000'000'000));
    }

    void starting(CLI::App& command) {
        command.add_option("--start", options_.starts, "bind and start this component; may be repeated")->option_text("REF");
    }

    void switching(CLI::App& command) {
        auto const take = [this](std::string const& text) { options_.switching = to_code<Switching>(text); };
        command
            .add_option_function<std::string>(
                "--switching", take,
                "what happens if the component that acts for a logical one fails: none, abort or restart [none]")
            ->option_text("WHAT")
            ->check(CLI::IsMember({"none", "abort", "restart"}));
    }

    // Adds positional arguments.
    CLI::Option* words(CLI::App& command, std::string const& name, std::string const& what) {
        return command.add_option(name, options_.words, what)->option_text(" ");
    }
    CLI::Option* ref(CLI::App& command) {
        return command.add_option("REF", options_.ref, "a component")->required()->option_text(" ");
    }

    void for_asking() {
        auto& profile = command("profile", "show the engine and its components, or the profile of one component");
        profile.add_option("REF", options_.ref, "a component")->option_text(" ");
        conditioned(profile);
        auto& search = command("search", "list the components that meet a condition");
        search.add_option("CONDITION", raw_.condition, "for example 'type = Navigation and status = READY'")->option_text(" ");
        conditioned(search);
        auto& query = command("query", "query the engine or a component");
        query.add_option("QUERY", options_.name, "a query type, for example robot_position")->required()->option_text(" ");
        query.add_option("--of", options_.ref, "query this component")->option_text("REF");
        conditioned(query);
        auto& get = command("get", "show the parameters of a component; needs no binding");
        ref(get);
        words(get, "NAME", "parameters; default: all");
        command("engines", "list the sub engines: state, link, round trip, components, last error");
        command("health", "check whether the engine is ready; exit code 0 or 1");
        command("stop-all", "halt all robots of all sessions; no command starts until clear");
        command("clear", "allow commands again after stop-all");
    }

    void for_commanding() {
        auto& bind =
            command("bind", "bind components, and hold them until interrupted, or in the background with --session-file");
        words(bind, "REF", "components");
        bind.add_flag("--take-over", options_.take_over, "halt the components, and take them from sessions that have bound them");
        switching(bind);
        conditioned(bind);
        bounded(bind, "hold them for this time");
        auto& release =
            command("release", "release components of a held session; without REF, end the session of --session-file");
        words(release, "REF", "components");
        auto& set = command("set", "set parameters of a component");
        ref(set);
        words(set, "NAME=VALUE", "parameters; a repeated name adds to a list")->required();
        auto& start = command("start", "start a component, and wait until the command has completed");
        ref(start);
        words(start, "NAME=VALUE", "arguments");
        switching(start);
        bounded(start, "keep the session for this time after the command");
        unwaited(start);
        auto& stop = command("stop", "stop a component");
        ref(stop);
        auto& resume = command("resume", "resume a component that was suspended, or whose motion is held");
        ref(resume);
        auto& execute = command("execute", "run a command of a component, or the sequence in a file");
        words(execute, "FILE|REF",
              "a file with a CommandUnitSequence (-: standard input); or a component, a command, NAME=VALUE...")
            ->required();
        switching(execute);
        execute.add_flag("--results", options_.results, "show the results of each command");
        execute.add_flag("--check-only", options_.check_only, "only check whether the commands are possible; nothing runs");
        unwaited(execute);
    }

    void unwaited(CLI::App& command) { command.add_flag("--no-wait", raw_.no_wait, "do not wait for the end; needs --session"); }

    void for_listening() {
        auto& subscribe = command("subscribe", "subscribe to events of one type, and show them until interrupted");
        subscribe.add_option("EVENT", options_.name, "an event type, for example person_detected")->required()->option_text(" ");
        conditioned(subscribe);
        counted(subscribe);
        bounded(subscribe, "end after this time");
        auto& watch = command("watch", "show all notifications: events, errors, ends of commands, and the state of the link");
        words(watch, "EVENT", "event types, or switched; default: all");
        conditioned(watch);
        starting(watch);
        counted(watch);
        bounded(watch, "end after this time");
    }

    void for_files() {
        auto& send = command("send", "send a document, and show the answer");
        send.add_option("FILE", options_.file, "the document (-: standard input)")->required()->option_text(" ");
        auto& record = command("record", "write all documents of a session to a file, or those of applications (--listen)");
        record.add_option("FILE", options_.file, "the recording")->required()->option_text(" ");
        words(record, "EVENT", "event types; default: all");
        starting(record);
        counted(record);
        bounded(record, "end after this time");
        listening(record, "serve applications at this address, and record them and the engine");
        auto& replay = command("replay", "serve a recording as an engine");
        replay.add_option("FILE", options_.file, "the recording")->required()->option_text(" ");
        listening(replay, "address to serve at [127.0.0.1:8080]; port 0: any free port");
        replay.add_option("--speed", options_.speed, "playback speed: 2 is twice as fast [1]; 0: no pauses")
            ->option_text("X")
            ->check(within(0, 1e6));
        auto& scenario = command("scenario", "run the state machine of a robot scenario");
        scenario.add_option("FILE", options_.file, "a scenario (schemas/scenario.xsd)")->required()->option_text(" ");
        words(scenario, "NAME=VALUE", "first values of variables");
        scenario.add_flag("--check", options_.check, "only check the file");
        scenario.add_flag("-q,--quiet", options_.quiet, "print only the texts of the scenario");
    }

    void listening(CLI::App& command, std::string const& what) {
        command.add_option("--listen", options_.listen, what)->option_text("HOST:PORT");
    }

    CLI::App& app_;
    Options& options_;
    Raw& raw_;
};

std::chrono::milliseconds milliseconds_of(double seconds) { return std::chrono::milliseconds{std::llround(seconds * 1'000)}; }

// Returns the URL of a gateway in the same container: the port of its ROIS_LISTEN.
std::string url_beside_gateway() {
    auto const* const listen = std::getenv("ROIS_LISTEN");
    if (listen == nullptr) return default_url();
    std::string const address{listen};
    auto const colon = address.rfind(':');
    if (colon == std::string::npos) return default_url();
    auto const host = address.substr(0, colon);
    bool const everywhere = host == "0.0.0.0" || host == "[::]";
    return "http://" + (everywhere ? "127.0.0.1" : host) + address.substr(colon);
}

std::string joined(std::vector<std::string> const& words) {
    std::string text;
    for (auto const& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

// Returns the edit distance: how many letters must be changed, added or removed to turn one word into the other.
std::size_t distance(std::string_view one, std::string_view other) {
    std::vector<std::size_t> row(other.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < one.size(); ++i) {
        auto above_left = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < other.size(); ++j) {
            auto const least = std::min({row[j] + 1, row[j + 1] + 1, above_left + (one[i] != other[j] ? 1 : 0)});
            above_left = std::exchange(row[j + 1], least);
        }
    }
    return row.back();
}

std::string no_such_command(CLI::App const& app, std::string const& word) {
    std::string nearest;
    std::size_t least = 3;  // letters; suggests no command that differs more
    for (auto const* const command : app.get_subcommands({})) {
        auto const& name = command->get_name();
        auto const off = name.starts_with(word) && word.size() > 1 ? 0 : distance(word, name);
        if (off >= least) continue;
        least = off;
        nearest = name;
    }
    return "unknown command " + rois::quoted(word) + (nearest.empty() ? "" : " (did you mean " + rois::quoted(nearest) + "?)");
}

// Returns the error, and which help to read.
std::string complaint(CLI::App const& app, CLI::ParseError const& error) {
    auto const chosen = app.get_subcommands();
    auto const left_over = app.remaining();
    bool const is_command = chosen.empty() && !left_over.empty() && !left_over.front().starts_with('-');
    auto const wrong = is_command ? no_such_command(app, left_over.front()) : error.what();
    return wrong + "; see rois " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help";
}

bool has(CLI::App const& app, std::string const& command, std::string const& option) {
    auto const* const chosen = app.get_subcommand(command);
    auto const* const known = chosen->get_option_no_throw(option);
    return known != nullptr && known->count() > 0;
}

bool needs_no_session(Options const& options) {
    return options.command == "engines" || options.command == "health" || options.command == "stop-all" ||
           options.command == "clear";
}

bool has_own_session(Options const& options) {
    return needs_no_session(options) || options.command == "scenario" || options.command == "record" ||
           options.command == "replay";
}

// Takes the session from the session file. `bind` does so later.
void join_held_session(Options& options) {
    if (options.session_file.empty() || has_own_session(options)) return;
    if (!options.session.empty())
        throw Trouble{Exit::usage,
                      "--session (ROIS_SESSION) and --session-file (ROIS_SESSION_FILE) name two sessions; give only one"};
    if (options.command == "bind") return;
    auto const held = find_held_session(options.session_file, options.deadline);
    if (!held) throw no_holder(options.session_file);
    join(options, *held);
}

// For `stop-all` and `clear`: returns the URL in the session file; empty if no process holds a session.
std::string url_of_held_session(Options const& options) {
    bool const is_for_everything = options.command == "stop-all" || options.command == "clear";
    if (!is_for_everything || options.session_file.empty()) return {};
    try {
        auto const held = find_held_session(options.session_file, std::chrono::milliseconds{0});
        return held ? held->url : std::string{};
    } catch (Trouble const&) {
        return {};
    }
}

// Rejects options about a session if the command needs no session. Environment variables are not rejected: they are set for other
// commands, and a stop for everything must not fail because of them.
void check_without_session(CLI::App const& app, Options const& options) {
    if (!needs_no_session(options)) return;
    std::vector<std::string> without_effect{"--session", "--http", "--record"};
    if (options.command == "engines" || options.command == "health")
        without_effect.emplace_back("--session-file");  // stop-all and clear find the gateway with it
    for (auto const& name : without_effect)
        if (app.get_option(name)->count() > 0)
            throw Trouble{Exit::usage, options.command + " needs no session: " + name + " has no effect here; remove it"};
}

// Takes options that are not on the command line from variables. Unlike CLI11's envname, this does not change the counts of the
// options.
void read_variables(Options& options) {
    auto const read = [](char const* variable, std::string& value) {
        if (auto const* const found = std::getenv(variable); found != nullptr && value.empty()) value = found;
    };
    read("ROIS_URL", options.url);
    read("ROIS_SESSION", options.session);
    read("ROIS_SESSION_FILE", options.session_file);
}

// Rejects empty values: they come from an unset shell variable, and the default would be another engine or session. Allows an
// empty --token, which overrides ROIS_TOKEN, and empty words.
void check_empty(CLI::App const& app) {
    for (auto const* const option : app.get_options()) {
        bool const may_be =
            option->get_single_name() == "token" || (option->get_positional() && option->get_items_expected_max() > 1);
        if (may_be || option->count() == 0 || std::ranges::find(option->results(), "") == option->results().end()) continue;
        throw Trouble{Exit::usage, option->get_name() + ": the value is empty; leave the option out for its default"};
    }
}

void check(Options const& options, Raw const& raw) {
    if (!options.where.empty() && !raw.condition.empty())
        throw Trouble{Exit::usage, "the condition is given twice: use either the argument or --where"};
    if (!options.condition_file.empty() && !raw.condition.empty())
        throw Trouble{Exit::usage, "the condition is given twice: use either the argument or --condition"};
    if (options.command == "release" && options.session.empty())
        throw Trouble{Exit::usage,
                      "release needs a session: --session (ROIS_SESSION) with the id that rois bind prints, or --session-file "
                      "(ROIS_SESSION_FILE)"};
    if (options.command == "release" && options.words.empty() && options.session_file.empty())
        throw Trouble{Exit::usage, "release needs components; only with --session-file may REF be left out"};
    if (!options.wait && options.session.empty())
        throw Trouble{Exit::usage, "--no-wait: without --session the command would end with the program"};
    if (options.take_over && (!options.where.empty() || !options.condition_file.empty()))
        throw Trouble{Exit::usage, "bind: --take-over needs the names of components, not a condition"};
    if (options.command == "bind" && options.words.empty() && options.where.empty() && options.condition_file.empty())
        throw Trouble{Exit::usage, "bind needs components: give REF or --where CONDITION"};
    bool const unasked = options.command == "replay" || needs_no_session(options) || options.check;  // these open no session
    if (has_own_session(options) && !unasked && !(options.session.empty() && options.session_file.empty()))
        throw Trouble{
            Exit::usage,
            options.command + " has a session of its own: --session, --session-file and their variables must not be set"};
    if (options.command == "record" && !options.record.empty())
        throw Trouble{Exit::usage, "record: FILE and --record name two files; leave out --record"};
    bool const others = options.command == "record" && !options.listen.empty();
    if (others && (!options.words.empty() || !options.starts.empty() || options.span || options.count))
        throw Trouble{Exit::usage,
                      "record --listen takes no EVENT, --start, --for or --count: it records all documents of the applications"};
    if (!options.record.empty() && (!options.session.empty() || options.command == "replay"))
        throw Trouble{Exit::usage, "--record: this command opens no session to record"};
}

}  // namespace

std::variant<Options, Printout> read_options(int argc, char const* const* argv) {
    CLI::App app{description, "rois"};
    Options options;
    Raw raw;
    Grammar const grammar{app, options, raw};
    try {
        app.parse(argc, argv);
    } catch (CLI::CallForHelp const&) {
        return Printout{app.help()};
    } catch (CLI::CallForAllHelp const&) {
        return Printout{app.help("", CLI::AppFormatMode::All)};
    } catch (CLI::ParseError const& error) {
        throw Trouble{Exit::usage, complaint(app, error)};
    }
    if (raw.version) return Printout{"rois " ROIS_VERSION "\n"};
    if (options.command.empty()) throw Trouble{Exit::usage, "a command is missing; see rois --help"};
    check_empty(app);
    check_empty(*app.get_subcommand(options.command));
    options.deadline = milliseconds_of(raw.timeout);
    options.deadline_is_given = app.get_option("--timeout")->count() > 0;
    if (options.command == "replay" && !options.url.empty())
        throw Trouble{Exit::usage, "replay serves a recording and needs no gateway: leave out --url"};
    check_without_session(app, options);
    read_variables(options);
    options.url_is_given = !options.url.empty();
    join_held_session(options);
    if (options.url.empty()) options.url = url_of_held_session(options);
    if (options.url.empty()) options.url = needs_no_session(options) ? url_beside_gateway() : default_url();
    if (raw.xml) options.form = Form::xml;
    if (raw.json) options.form = Form::json;
    options.wait = !raw.no_wait;
    if (has(app, options.command, "--for")) options.span = milliseconds_of(raw.span);
    if (has(app, options.command, "--count")) options.count = raw.count;
    check(options, raw);
    if (!raw.condition.empty()) options.where = joined(raw.condition);
    if (options.command == "record") options.record = options.file;
    return options;
}

void join(Options& options, HeldSession const& held) {
    options.session = held.session;
    options.held = held;
    if (!options.url_is_given) options.url = held.url;
    if (!is_same_gateway(options.url, held.url))
        throw Trouble{Exit::usage, "--session-file " + rois::quoted(options.session_file) + ": the session of this file is at " +
                                       held.url + ", not at " + options.url + " (--url or ROIS_URL)"};
}

bool runs_in_background(Options const& options) { return options.command == "bind" && !options.session_file.empty(); }

}  // namespace rois::command
