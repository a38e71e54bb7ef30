#include "conformance/report.hpp"

#include <algorithm>
#include <pugixml.hpp>

#include "types/text/texts.hpp"
#include "xml/codec/characters.hpp"

namespace rois::conformance {

namespace {

constexpr std::size_t longest_text = 1'000;  // bytes of a message; answers such as a whole profile are cut

constexpr std::string_view replacement = "\uFFFD";

// Appends valid XML characters. Replaces line breaks and tabs by spaces, and control characters of terminals by U+FFFD.
void append_shown(std::string& clean, std::string_view text) {
    while (!text.empty()) {
        auto const rest = text;
        auto const character = *take_character(text);
        if (character == U'\n' || character == U'\r' || character == U'\t') {
            clean += ' ';
        } else if (character >= 0x7F && character <= 0x9F) {
            clean += replacement;
        } else {
            clean.append(rest.substr(0, rest.size() - text.size()));
        }
    }
}

std::string shortened(std::string const& text) {
    return text.size() <= longest_text ? text : text.substr(0, longest_text) + " ...";
}

// All text output goes through this function: each entry is one line, whatever a gateway has answered.
void write_line(std::ostream& out, std::string const& line) { out << readable(line) << "\n"; }

// All texts of the XML document go through this function.
void add_attribute(pugi::xml_node element, char const* name, std::string const& text) {
    element.append_attribute(name) = readable(text).c_str();
}

char const* word(Outcome outcome) {
    switch (outcome) {
        case Outcome::holds:
            return "holds          ";
        case Outcome::broken:
            return "BROKEN         ";
        case Outcome::skipped:
            return "not played     ";
        case Outcome::not_observable:
            return "not observable ";
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
    add_attribute(test, "name", titled(finding));
    add_attribute(test, "classname", chapter.title + " (" + finding.proves + ")");
    test.append_attribute("time") = finding.seconds;
    if (finding.outcome == Outcome::holds) return;
    add_attribute(test.append_child(finding.outcome == Outcome::broken ? "failure" : "skipped"), "message",
                  (finding.outcome == Outcome::not_observable ? "not observable: " : "") + shortened(finding.text));
}

}  // namespace

std::size_t Report::count(Outcome outcome) const {
    std::size_t all = 0;
    for (auto const& chapter : chapters) all += count_in(chapter, outcome);
    return all;
}

std::string readable(std::string_view text) {
    std::string clean;
    while (auto const bad = xml::first_bad_character(text)) {
        append_shown(clean, text.substr(0, bad->offset));
        clean += replacement;
        text.remove_prefix(bad->offset + bad->length);
    }
    append_shown(clean, text);
    return clean;
}

void write_text(std::ostream& out, Report const& report) {
    write_line(out, report.gateway);
    for (auto const& chapter : report.chapters) {
        out << "\n";
        write_line(out, chapter.title);
        for (auto const& finding : chapter.findings) {
            write_line(out, "  " + std::string{word(finding.outcome)} + titled(finding) + " (" + finding.proves + ")");
            if (finding.outcome != Outcome::holds) write_line(out, "                 " + shortened(finding.text));
        }
    }
    out << "\n";
    write_line(out, number(report.count(Outcome::holds), "check") + " held, " + std::to_string(report.count(Outcome::broken)) +
                        " found a broken rule, " + std::to_string(report.count(Outcome::skipped)) + " not played, " +
                        std::to_string(report.count(Outcome::not_observable)) + " not observable.");
}

void write_junit(std::ostream& out, Report const& report) {
    pugi::xml_document document;
    auto suites = document.append_child("testsuites");
    add_attribute(suites, "name", report.gateway);
    for (auto const& chapter : report.chapters) {
        auto suite = suites.append_child("testsuite");
        add_attribute(suite, "name", chapter.title);
        suite.append_attribute("tests") = chapter.findings.size();
        suite.append_attribute("failures") = count_in(chapter, Outcome::broken);
        suite.append_attribute("skipped") = count_in(chapter, Outcome::skipped) + count_in(chapter, Outcome::not_observable);
        for (auto const& finding : chapter.findings) add_case(suite, chapter, finding);
    }
    document.save(out, "  ");
}

void write_junit_error(std::ostream& out, std::string const& gateway, std::string const& why) {
    pugi::xml_document document;
    auto suites = document.append_child("testsuites");
    add_attribute(suites, "name", gateway);
    auto suite = suites.append_child("testsuite");
    add_attribute(suite, "name", "rois-conformance");
    suite.append_attribute("tests") = 1;
    suite.append_attribute("errors") = 1;
    auto test = suite.append_child("testcase");
    add_attribute(test, "name", "the_gateway_can_be_checked");
    add_attribute(test, "classname", "rois-conformance");
    add_attribute(test.append_child("error"), "message", shortened(why));
    document.save(out, "  ");
}

}  // namespace rois::conformance
