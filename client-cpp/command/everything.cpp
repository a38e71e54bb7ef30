// Stop for everything, and its end: `stop-all` and `clear`. They need no session.
#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "command/context.hpp"
#include "command/http.hpp"
#include "command/terminal.hpp"
#include "types/listing.hpp"
#include "types/texts.hpp"

namespace rois::command {

namespace {

// The components that have not confirmed yet that they stand still.
std::vector<std::string> not_confirmed(std::string const& answer) {
    constexpr std::string_view mark = "not confirmed yet: ";
    std::vector<std::string> refs;
    for (std::string_view rest = answer; !rest.empty();) {
        auto const line = rest.substr(0, rest.find('\n'));
        if (line.starts_with(mark)) refs.push_back(harmless(line.substr(mark.size())));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    }
    return refs;
}

// Whether all components confirm soon, as the gateway's metrics tell.
bool confirm_soon(HttpServer const& server, std::chrono::milliseconds deadline) {
    constexpr std::string_view metric = "\nrois_components_not_halted ";
    auto const end = std::chrono::steady_clock::now() + std::min<std::chrono::milliseconds>(deadline, std::chrono::seconds{1});
    while (std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
        auto const text = http_get(server, "/metrics", deadline).body;
        auto const at = text.find(metric);
        if (at != text.npos && text.substr(at + metric.size(), 2) == "0\n") return true;
    }
    return false;
}

std::string posted(Options const& options, HttpServer const& server, std::string const& target) {
    auto const answer = http_post(server, target, options.deadline);
    if (answer.status == 200 || answer.status == 202) return answer.body;
    auto const body = harmless(trimmed(answer.body.substr(0, 200)));
    throw Trouble{Exit::fault, options.command + ": " + options.url + " answers " + std::to_string(answer.status) +
                                   (body.empty() ? "" : ": " + body) + hint_for_url(options.url)};
}

}  // namespace

void stop_all(Options const& options, Printer& printer) {
    HttpServer const server{options.url, options.token, options.ca_file};
    auto refs = not_confirmed(posted(options, server, "/rois/stop"));
    if (!refs.empty() && confirm_soon(server, options.deadline)) refs.clear();
    printer.line(painted("stopped everything", Colour::bad, printer.coloured()) + " at " + options.url +
                     "; nothing starts until: rois clear",
                 "stop_all", Json{{"operation", "stop_all"}, {"url", options.url}, {"stopped", true}, {"not_confirmed", refs}});
    if (!refs.empty())
        throw Trouble{Exit::timeout, "these components have not confirmed that they stand still: " + listed(refs) +
                                         "; the gateway repeats their halt"};
}

void clear(Options const& options, Printer& printer) {
    posted(options, {options.url, options.token, options.ca_file}, "/rois/clear");
    printer.line(painted("cleared", Colour::good, printer.coloured()) + ": commands may start again at " + options.url, "clear",
                 Json{{"operation", "clear"}, {"url", options.url}, {"stopped", false}});
}

}  // namespace rois::command
