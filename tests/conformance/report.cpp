#include "conformance/report.hpp"

#include <algorithm>
#include <pugixml.hpp>

namespace rois::conformance {

namespace {

constexpr std::size_t longest_text = 1'000;  // of a line; a whole profile says no more

std::string shortened(std::string const& text) {
    return text.size() <= longest_text ? text : text.substr(0, longest_text) + " ...";
}

char const* word(Outcome outcome) {
    switch (outcome) {
        case Outcome::holds:
            return "holds      ";
        case Outcome::broken:
            return "BROKEN     ";
        case Outcome::not_played:
            return "not played ";
    }
    return "";
}

std::string number(std::size_t count, std::string const& thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string titled(Finding const& finding) { return finding.name + (finding.over.empty() ? "" : " over " + finding.over); }

std::size_t count_in(Chapter const& chapter, Outcome outcome) {
    return static_cast<std::size_t>(std::ranges::count(chapter.findings, outcome, &Finding::outcome));
}

void add_case(pugi::xml_node suite, Chapter const& chapter, Finding const& finding) {
    auto test = suite.append_child("testcase");
    test.append_attribute("name") = titled(finding).c_str();
    test.append_attribute("classname") = (chapter.title + " (" + finding.proves + ")").c_str();
    test.append_attribute("time") = finding.seconds;
    if (finding.outcome == Outcome::holds) return;
    auto why = test.append_child(finding.outcome == Outcome::broken ? "failure" : "skipped");
    why.append_attribute("message") = shortened(finding.text).c_str();
}

}  // namespace

std::size_t Report::count(Outcome outcome) const {
    std::size_t all = 0;
    for (auto const& chapter : chapters) all += count_in(chapter, outcome);
    return all;
}

void write_text(std::ostream& out, Report const& report) {
    out << report.gateway << "\n";
    for (auto const& chapter : report.chapters) {
        out << "\n" << chapter.title << "\n";
        for (auto const& finding : chapter.findings) {
            out << "  " << word(finding.outcome) << titled(finding) << " (" << finding.proves << ")\n";
            if (finding.outcome != Outcome::holds) out << "             " << shortened(finding.text) << "\n";
        }
    }
    out << "\n"
        << number(report.count(Outcome::holds), "check") << " held, " << report.count(Outcome::broken) << " found a broken rule, "
        << report.count(Outcome::not_played) << " could not be played.\n";
}

void write_junit(std::ostream& out, Report const& report) {
    pugi::xml_document document;
    auto suites = document.append_child("testsuites");
    suites.append_attribute("name") = report.gateway.c_str();
    for (auto const& chapter : report.chapters) {
        auto suite = suites.append_child("testsuite");
        suite.append_attribute("name") = chapter.title.c_str();
        suite.append_attribute("tests") = chapter.findings.size();
        suite.append_attribute("failures") = count_in(chapter, Outcome::broken);
        suite.append_attribute("skipped") = count_in(chapter, Outcome::not_played);
        for (auto const& finding : chapter.findings) add_case(suite, chapter, finding);
    }
    document.save(out, "  ");
}

}  // namespace rois::conformance
