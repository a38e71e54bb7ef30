// rois-conformance: whether a gateway keeps the rules that can be seen from outside.
#include <charconv>
#include <fstream>
#include <iostream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "conformance/play.hpp"
#include "kit/line.hpp"
#include "types/text/texts.hpp"
#include "xml/validation/schemas.hpp"

namespace {

using rois::conformance::Order;
using rois::conformance::Outcome;
using rois::conformance::readable;

constexpr int all_hold = 0, a_rule_is_broken = 1, no_answer = 2;

constexpr auto usage =
    "Usage: rois-conformance URL [OPTION...]\n"
    "Plays every rule of RoIS that can be seen from outside against the gateway at URL (http://HOST:PORT), and reports.\n"
    "It starts every component that no other application uses, and makes robots speak, gesture and move; see --room.\n\n"
    "  --report FILE        write the report as JUnit XML, too\n"
    "  --over http          over HTTP only; or websocket\n"
    "  --only TEXT          only checks whose name has TEXT within\n"
    "  --token TOKEN        the bearer token that the gateway asks for\n"
    "  --patience SECONDS   how long one thing is waited for [10]\n"
    "  --room MILLIMETRES   how far a robot may move from where it stands; 0: not at all [300]\n"
    "  --limit SECONDS      how long all may take [600]\n\n"
    "Exit codes: 0 all rules hold, 1 a rule is broken, 2 bad usage or no gateway there\n";

class BadUsage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

unsigned whole_number(std::string_view name, std::string_view text, unsigned most, unsigned least = 1) {
    unsigned number = 0;
    auto const read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || number < least || number > most)
        throw BadUsage{std::string{name} + " must be a whole number from " + std::to_string(least) + " to " +
                       std::to_string(most) + ", not " + std::string{text}};
    return number;
}

// http://HOST[:PORT][/], HOST also [::1].
void read_url(Order& order, std::string_view url) {
    constexpr std::string_view scheme = "http://";
    order.url = url;
    if (!rois::equal_ignoring_case(url.substr(0, scheme.size()), scheme))
        throw BadUsage{"the URL must begin with http://, and is " + order.url};
    url.remove_prefix(scheme.size());
    if (url.ends_with('/')) url.remove_suffix(1);
    order.address.authority = url;
    auto const colon = url.rfind(':');
    bool const has_port = colon != url.npos && url.find(']', colon) == url.npos;
    auto host = url.substr(0, has_port ? colon : url.size());
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    if (host.empty() || host.find('/') != host.npos) throw BadUsage{"the URL must be http://HOST:PORT, and is " + order.url};
    order.address.host = host;
    order.address.port = static_cast<std::uint16_t>(has_port ? whole_number("the port", url.substr(colon + 1), 65'535) : 80);
}

struct CommandLine {
    Order order;
    std::string report;
};

std::optional<CommandLine> read_command_line(std::span<char* const> arguments) {
    CommandLine line;
    line.order.address.patience = std::chrono::seconds{10};
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        std::string const name = arguments[i];
        if (name == "--help" || name == "-h") return {};
        if (!name.starts_with('-')) {
            if (!line.order.url.empty()) throw BadUsage{"there is one URL, not also " + name};
            read_url(line.order, name);
            continue;
        }
        if (++i == arguments.size()) throw BadUsage{name + " needs a value"};
        std::string const value = arguments[i];
        if (name == "--report") {
            line.report = value;
        } else if (name == "--over") {
            if (value != "http" && value != "websocket") throw BadUsage{"--over takes http or websocket, not " + value};
            line.order.ways = {value == "http" ? rois::kit::Way::http : rois::kit::Way::websocket};
        } else if (name == "--only") {
            line.order.only = value;
        } else if (name == "--token") {
            line.order.address.token = value;
        } else if (name == "--patience") {
            line.order.address.patience = std::chrono::seconds{whole_number(name, value, 3'600)};
        } else if (name == "--room") {
            line.order.room = whole_number(name, value, 10'000, 0);
        } else if (name == "--limit") {
            line.order.limit = std::chrono::seconds{whole_number(name, value, 86'400)};
        } else {
            throw BadUsage{"there is no option " + name};
        }
    }
    if (line.order.url.empty()) throw BadUsage{"the URL of the gateway is missing"};
    return line;
}

// Nothing when no file is asked for.
template <class Write>
void write_file(std::string const& name, Write const& write) {
    if (name.empty()) return;
    std::ofstream file{name};
    write(file);
    if (!file.flush()) throw std::runtime_error{"the report cannot be written to " + name};
}

int play(CommandLine const& line) {
    if (!is_any_asked_for(line.order)) throw std::runtime_error{"no check has \"" + line.order.only + "\" in its name (--only)"};
    // Told before anything is played; what an older report says is left until then.
    if (!line.report.empty() && !std::ofstream{line.report, std::ios::app})
        throw std::runtime_error{"the report cannot be written to " + line.report};
    rois::conformance::Report report;
    try {
        report = rois::conformance::play(line.order);
    } catch (std::exception const& reason) {  // LineEnded, or a document that is none
        auto const why = std::string{"the gateway does not answer: "} + reason.what();
        write_file(line.report, [&](std::ostream& file) { rois::conformance::write_junit_error(file, line.order.url, why); });
        throw std::runtime_error{why};
    }
    write_text(std::cout, report);
    write_file(line.report, [&](std::ostream& file) { write_junit(file, report); });
    return report.count(Outcome::broken) == 0 ? all_hold : a_rule_is_broken;
}

}  // namespace

int main(int count, char** arguments) {
    rois::xml::Platform const platform;
    try {
        auto const line = read_command_line({arguments, static_cast<std::size_t>(count)});
        if (line) return play(*line);
        std::cout << usage;
        return all_hold;
    } catch (BadUsage const& bad) {
        std::cerr << "rois-conformance: " << readable(bad.what()) << "\n\n" << usage;
    } catch (std::exception const& reason) {
        std::cerr << "rois-conformance: " << readable(reason.what()) << "\n";
    }
    return no_answer;
}
