#include "command/rois_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace rois::test {

namespace {

// Returns arguments for `env`, which removes the settings of the machine, sets these variables, and runs `rois`.
std::vector<std::string> for_env(std::vector<std::string> const& arguments, Variables const& variables) {
    std::vector<std::string> all;
    for (auto const* name : {"ROIS_SESSION", "ROIS_TOKEN", "ROIS_CA_FILE", "ROIS_LISTEN", "NO_COLOR"})
        all.insert(all.end(), {"-u", name});
    all.emplace_back("ROIS_URL=http://127.0.0.1:1");  // unless `variables` sets it
    for (auto const& [name, value] : variables) all.push_back(name + "=" + value);
    all.emplace_back(ROIS_BINARY_DIR "/bin/rois");
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
}

std::filesystem::path const& folder() {
    static struct Folder {
        std::filesystem::path path;
        Folder() {
            std::string name = std::filesystem::temp_directory_path() / "rois-command-XXXXXX";
            if (mkdtemp(name.data()) == nullptr) throw std::runtime_error{"no folder"};
            path = name;
        }
        ~Folder() {
            std::error_code ignored;
            std::filesystem::remove_all(path, ignored);
        }
    } const folder;
    return folder.path;
}

}  // namespace

Ended run_rois(std::vector<std::string> const& arguments, std::string const& input, Variables const& variables) {
    return kit::run("env", for_env(arguments, variables), input);
}

RoisProcess::RoisProcess(std::vector<std::string> const& arguments, Variables const& variables) {
    kit::Pipe const out, error;
    auto const null = open("/dev/null", O_RDONLY | O_CLOEXEC);
    process_ = kit::start("env", for_env(arguments, variables), {}, {null, out.to_write, error.to_write});
    for (auto const end : {null, out.to_write, error.to_write}) close(end);
    out_ = out.to_read;
    error_ = error.to_read;
}

RoisProcess::~RoisProcess() {
    if (process_ == 0) return;
    kill(process_, SIGTERM);
    wait();
}

std::string RoisProcess::line() {
    while (read_.find('\n') == std::string::npos) {
        if (kit::read_some(out_, read_)) continue;
        std::string error;
        while (kit::read_some(error_, error)) {
        }
        throw std::runtime_error{"rois has ended: " + read_ + error};
    }
    auto const end = read_.find('\n');
    auto line = read_.substr(0, end);
    read_.erase(0, end + 1);
    return line;
}

std::string RoisProcess::line_with(std::string const& text) {
    auto one = line();
    while (one.find(text) == std::string::npos) one = line();
    return one;
}

std::string RoisProcess::error_line() {
    while (error_read_.find('\n') == std::string::npos)
        if (!kit::read_some(error_, error_read_)) throw std::runtime_error{"rois has ended: " + error_read_};
    auto const end = error_read_.find('\n');
    auto line = error_read_.substr(0, end);
    error_read_.erase(0, end + 1);
    return line;
}

void RoisProcess::stop_reading() { close(std::exchange(out_, -1)); }

void RoisProcess::signal(int number) { kill(process_, number); }

Ended RoisProcess::wait() {
    Ended ended;
    ended.out = std::move(read_);
    ended.error = std::move(error_read_);
    kit::read_both(process_, out_, ended.out, error_, ended.error);
    ended.exit_code = kit::exit_code(process_);
    process_ = 0;
    return ended;
}

std::string file_named(std::string const& name) { return folder() / name; }

std::string file_with(std::string const& name, std::string const& text) {
    auto const file = file_named(name);
    std::ofstream{file, std::ios::binary} << text;
    return file;
}

std::string text_of(std::string const& file) {
    std::ifstream in{file, std::ios::binary};
    EXPECT_TRUE(in.is_open()) << file;
    return {std::istreambuf_iterator<char>{in}, {}};
}

std::vector<std::string> lines_of(std::string const& text) {
    std::vector<std::string> lines;
    std::istringstream in{text};
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

}  // namespace rois::test
