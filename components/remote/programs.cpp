#include "remote/programs.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <exception>
#include <map>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "types/unique_descriptor.hpp"

namespace rois::remote {

namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using namespace std::chrono_literals;
using Descriptor = asio::posix::stream_descriptor;

constexpr int most_immediate_ends = 5;
constexpr std::size_t longest_line = 4'096;

// The arguments or the environment of a program, as execve wants them.
class Words {
public:
    explicit Words(std::vector<std::string> words) : words_{std::move(words)} {
        for (auto& word : words_) pointers_.push_back(word.data());
        pointers_.push_back(nullptr);
    }
    char* const* data() const { return pointers_.data(); }

private:
    std::vector<std::string> words_;
    std::vector<char*> pointers_;
};

// Without the settings of this gateway: the program may be a gateway, too.
Words environment(Programs::Wanted const& wanted, std::string const& token) {
    std::vector<std::string> all{"ROIS_URL=" + wanted.url, "ROIS_NAME=" + wanted.joins};
    if (!token.empty()) all.push_back("ROIS_TOKEN=" + token);
    for (auto* each = ::environ; *each != nullptr; ++each) {
        std::string_view const text{*each};
        if (!text.starts_with("ROIS_")) all.emplace_back(text);
    }
    return Words{std::move(all)};
}

// The functions that run in child processes call only functions that take no lock: other threads may have held locks at the fork.

// Starts a process that ends this group when the gateway has ended, also by SIGKILL: its input has a line if the group has ended
// before. The process is a child of init, so that the program does not see it. It runs a shell, because a copy of the gateway
// would take memory.
void start_watcher(int input) {
    std::array<char, 16> group{};
    std::to_chars(group.begin(), group.end() - 1, ::getpid());
    constexpr auto script = "read -r line || { kill -s TERM -- -$1; sleep 2; kill -s KILL -- -$1; }";
    auto const parent = ::fork();
    if (parent > 0) ::waitpid(parent, nullptr, 0);
    if (parent != 0) return;
    if (::fork() != 0) ::_exit(0);
    ::setsid();
    ::dup2(input, STDIN_FILENO);
    auto const nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
    ::execl("/bin/sh", "sh", "-c", script, "sh", group.data(), nullptr);
    ::_exit(127);
}

// Executes the program in the child process.
[[noreturn]] void become(char const* folder, char* const* command, char* const* environment, int output, int gateway) {
    ::setpgid(0, 0);  // what it starts itself ends with it
    ::signal(SIGPIPE, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::pthread_sigmask(SIG_SETMASK, &none, nullptr);  // this thread may hold signals back
    start_watcher(gateway);
    ::dup2(::open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
    ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);  // the sockets of the gateway
    if (::chdir(folder) == 0) ::execvpe(command[0], command, environment);
    auto const* const problem = ::strerrordesc_np(errno);
    for (auto const* text : {"it cannot be run: ", problem, "\n"})
        if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
    ::_exit(127);
}

std::pair<UniqueDescriptor, UniqueDescriptor> new_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error{errno, std::system_category(), "pipe"};
    return {UniqueDescriptor{ends[0]}, UniqueDescriptor{ends[1]}};
}

// Unlike a pipe, it can be written to without the danger of SIGPIPE.
std::pair<UniqueDescriptor, UniqueDescriptor> new_socket_pair() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw std::system_error{errno, std::system_category(), "socketpair"};
    return {UniqueDescriptor{ends[0]}, UniqueDescriptor{ends[1]}};
}

std::string seconds(std::chrono::milliseconds time) {
    return std::to_string(std::chrono::duration_cast<std::chrono::seconds>(time).count()) + " s";
}

std::string how_it_ended(int status) {
    return WIFSIGNALED(status) ? "by signal " + std::to_string(WTERMSIG(status))
                               : "with exit code " + std::to_string(WEXITSTATUS(status));
}

