#include "command/session/caller.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <vector>

namespace rois::command {

namespace {

struct Seen {
    char state;
    std::string born;  // in ticks since the machine was started
};

// Reads /proc/PID/stat (proc(5)). The process name may contain any character; no later field contains a parenthesis.
std::optional<Seen> look_at(pid_t process) {
    std::ifstream file{"/proc/" + std::to_string(process) + "/stat"};
    std::string line;
    if (!std::getline(file, line)) return std::nullopt;
    std::istringstream rest{line.substr(line.rfind(')') + 1)};
    std::vector<std::string> fields;
    for (std::string field; rest >> field;) fields.push_back(field);
    constexpr std::size_t born = 19;  // starttime, field 22 of proc(5)
    if (fields.size() <= born) return std::nullopt;
    return Seen{fields.front().front(), fields[born]};
}

}  // namespace

Caller::Caller() : process_{getppid()} {
    if (auto const seen = look_at(process_)) born_ = seen->born;
}

bool Caller::is_alive() const {
    auto const seen = look_at(process_);
    constexpr std::string_view not_running{"TtZXx"};
    return seen && seen->born == born_ && not_running.find(seen->state) == not_running.npos;
}

}  // namespace rois::command
