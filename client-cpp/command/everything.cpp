// Stop for everything, and its end: `stop-all` and `clear`. They need no session.
#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "command/context.hpp"
#include "command/http.hpp"
#include "command/output/terminal.hpp"
#include "types/text/listing.hpp"
#include "xml/codec/codec.hpp"

namespace rois::command {

namespace {

// Waits until all components have confirmed that they stand still, for a second at most. Returns the refs of those that have not.
std::vector<std::string> not_confirmed_soon(HttpServer const& server, std::vector<std::string> refs,
                                            std::chrono::milliseconds deadline) {
    auto const end = std::chrono::steady_clock::now() + std::min<std::chrono::milliseconds>(deadline, std::chrono::seconds{1});
    while (!refs.empty() && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
        refs = not_confirmed(http_get(server, "/readyz", deadline).body);
    }
    return refs;
}

StopState posted(Options const& options, HttpServer const& server, std::string const& target) {
    auto const answer = http_post(server, target, options.deadline);
    auto state = answer.status == 200 ? xml::AnswerReader{}.read_stop_state(answer.body) : std::nullopt;
    if (state) {
        for (auto& ref : state->not_halted) ref = harmless(ref);
        return *std::move(state);
    }
    throw unexpected(options.command, server, answer);
}

}  // namespace

std::vector<std::string> not_confirmed(std::string_view readiness) {
    constexpr std::string_view mark = " has not confirmed that it stands still";
    std::vector<std::string> refs;
    while (!readiness.empty()) {
        auto const line = readiness.substr(0, readiness.find('\n'));
        if (line.ends_with(mark)) refs.push_back(harmless(line.substr(0, line.size() - mark.size())));
        readiness.remove_prefix(std::min(readiness.size(), line.size() + 1));
    }
    return refs;
}

void stop_all(Options const& options, Printer& printer) {
    auto const server = server_of(options);
    auto const state = posted(options, server, "/rois/stop");
    auto const refs = [&] {
        try {
            return not_confirmed_soon(server, state.not_halted, options.deadline);
        } catch (Trouble const& trouble) {
            throw Trouble{trouble.exit(),
                          std::string{"stopped everything; whether all components stand still is not known: "} + trouble.what()};
        }
    }();
    printer.line(painted("stopped everything", Colour::bad, printer.coloured()) + " at " + options.url +
                     "; nothing starts until: rois clear",
                 "stop_all", Json{{"operation", "stop_all"}, {"url", options.url}, {"stopped", true}, {"not_confirmed", refs}});
    if (!refs.empty())
        throw Trouble{Exit::timeout, "these components have not confirmed that they stand still: " + listed(refs) +
                                         "; the gateway repeats their halt"};
}

void clear(Options const& options, Printer& printer) {
    posted(options, server_of(options), "/rois/clear");
    printer.line(painted("cleared", Colour::good, printer.coloured()) + ": commands may start again at " + options.url, "clear",
                 Json{{"operation", "clear"}, {"url", options.url}, {"stopped", false}});
}

}  // namespace rois::command
