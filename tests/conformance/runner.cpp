#include "conformance/runner.hpp"

#include <chrono>

#include "conformance/check.hpp"
#include "conformance/context.hpp"
#include "kit/line.hpp"

namespace rois::conformance {

namespace {

using Clock = std::chrono::steady_clock;

std::string name_of(Transport transport) { return transport == Transport::http ? "HTTP" : "WebSocket"; }

Catalogue catalogue_of(kit::Address const& address) {
    kit::HttpClient client{address};
    auto const connected = client.call("connect");
    if (connected.return_code() != "OK") throw kit::LineEnded{"connect failed: expected return_code OK, got " + connected.body};
    auto const profile = client.call("get_profile");
    if (profile.return_code() != "OK") throw kit::LineEnded{"get_profile failed: expected return_code OK, got " + profile.body};
    return Catalogue::read(Document{profile.body});
}

void run_check(Finding& finding, Check const& check, Context& context) {
    auto const began = Clock::now();
    auto const found = [&](Outcome outcome, std::string const& text) {
        finding.outcome = outcome;
        finding.text = text;
    };
    try {
        check.run(context);
    } catch (Skipped const& reason) {
        found(Outcome::skipped, reason.what());
    } catch (NotObservable const& reason) {
        found(Outcome::not_observable, reason.what());
    } catch (std::exception const& reason) {  // Broken, LineEnded, or an answer that is not an XML document
        found(Outcome::broken, reason.what());
    } catch (...) {
        found(Outcome::broken, "unknown exception");
    }
    finding.seconds = std::chrono::duration<double>(Clock::now() - began).count();
}

bool matches(RunOptions const& options, Check const& check, Transport transport) {
    return check.name.find(options.only) != std::string::npos && check.only_over.value_or(transport) == transport;
}

Chapter message_rules(Traffic const& traffic) {
    Chapter chapter{"All messages of all checks", {}};
    for (auto const& rule : traffic.rules()) {
        Finding finding{rule.name, rule.proves, ""};
        if (!rule.violation.empty()) {
            finding.outcome = Outcome::broken;
            finding.text = rule.violation;
        } else if (rule.occasions == 0) {
            finding.outcome = Outcome::skipped;
            finding.text = "no message to which this rule applies";
        }
        chapter.findings.push_back(std::move(finding));
    }
    return chapter;
}

}  // namespace

bool has_matching_check(RunOptions const& options) {
    for (auto const& clause : all_clauses())
        for (auto const& check : clause.checks)
            for (auto const transport : options.transports)
                if (matches(options, check, transport)) return true;
    return false;
}

Report run_checks(RunOptions const& options) {
    auto const catalogue = catalogue_of(options.address);
    auto const end = Clock::now() + options.limit;
    Traffic traffic;
    Report report{
        options.url + ": engine " + catalogue.engine + ", " + std::to_string(catalogue.components.size()) + " components", {}};
    for (auto const& clause : all_clauses()) {
        Chapter chapter{clause.title, {}};
        for (auto const& check : clause.checks) {
            for (auto const transport : options.transports) {
                if (!matches(options, check, transport)) continue;
                Finding finding{check.name, check.proves, name_of(transport)};
                if (Clock::now() < end) {
                    Context context{options.address, transport, catalogue, traffic, options.room, options.disturbance};
                    run_check(finding, check, context);
                } else {
                    finding.outcome = Outcome::skipped;
                    finding.text = "the time limit for all checks is exceeded (--limit)";
                }
                chapter.findings.push_back(std::move(finding));
            }
        }
        if (!chapter.findings.empty()) report.chapters.push_back(std::move(chapter));
    }
    report.chapters.push_back(message_rules(traffic));
    if (Clock::now() >= end)
        report.chapters.back().findings.push_back({"all_checks_run_within_the_limit", "--limit", "", Outcome::broken,
                                                   "some checks were skipped: the time limit for all checks is exceeded"});
    return report;
}

}  // namespace rois::conformance
