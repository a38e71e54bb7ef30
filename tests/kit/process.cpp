#include "kit/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>

namespace rois::kit {

namespace {

void redirect(int stream, int to) {
    if (to >= 0) dup2(to, stream);
    if (to == closed) close(stream);
}

}  // namespace

Pipe::Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error{"cannot make a pipe"};
    to_read = ends[0];
    to_write = ends[1];
}

Variables preloading(std::string const& library, Variables variables) {
    variables["LD_PRELOAD"] = library;
    variables["ASAN_OPTIONS"] = "verify_asan_link_order=0";
    return variables;
}

pid_t start(std::string const& program, std::vector<std::string> const& arguments, Variables const& variables,
            Streams const& streams) {
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (auto const& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    Pipe const failure;  // exec closes it; otherwise the child writes the reason
    auto const process = fork();
    if (process < 0) throw std::runtime_error{"cannot fork"};
    if (process > 0) {
        int reason = 0;
        close(failure.to_write);
        bool const failed = read(failure.to_read, &reason, sizeof reason) > 0;
        close(failure.to_read);
        if (!failed) return process;
        exit_code(process);
        throw std::system_error{reason, std::generic_category(), "cannot start '" + program + "'"};
    }
    for (auto const& [name, value] : variables) setenv(name.c_str(), value.c_str(), 1);
    redirect(STDIN_FILENO, streams.in);
    redirect(STDOUT_FILENO, streams.out);
    redirect(STDERR_FILENO, streams.error);
    execvp(program.c_str(), argv.data());
    auto const reason = errno;
    _exit(write(failure.to_write, &reason, sizeof reason) > 0 ? 127 : 126);
}

int exit_code(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool read_some(int from, std::string& text) {
    std::array<char, 4096> buffer;
    auto const size = read(from, buffer.data(), buffer.size());
    if (size <= 0) return false;
    text.append(buffer.data(), static_cast<std::size_t>(size));
    return true;
}

void read_both(pid_t process, int out, std::string& out_text, int error, std::string& error_text) {
    constexpr auto patience = std::chrono::seconds{100};
    auto const end = std::chrono::steady_clock::now() + patience;
    std::array<pollfd, 2> both{{{out, POLLIN, 0}, {error, POLLIN, 0}}};
    while (both[0].fd >= 0 || both[1].fd >= 0) {
        auto const left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        if (poll(both.data(), both.size(), std::max(0, static_cast<int>(left.count()))) == 0) {
            kill(process, SIGKILL);
            error_text += "killed: the program did not end within 100 s\n";
            break;
        }
        if (both[0].revents != 0 && !read_some(out, out_text)) both[0].fd = -1;
        if (both[1].revents != 0 && !read_some(error, error_text)) both[1].fd = -1;
    }
    close(out);
    close(error);
}

Ended run(std::string const& program, std::vector<std::string> const& arguments, std::string const& input,
          Variables const& variables) {
    Pipe const in, out, error;
    auto const process = start(program, arguments, variables, {in.to_read, out.to_write, error.to_write});
    for (auto const end : {in.to_read, out.to_write, error.to_write}) close(end);
    if (write(in.to_write, input.data(), input.size()) < 0) throw std::runtime_error{program + " did not read its input"};
    close(in.to_write);
    Ended ended;
    read_both(process, out.to_read, ended.out, error.to_read, ended.error);
    ended.exit_code = exit_code(process);
    return ended;
}

Ended run_shell(std::string const& command_line) { return run("/bin/sh", {"-c", command_line}); }

}  // namespace rois::kit
