#include "conformance/play.hpp"

#include <chrono>

#include "conformance/check.hpp"
#include "conformance/stage.hpp"
#include "kit/line.hpp"

namespace rois::conformance {

namespace {

using Clock = std::chrono::steady_clock;

std::string name_of(Way way) { return way == Way::http ? "HTTP" : "WebSocket"; }

Catalogue catalogue_of(kit::Address const& address) {
    kit::HttpClient client{address};
    auto const connected = client.call("connect");
    if (connected.return_code() != "OK") throw kit::LineEnded{"it opens no session: " + connected.body};
    auto const profile = client.call("get_profile");
    if (profile.return_code() != "OK") throw kit::LineEnded{"it tells no profile: " + profile.body};
    return Catalogue::read(Document{profile.body});
}

void judge(Finding& finding, Check const& check, Stage& stage) {
    auto const began = Clock::now();
    auto const found = [&](Outcome outcome, std::string const& text) {
        finding.outcome = outcome;
        finding.text = text;
    };
    try {
        check.play(stage);
    } catch (NotPlayed const& reason) {
        found(Outcome::not_played, reason.what());
    } catch (NotObservable const& reason) {
        found(Outcome::not_observable, reason.what());
    } catch (std::exception const& reason) {  // Broken, LineEnded, or a document that is none
        found(Outcome::broken, reason.what());
    } catch (...) {
        found(Outcome::broken, "an unknown exception was thrown");
    }
    finding.seconds = std::chrono::duration<double>(Clock::now() - began).count();
}

bool is_asked_for(Order const& order, Check const& check, Way way) {
    return check.name.find(order.only) != std::string::npos && check.only_over.value_or(way) == way;
}

Chapter standing_rules(Traffic const& traffic) {
    Chapter chapter{"All messages of all checks", {}};
    for (auto const& rule : traffic.rules()) {
        Finding finding{rule.name, rule.proves, ""};
        if (!rule.objection.empty()) {
            finding.outcome = Outcome::broken;
            finding.text = rule.objection;
        } else if (rule.seen == 0) {
            finding.outcome = Outcome::not_played;
            finding.text = "there was no occasion to see it";
        }
        chapter.findings.push_back(std::move(finding));
    }
    return chapter;
}

}  // namespace

bool is_any_asked_for(Order const& order) {
    for (auto const& clause : all_clauses())
        for (auto const& check : clause.checks)
            for (auto const way : order.ways)
                if (is_asked_for(order, check, way)) return true;
    return false;
}

Report play(Order const& order) {
    auto const catalogue = catalogue_of(order.address);
    auto const end = Clock::now() + order.limit;
    Traffic traffic;
    Report report{order.url + ": engine " + catalogue.engine + ", " + std::to_string(catalogue.components.size()) + " components",
                  {}};
    for (auto const& clause : all_clauses()) {
        Chapter chapter{clause.title, {}};
        for (auto const& check : clause.checks) {
            for (auto const way : order.ways) {
                if (!is_asked_for(order, check, way)) continue;
                Finding finding{check.name, check.proves, name_of(way)};
                if (Clock::now() < end) {
                    Stage stage{order.address, way, catalogue, traffic, order.room};
                    judge(finding, check, stage);
                } else {
                    finding.outcome = Outcome::not_played;
                    finding.text = "the time for all checks was over";
                }
                chapter.findings.push_back(std::move(finding));
            }
        }
        if (!chapter.findings.empty()) report.chapters.push_back(std::move(chapter));
    }
    report.chapters.push_back(standing_rules(traffic));
    if (Clock::now() >= end)
        report.chapters.back().findings.push_back({"all_is_played_in_time", "--limit", "", Outcome::broken,
                                                   "some checks were not played, because others took so long"});
    return report;
}

}  // namespace rois::conformance
