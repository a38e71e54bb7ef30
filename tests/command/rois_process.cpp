#include "command/rois_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace rois::test {

namespace {

constexpr auto program = ROIS_BINARY_DIR "/bin/rois";
constexpr auto nowhere = "http://127.0.0.1:1";

struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe() {
        if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error{"no pipe"};
    }
};

pid_t start(std::vector<std::string> const& arguments, Variables const& variables, int in, int out, int error) {
    std::vector<char*> argv{const_cast<char*>(program)};
    for (auto const& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    auto const process = fork();
    if (process < 0) throw std::runtime_error{"cannot fork"};
    if (process > 0) return process;
    for (auto const* name : {"ROIS_SESSION", "ROIS_TOKEN", "ROIS_CA_FILE", "ROIS_LISTEN", "NO_COLOR"}) unsetenv(name);
    setenv("ROIS_URL", nowhere, 1);
    for (auto const& [name, value] : variables) setenv(name.c_str(), value.c_str(), 1);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(error, STDERR_FILENO);
    execv(program, argv.data());
    _exit(127);
}

bool read_some(int from, std::string& text) {
    std::array<char, 4096> buffer;
    auto const size = read(from, buffer.data(), buffer.size());
    if (size <= 0) return false;
    text.append(buffer.data(), static_cast<std::size_t>(size));
    return true;
}

// Reads until both have ended. Kills the process after a time that no test needs; the output so far helps to find the reason.
void read_both(pid_t process, int out, std::string& out_text, int error, std::string& error_text) {
    constexpr auto patience = std::chrono::seconds{100};
    auto const end = std::chrono::steady_clock::now() + patience;
    std::array<pollfd, 2> both{{{out, POLLIN, 0}, {error, POLLIN, 0}}};
    while (both[0].fd >= 0 || both[1].fd >= 0) {
        auto const left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        if (poll(both.data(), both.size(), std::max(0, static_cast<int>(left.count()))) == 0) {
            kill(process, SIGKILL);
            error_text += "killed, since it did not end by itself\n";
            break;
        }
        if (both[0].revents != 0 && !read_some(out, out_text)) both[0].fd = -1;
        if (both[1].revents != 0 && !read_some(error, error_text)) both[1].fd = -1;
    }
    close(out);
    close(error);
}

int exit_code(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
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
    Pipe in, out, error;
    auto const process = start(arguments, variables, in.ends[0], out.ends[1], error.ends[1]);
    for (auto const end : {in.ends[0], out.ends[1], error.ends[1]}) close(end);
    if (write(in.ends[1], input.data(), input.size()) < 0) ADD_FAILURE() << "the input was not read";
    close(in.ends[1]);
    Ended ended;
    read_both(process, out.ends[0], ended.out, error.ends[0], ended.error);
    ended.exit_code = exit_code(process);
    return ended;
}

RoisProcess::RoisProcess(std::vector<std::string> const& arguments, Variables const& variables) {
    Pipe out, error;
    auto const null = open("/dev/null", O_RDONLY | O_CLOEXEC);
    process_ = start(arguments, variables, null, out.ends[1], error.ends[1]);
    for (auto const end : {null, out.ends[1], error.ends[1]}) close(end);
    out_ = out.ends[0];
    error_ = error.ends[0];
}

RoisProcess::~RoisProcess() {
    if (process_ == 0) return;
    kill(process_, SIGTERM);
    wait();
}

std::string RoisProcess::line() {
    while (read_.find('\n') == std::string::npos) {
        if (read_some(out_, read_)) continue;
        std::string error;
        while (read_some(error_, error)) {
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
        if (!read_some(error_, error_read_)) throw std::runtime_error{"rois has ended: " + error_read_};
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
    read_both(process_, out_, ended.out, error_, ended.error);
    ended.exit_code = exit_code(process_);
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
