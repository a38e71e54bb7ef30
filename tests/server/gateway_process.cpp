#include "server/gateway_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

namespace rois::test {

namespace {

constexpr auto program = ROIS_BINARY_DIR "/bin/rois-gateway";

struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe() {
        if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error{"no pipe"};
    }
};

pid_t start(std::vector<std::string> const& arguments, Variables const& variables, int out, int error) {
    std::vector<char*> argv{const_cast<char*>(program)};
    for (auto const& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    auto const process = fork();
    if (process < 0) throw std::runtime_error{"cannot fork"};
    if (process > 0) return process;
    for (auto const& [name, value] : variables) setenv(name.c_str(), value.c_str(), 1);
    if (out >= 0) dup2(out, STDOUT_FILENO);
    dup2(error, STDERR_FILENO);
    execv(program, argv.data());
    _exit(127);
}

// Appends what comes; false at the end.
bool read_some(int from, std::string& text) {
    std::array<char, 4096> buffer;
    auto const size = read(from, buffer.data(), buffer.size());
    if (size <= 0) return false;
    text.append(buffer.data(), static_cast<std::size_t>(size));
    return true;
}

std::string read_all(int from) {
    std::string text;
    while (read_some(from, text)) {
    }
    close(from);
    return text;
}

int exit_code(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

Ended run_gateway(std::vector<std::string> const& arguments, Variables const& variables) {
    Pipe out, error;
    auto const process = start(arguments, variables, out.ends[1], error.ends[1]);
    close(out.ends[1]);
    close(error.ends[1]);
    Ended ended;
    ended.error = read_all(error.ends[0]);  // a line or two, never as much as a pipe holds
    ended.out = read_all(out.ends[0]);
    ended.exit_code = exit_code(process);
    return ended;
}

GatewayProcess::GatewayProcess(std::vector<std::string> arguments, Variables const& variables) {
    if (std::ranges::find(arguments, "--listen") == arguments.end()) {
        arguments.insert(arguments.end(), {"--listen", "127.0.0.1:0"});
    }
    Pipe error;
    process_ = start(arguments, variables, -1, error.ends[1]);
    close(error.ends[1]);
    errors_ = error.ends[0];
    reader_ = std::thread{[this] {
        std::string more;
        while (read_some(errors_, more)) {
            std::lock_guard const lock{mutex_};
            log_ += std::exchange(more, {});
            news_.notify_all();
        }
        std::lock_guard const lock{mutex_};
        ended_ = true;
        news_.notify_all();
    }};
    static std::string const mark = "listening on ";
    auto const listening = [&] {
        auto const at = log_.find(mark);
        return at != std::string::npos && log_.find_first_of("\"\n", at) != std::string::npos;
    };
    std::unique_lock lock{mutex_};
    news_.wait(lock, [&] { return ended_ || listening(); });
    if (!listening()) {
        lock.unlock();
        throw std::runtime_error{"the gateway does not listen: " + wait().error};
    }
    auto const begin = log_.find(mark) + mark.size();
    url_ = log_.substr(begin, log_.find_first_of("\"\n", begin) - begin);
    port_ = static_cast<std::uint16_t>(std::stoi(url_.substr(url_.rfind(':') + 1)));
}

GatewayProcess::~GatewayProcess() {
    if (process_ == 0) return;
    signal(SIGTERM);
    auto const ended = wait();
    EXPECT_EQ(ended.exit_code, 0) << ended.error;
}

std::size_t GatewayProcess::resident_bytes() const {
    std::ifstream in{"/proc/" + std::to_string(process_) + "/statm"};
    std::size_t whole = 0, resident = 0;
    in >> whole >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void GatewayProcess::limit_address_space(std::size_t more) const {
    std::ifstream in{"/proc/" + std::to_string(process_) + "/statm"};
    rlim_t whole = 0;
    in >> whole;
    rlimit const limit{whole * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + more, RLIM_INFINITY};
    EXPECT_EQ(prlimit(process_, RLIMIT_AS, &limit, nullptr), 0);
}

std::string GatewayProcess::log_with(std::string_view text) {
    std::unique_lock lock{mutex_};
    news_.wait_for(lock, std::chrono::seconds{10}, [&] { return ended_ || log_.find(text) != std::string::npos; });
    return log_;
}

void GatewayProcess::signal(int number) { kill(process_, number); }

Ended GatewayProcess::wait() {
    reader_.join();
    close(errors_);
    Ended ended;
    ended.exit_code = exit_code(process_);
    ended.error = log_;
    process_ = 0;
    return ended;
}

GatewayProcess& shared_gateway() {
    // Ended with the tests, as long as a failure counts.
    class Shared : public testing::Environment {
    public:
        void TearDown() override { gateway.reset(); }
        std::unique_ptr<GatewayProcess> gateway;
    };
    static auto* const shared = dynamic_cast<Shared*>(testing::AddGlobalTestEnvironment(new Shared));
    if (!shared->gateway) shared->gateway = std::make_unique<GatewayProcess>();
    return *shared->gateway;
}

}  // namespace rois::test