// Used on the thread of the programs.
class Program : public std::enable_shared_from_this<Program> {
public:
    Program(asio::io_context& io, std::string name, std::shared_ptr<Programs::Listener const> listener, ProgramTimes times)
        : name_{std::move(name)}, listener_{std::move(listener)}, times_{times}, output_{io}, end_{io}, timer_{io} {}

    // Without a value: ends the program.
    void set(std::optional<Programs::Wanted> wanted) {
        if (wanted == wanted_ && immediate_ends_ < most_immediate_ends) return;
        wanted_ = std::move(wanted);
        immediate_ends_ = 0;
        pause_ = times_.shortest_pause;
        is_replaced_ = true;
        if (pid_ != 0)
            end();
        else
            start_after(0s);
    }

private:
    void start_after(std::chrono::milliseconds pause) {
        timer_.expires_after(pause);
        timer_.async_wait([self = shared_from_this()](error_code error) {
            if (!error && self->wanted_ && self->pid_ == 0) self->start();
        });
    }

    void start() {
        begun_ = std::chrono::steady_clock::now();
        is_replaced_ = false;
        try {
            launch();
        } catch (std::exception const& problem) {
            close();
            if (pid_ != 0) kill_and_wait(std::exchange(pid_, 0));
            dismiss_watcher();
            return start_again(std::string{"its program cannot be started: "} + problem.what());
        }
        read();
        end_.async_wait(Descriptor::wait_read, [self = shared_from_this()](error_code) { self->ended(); });
    }

    void launch() {
        auto [ours, its] = new_pipe();
        auto [watched, alive] = new_socket_pair();
        Words const command{wanted_->command}, variables{environment(*wanted_, listener_->token(name_))};
        auto const pid = ::fork();
        if (pid == 0) become(wanted_->folder.c_str(), command.data(), variables.data(), its.get(), watched.get());
        if (pid < 0) throw std::system_error{errno, std::system_category(), "a new process"};
        pid_ = pid;
        ::setpgid(pid_, pid_);  // as the program does: from now on its group can be ended
        UniqueDescriptor end{static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))};
        if (end.get() < 0) throw std::system_error{errno, std::system_category(), "a new process"};
        alive_ = std::move(alive);
        output_.assign(ours.get());
        ours.release();
        end_.assign(end.get());
        end.release();
        output_.non_blocking(true);
    }

    void close() {
        error_code ignored;
        output_.close(ignored);
        end_.close(ignored);
    }

    void read() {
        output_.async_read_some(asio::buffer(piece_), [self = shared_from_this()](error_code error, std::size_t size) {
            if (error) return;
            try {
                self->said(size);
            } catch (std::exception const&) {
                self->line_.clear();  // no memory
            }
            self->read();
        });
    }

    void said(std::size_t size) {
        line_.append(piece_.data(), size);
        for (auto end = line_.find('\n'); end != line_.npos || line_.size() > longest_line; end = line_.find('\n')) {
            auto const length = std::min(end, longest_line);
            listener_->says(name_, line_.substr(0, length));
            line_.erase(0, end == length ? length + 1 : length);
        }
    }

    void end() {
        ::kill(-pid_, SIGTERM);
        timer_.expires_after(times_.to_end);
        timer_.async_wait([self = shared_from_this(), pid = pid_](error_code error) {
            if (!error && self->pid_ == pid) ::kill(-pid, SIGKILL);
        });
    }

    void ended() {
        try {
            read_rest();
        } catch (std::exception const&) {
            line_.clear();  // no memory
        }
        close();
        timer_.cancel();
        auto const status = kill_and_wait(std::exchange(pid_, 0));
        dismiss_watcher();
        if (is_replaced_ && wanted_)
            start();
        else if (wanted_)
            start_again("its program ended " + how_it_ended(status));
    }

    // Reads the program's last output. At most as much as a pipe holds, because programs that it has started may still write.
    void read_rest() {
        error_code error;
        for (std::size_t all = 0, size = 0; all < 64 * 1024 && !error; all += size) {
            size = output_.read_some(asio::buffer(piece_), error);
            if (!error) said(size);
        }
        if (!line_.empty()) listener_->says(name_, std::exchange(line_, {}));
    }

    // Ends also what the program has started. Returns how the program ended.
    static int kill_and_wait(pid_t pid) {
        ::kill(-pid, SIGKILL);
        ::kill(pid, SIGKILL);
        int status = 0;
        ::waitpid(pid, &status, 0);
        return status;
    }

    void dismiss_watcher() {
        ::send(alive_.get(), "\n", 1, MSG_NOSIGNAL);  // it may be dead already
        alive_ = {};
    }

    void start_again(std::string const& what) {
        auto const ran = std::chrono::steady_clock::now() - begun_;
        immediate_ends_ = ran < times_.immediately ? immediate_ends_ + 1 : 0;
        if (ran > times_.longest_pause) pause_ = times_.shortest_pause;
        if (immediate_ends_ == most_immediate_ends)
            return listener_->happens(name_, what + ", " + std::to_string(most_immediate_ends) + " times in a row within " +
                                                 seconds(times_.immediately) +
                                                 " of its start: it is not started again until SIGHUP");
        auto const pause = std::exchange(pause_, std::min(2 * pause_, times_.longest_pause));
        listener_->happens(name_, what + ": it is started again in " + seconds(pause));
        start_after(pause);
    }

    std::string const name_;
    std::shared_ptr<Programs::Listener const> const listener_;
    ProgramTimes const times_;
    std::optional<Programs::Wanted> wanted_;  // nothing: it ends, or has ended
    UniqueDescriptor alive_;                  // its watcher reads from it until the gateway ends
    Descriptor output_;
    Descriptor end_;  // readable when the program has ended
    asio::steady_timer timer_;
    std::array<char, 4'096> piece_{};
    std::string line_;  // that has not ended yet
    pid_t pid_ = 0;     // 0: it does not run
    bool is_replaced_ = false;
    std::chrono::steady_clock::time_point begun_;
    std::chrono::milliseconds pause_ = times_.shortest_pause;
    int immediate_ends_ = 0;
};

}  // namespace

