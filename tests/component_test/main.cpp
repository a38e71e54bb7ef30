// rois-component-test: checks whether a component program follows docs/component-programs.md and its own profile.
#include <charconv>
#include <chrono>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "component_test/checks.hpp"
#include "conformance/check.hpp"
#include "conformance/report.hpp"
#include "files/files.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::component_test {
namespace {

using conformance::Outcome;

constexpr int no_rule_broken = 0, rule_broken = 1, bad_usage = 2;

constexpr auto usage =
    "Usage: rois-component-test [OPTION...] PROGRAM [ARGUMENT...]\n"
    "Starts the component program, acts as its engine, and prints a report. The program must connect to the URL in ROIS_URL and\n"
    "join with the name in ROIS_NAME. The checks start and stop each component.\n\n"
    "  --only TEXT          run only joining, and checks whose name contains TEXT\n"
    "  --report FILE        also write the report to FILE as JUnit XML\n"
    "  --patience SECONDS   longest wait for an answer or the end of a command [10]\n\n"
    "Exit codes: 0 no rule is broken, 1 a rule is broken, 2 invalid option or missing program\n";

struct CommandLine {
    std::string report;
    std::string only;
    std::chrono::seconds patience{10};
    std::vector<std::string> program;
};

class BadUsage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

CommandLine read_command_line(std::vector<std::string> const& arguments) {
    CommandLine line;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        auto const& name = arguments[i];
        if (!name.starts_with("--")) {
            line.program.assign(arguments.begin() + static_cast<std::ptrdiff_t>(i), arguments.end());
            return line;
        }
        if (i + 1 == arguments.size()) throw BadUsage{"option " + name + " needs a value"};
        auto const& value = arguments[++i];
        if (name == "--report") {
            line.report = value;
        } else if (name == "--only") {
            line.only = value;
        } else if (name == "--patience") {
            int seconds = 0;
            auto const [end, error] = std::from_chars(value.data(), value.data() + value.size(), seconds);
            if (error != std::errc{} || end != value.data() + value.size() || seconds < 1 || seconds > 3'600)
                throw BadUsage{"--patience: '" + value + "' is not valid: expected a whole number from 1 to 3600"};
            line.patience = std::chrono::seconds{seconds};
        } else {
            throw BadUsage{"unknown option '" + name + "'"};
        }
    }
    throw BadUsage{"missing component program: expected PROGRAM [ARGUMENT...]"};
}

class Judge {
public:
    explicit Judge(CommandLine const& line)
        : only_{line.only}, program_{line.program, line.patience, std::make_shared<xml::Schemas const>(files::schemas())} {
        for (auto const& word : line.program) report_.gateway += (report_.gateway.empty() ? "" : " ") + word;
    }

    conformance::Report judge() {
        auto const joining = joining_checks();
        auto& of_joining = chapter(joining.title);
        for (auto const& check : joining.checks) run(of_joining, check);
        // The other checks need the components from the profile.
        for (auto const& component : std::vector{program_.components()}) run(checks_of(component));
        if (!program_.components().empty()) run(link_checks());
        run(ending_checks());
        return report_;
    }

private:
    conformance::Chapter& chapter(std::string const& title) {
        return report_.chapters.emplace_back(conformance::Chapter{title, {}});
    }

    void run(Group const& group) {
        auto& of_group = chapter(group.title);
        for (auto const& check : group.checks)
            if (check.name.find(only_) != check.name.npos) run(of_group, check);
    }

    void run(conformance::Chapter& of_group, Check const& check) {
        conformance::Finding finding{.name = check.name, .proves = "docs/component-programs.md", .over = ""};
        auto const begun = Clock::now();
        try {
            check.run(program_);
        } catch (conformance::Skipped const& why) {
            finding.outcome = Outcome::skipped;
            finding.text = why.what();
        } catch (conformance::NotObservable const& why) {
            finding.outcome = Outcome::not_observable;
            finding.text = why.what();
        } catch (std::exception const& why) {
            finding.outcome = Outcome::broken;
            finding.text = why.what();
            program_.abandon_link();
        }
        finding.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
        of_group.findings.push_back(std::move(finding));
    }

    std::string only_;
    Program program_;
    conformance::Report report_;
};

int judge(CommandLine const& line) {
    auto const report = Judge{line}.judge();
    conformance::write_text(std::cout, report);
    if (!line.report.empty()) {
        std::ofstream file{line.report};
        conformance::write_junit(file, report);
        if (!file.flush()) throw std::runtime_error{"cannot write the report to '" + line.report + "' (--report)"};
    }
    return report.count(Outcome::broken) == 0 ? no_rule_broken : rule_broken;
}

}  // namespace
}  // namespace rois::component_test

int main(int count, char** arguments) {
    using namespace rois::component_test;
    rois::xml::Platform const platform;
    try {
        std::vector<std::string> const words{arguments + 1, arguments + count};
        if (!words.empty() && (words.front() == "--help" || words.front() == "-h")) {
            std::cout << usage;
            return no_rule_broken;
        }
        return judge(read_command_line(words));
    } catch (BadUsage const& bad) {
        std::cerr << "rois-component-test: " << bad.what() << "; --help lists the options\n";
    } catch (std::exception const& reason) {
        std::cerr << "rois-component-test: " << reason.what() << "\n";
    }
    return bad_usage;
}
