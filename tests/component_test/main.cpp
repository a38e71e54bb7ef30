// rois-component-test: whether a component program does what docs/component-programs.md asks, judged by its own profile.
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

constexpr int all_hold = 0, a_rule_is_broken = 1, bad_usage = 2;

constexpr auto usage =
    "Usage: rois-component-test [OPTION...] PROGRAM [ARGUMENT...]\n"
    "Starts the component program, and plays its engine. The program finds the engine by the variable ROIS_URL, and joins by "
    "the\n"
    "name in ROIS_NAME. Its components are started and stopped.\n\n"
    "  --only TEXT          joining, and checks whose name has TEXT within\n"
    "  --report FILE        write the report as JUnit XML, too\n"
    "  --patience SECONDS   longest wait for an answer or the end of a command [10]\n\n"
    "Exit codes: 0 all rules hold, 1 a rule is broken, 2 bad usage\n";

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
        if (i + 1 == arguments.size()) throw BadUsage{name + " needs a value"};
        auto const& value = arguments[++i];
        if (name == "--report") {
            line.report = value;
        } else if (name == "--only") {
            line.only = value;
        } else if (name == "--patience") {
            int seconds = 0;
            auto const [end, error] = std::from_chars(value.data(), value.data() + value.size(), seconds);
            if (error != std::errc{} || end != value.data() + value.size() || seconds < 1 || seconds > 3'600)
                throw BadUsage{"--patience must be a whole number from 1 to 3600, not " + value};
            line.patience = std::chrono::seconds{seconds};
        } else {
            throw BadUsage{"there is no option " + name};
        }
    }
    throw BadUsage{"the program is missing"};
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
        for (auto const& check : joining.checks) play(of_joining, check);
        // Without a profile nothing else can be judged.
        for (auto const& component : std::vector{program_.components()}) play(checks_of(component));
        if (!program_.components().empty()) play(link_checks());
        play(ending_checks());
        return report_;
    }

private:
    conformance::Chapter& chapter(std::string const& title) {
        return report_.chapters.emplace_back(conformance::Chapter{title, {}});
    }

    void play(Group const& group) {
        auto& of_group = chapter(group.title);
        for (auto const& check : group.checks)
            if (check.name.find(only_) != check.name.npos) play(of_group, check);
    }

    void play(conformance::Chapter& of_group, Check const& check) {
        conformance::Finding finding{.name = check.name, .proves = "docs/component-programs.md", .over = ""};
        auto const begun = Clock::now();
        try {
            check.play(program_);
        } catch (conformance::NotPlayed const& why) {
            finding.outcome = Outcome::not_played;
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
        if (!file.flush()) throw BadUsage{"the report cannot be written to " + line.report};
    }
    return report.count(Outcome::broken) == 0 ? all_hold : a_rule_is_broken;
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
            return all_hold;
        }
        return judge(read_command_line(words));
    } catch (BadUsage const& bad) {
        std::cerr << "rois-component-test: " << bad.what() << "\n\n" << usage;
    } catch (std::exception const& reason) {
        std::cerr << "rois-component-test: " << reason.what() << "\n";
    }
    return bad_usage;
}