class Programs::All {
public:
    All(Listener listener, ProgramTimes times)
        : listener_{std::make_shared<Listener const>(std::move(listener))}, times_{times} {}

    void set(std::vector<Wanted> wanted) {
        asio::post(io_, [this, wanted = std::move(wanted)] {
            for (auto const& [name, program] : programs_)
                if (std::ranges::find(wanted, name, &Wanted::name) == wanted.end()) program->set({});
            for (auto const& each : wanted) {
                auto& program = programs_[each.name];
                if (!program) program = std::make_shared<Program>(io_, each.name, listener_, times_);
                program->set(each);
            }
        });
    }

    void end() {
        set({});
        asio::post(io_, [this] { work_.reset(); });
        thread_.join();
    }

private:
    // Without memory a line of output, or a restart, may be lost. The gateway goes on.
    void run() {
        while (true) {
            try {
                io_.run();
                return;
            } catch (std::exception const&) {
                continue;
            }
        }
    }

    std::shared_ptr<Listener const> const listener_;
    ProgramTimes const times_;
    asio::io_context io_{1};
    asio::executor_work_guard<asio::io_context::executor_type> work_{io_.get_executor()};
    std::map<std::string, std::shared_ptr<Program>> programs_;  // by the names of their sub engines
    std::thread thread_{[this] { run(); }};                     // programs end with it
};

Programs::Programs(Listener listener, ProgramTimes times) : all_{std::make_unique<All>(std::move(listener), times)} {}

Programs::~Programs() { all_->end(); }

void Programs::set(std::vector<Wanted> wanted) { all_->set(std::move(wanted)); }

}  // namespace rois::remote
