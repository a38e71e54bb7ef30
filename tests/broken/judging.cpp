#include "broken/judging.hpp"

#include <signal.h>

#include <algorithm>
#include <ostream>
#include <sstream>

namespace rois::broken {

namespace {

std::vector<std::string> with_usual(std::vector<std::string> settings) {
    std::vector<std::string> const usual{"--sim-speed", "20", "--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml",
                                         "--seed",      "1",  "--media",    "127.0.0.1:0"};
    for (std::size_t i = 0; i < usual.size(); i += 2)
        if (std::ranges::find(settings, usual[i]) == settings.end()) settings.insert(settings.end(), {usual[i], usual[i + 1]});
    return settings;
}

std::set<std::string> marked_in(std::string const& report, std::string const& word) {
    auto const mark = "\n  " + word;
    std::set<std::string> names;
    for (auto at = report.find(mark); at != std::string::npos; at = report.find(mark, at + 1)) {
        auto const begin = at + mark.size();
        names.insert(report.substr(begin, report.find(' ', begin) - begin));
    }
    return names;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, Judged const& judged) {
    if (broken_in(judged.text).empty()) return out << judged.text;
    std::istringstream lines{judged.text};
    bool is_broken = false;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("     ")) is_broken = line.starts_with("  BROKEN ");  // else: the reason
        if (is_broken) out << line << '\n';
    }
    return out;
}

Judged judge(std::string const& arguments) {
    auto const ended = kit::run_shell(ROIS_BINARY_DIR "/bin/rois-conformance " + arguments + " 2>&1");
    return {ended.exit_code, ended.out};
}

std::set<std::string> broken_in(std::string const& report) { return marked_in(report, "BROKEN         "); }

std::set<std::string> held_in(std::string const& report) { return marked_in(report, "holds          "); }

EmptyHall::EmptyHall(std::vector<std::string> const& settings) : GatewayProcess{with_usual(settings)} {}

Team::Team() : main_{{"--robots", "none", "--engines", engines(), "--sim-speed", "20"}} {
    main_.log_with("robot1: present with");
    main_.log_with("robot2: present with");
}

Team::~Team() {
    robot1_.signal(SIGCONT);
    robot2_.signal(SIGCONT);
}

std::string Team::engines() const {
    auto const robot = [](std::string const& name, EmptyHall const& of) {
        return R"({"name": ")" + name + R"(", "url": ")" + url(of.port()) + R"("})";
    };
    folder_.put("engines.json", R"({"engines": [)" + robot("robot1", robot1_) + ", " + robot("robot2", robot2_) +
                                    R"(], "choosing": {"logical": ["navigation", "speech_synthesis", "reaction"],
                                                       "sensing": ["person_detection"], "engines": ["robot1", "robot2"]}})");
    return folder_.name() + "/engines.json";
}

std::string Team::disturbance() const {
    auto const file = folder_.name() + "/disturb.sh";
    folder_.put("disturb.sh", "case $COMPONENT in robot1.*) robot=" + std::to_string(robot1_.id()) + ";; *) robot=" +
                                  std::to_string(robot2_.id()) + ";; esac\nkill -STOP $robot && sleep 6 && kill -CONT $robot\n");
    return "'sh " + file + "'";
}

std::string url(std::uint16_t port) { return "http://127.0.0.1:" + std::to_string(port); }

}  // namespace rois::broken
