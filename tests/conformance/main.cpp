// rois-conformance: checks from outside whether a gateway follows the rules of RoIS.
#include <charconv>
#include <fstream>
#include <iostream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "conformance/runner.hpp"
#include "kit/line.hpp"
#include "types/text/texts.hpp"
#include "xml/validation/schemas.hpp"

namespace {

using rois::conformance::Outcome;
using rois::conformance::readable;
using rois::conformance::RunOptions;

constexpr int no_rule_broken = 0, rule_broken = 1, not_checked = 2;

constexpr auto usage =
    "Usage: rois-conformance URL [OPTION...]\n"
    "Checks the gateway at URL (http://HOST:PORT, or https) from outside against the rules of RoIS, and prints a report.\n"
    "It starts every component that no other application uses. Robots speak, gesture and move: keep their surroundings free.\n\n"
    "  --report FILE        also write the report to FILE as JUnit XML\n"
    "  --over TRANSPORT     use only http or websocket [both]\n"
    "  --only TEXT          run only checks whose name contains TEXT\n"
    "  --token TOKEN        bearer token for the gateway\n"
    "  --ca-file FILE       certificates to trust instead of the system's, in PEM\n"
    "  --patience SECONDS   longest wait for one answer, notification or motion [10]\n"
    "  --room MILLIMETRES   greatest distance of a robot from its starting point; 0 forbids motion [300]\n"
    "  --disturb COMMAND    a shell command that makes the component $COMPONENT fail for some seconds: checks switching\n"
    "  --limit SECONDS      longest time for all checks [600]\n\n"
    "Exit codes: 0 no rule is broken, 1 a rule is broken, 2 invalid option or no gateway at URL\n";

class BadUsage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

unsigned whole_number(std::string_view name, std::string_view text, unsigned most, unsigned least = 1) {
    unsigned number = 0;
    auto const read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || number < least || number > most)
        throw BadUsage{std::string{name} + ": '" + std::string{text} + "' is not valid: expected a whole number from " +
                       std::to_string(least) + " to " + std::to_string(most)};
    return number;
}

// Reads http://HOST[:PORT][/], or https. HOST may be an IPv6 address in brackets.
void read_url(RunOptions& options, std::string_view url) {
    options.url = url;
    auto const begins_with = [&](std::string_view scheme) {
        bool const begins = rois::equal_ignoring_case(url.substr(0, scheme.size()), scheme);
        if (begins) url.remove_prefix(scheme.size());
        return begins;
    };
    options.address.tls = begins_with("https://");
    if (!options.address.tls && !begins_with("http://"))
        throw BadUsage{"'" + options.url + "' is not a valid URL: expected http://HOST:PORT or https://HOST:PORT"};
    if (url.ends_with('/')) url.remove_suffix(1);
    options.address.authority = url;
    auto const colon = url.rfind(':');
    bool const has_port = colon != url.npos && url.find(']', colon) == url.npos;
    auto host = url.substr(0, has_port ? colon : url.size());
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    if (host.empty() || host.find('/') != host.npos)
        throw BadUsage{"'" + options.url + "' is not a valid URL: expected http://HOST:PORT"};
    options.address.host = host;
    options.address.port = static_cast<std::uint16_t>(has_port ? whole_number("the port", url.substr(colon + 1), 65'535)
                                                      : options.address.tls ? 443
                                                                            : 80);
}

struct CommandLine {
    RunOptions options;
    std::string report;
};

std::optional<CommandLine> read_command_line(std::span<char* const> arguments) {
    CommandLine line;
    line.options.address.patience = std::chrono::seconds{10};
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        std::string const name = arguments[i];
        if (name == "--help" || name == "-h") return {};
        if (!name.starts_with('-')) {
            if (!line.options.url.empty())
                throw BadUsage{"unexpected argument '" + name + "': the URL is already " + line.options.url};
            read_url(line.options, name);
            continue;
        }
        if (++i == arguments.size()) throw BadUsage{"option " + name + " needs a value"};
        std::string const value = arguments[i];
        if (name == "--report") {
            line.report = value;
        } else if (name == "--over") {
            if (value != "http" && value != "websocket")
                throw BadUsage{"--over: '" + value + "' is not a transport: expected http or websocket"};
            line.options.transports = {value == "http" ? rois::kit::Transport::http : rois::kit::Transport::websocket};
        } else if (name == "--only") {
            line.options.only = value;
        } else if (name == "--token") {
            line.options.address.token = value;
        } else if (name == "--ca-file") {
            line.options.address.ca_file = value;
        } else if (name == "--patience") {
            line.options.address.patience = std::chrono::seconds{whole_number(name, value, 3'600)};
        } else if (name == "--room") {
            line.options.room = whole_number(name, value, 10'000, 0);
        } else if (name == "--disturb") {
            line.options.disturbance = value;
        } else if (name == "--limit") {
            line.options.limit = std::chrono::seconds{whole_number(name, value, 86'400)};
        } else {
            throw BadUsage{"unknown option '" + name + "'"};
        }
    }
    if (line.options.url.empty()) throw BadUsage{"missing URL of the gateway: expected http://HOST:PORT"};
    return line;
}

// Does nothing if `name` is empty.
template <class Write>
void write_file(std::string const& name, Write const& write) {
    if (name.empty()) return;
    std::ofstream file{name};
    write(file);
    if (!file.flush()) throw std::runtime_error{"cannot write the report to '" + name + "' (--report)"};
}

int run(CommandLine const& line) {
    if (!has_matching_check(line.options))
        throw std::runtime_error{"no check has a name that contains '" + line.options.only + "' (--only)"};
    // Opens the file before the checks run, to report an error early. Appending keeps an older report until then.
    if (!line.report.empty() && !std::ofstream{line.report, std::ios::app})
        throw std::runtime_error{"cannot write the report to '" + line.report + "' (--report)"};
    rois::conformance::Report report;
    try {
        report = rois::conformance::run_checks(line.options);
    } catch (std::exception const& reason) {  // LineEnded, or an answer that is not an XML document
        auto const why = std::string{"the gateway at " + line.options.url + " does not answer: "} + reason.what();
        write_file(line.report, [&](std::ostream& file) { rois::conformance::write_junit_error(file, line.options.url, why); });
        throw std::runtime_error{why};
    }
    write_text(std::cout, report);
    write_file(line.report, [&](std::ostream& file) { write_junit(file, report); });
    return report.count(Outcome::broken) == 0 ? no_rule_broken : rule_broken;
}

}  // namespace

int main(int count, char** arguments) {
    rois::xml::Platform const platform;
    try {
        auto const line = read_command_line({arguments, static_cast<std::size_t>(count)});
        if (line) return run(*line);
        std::cout << usage;
        return no_rule_broken;
    } catch (BadUsage const& bad) {
        std::cerr << "rois-conformance: " << readable(bad.what()) << "; --help lists the options\n";
    } catch (std::exception const& reason) {
        std::cerr << "rois-conformance: " << readable(reason.what()) << "\n";
    }
    return not_checked;
}
