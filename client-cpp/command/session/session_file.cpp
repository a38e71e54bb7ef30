#include "command/session/session_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "command/output/json.hpp"
#include "types/text/texts.hpp"
#include "types/unique_descriptor.hpp"

namespace rois::command {

namespace {

constexpr std::chrono::milliseconds poll_interval{10};

[[noreturn]] void complain(std::string const& file, std::string const& what) {
    throw Trouble{Exit::usage, "--session-file " + rois::quoted(file) + ": " + what};
}

[[noreturn]] void complain_of_error(std::string const& file, std::string const& what) {
    complain(file, what + ": " + std::strerror(errno));
}

struct flock whole_file(short type) {
    struct flock lock {};
    lock.l_type = type;
    lock.l_whence = SEEK_SET;
    return lock;
}

// Returns the process that has locked the file; 0 if there is none.
pid_t holder_of(int descriptor) {
    auto lock = whole_file(F_WRLCK);
    if (fcntl(descriptor, F_GETLK, &lock) != 0 || lock.l_type == F_UNLCK) return 0;
    return lock.l_pid;
}

// Rejects FIFOs and devices, which would block or lose the text. Rejects a file of another user, who could send the token to
// another gateway, and a file that others can read, since the session is a secret. An empty file has no secret yet.
void check_trusted(std::string const& file, int descriptor) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) complain_of_error(file, "cannot be read");
    if (!S_ISREG(status.st_mode)) complain(file, "this is not a regular file");
    if (status.st_uid != geteuid()) complain(file, "it belongs to another user; name a file of your own");
    if (status.st_size > 0 && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
        complain(file, "other users can read it, but the session in it is a secret; allow only its owner: chmod 600");
}

// Rejects symbolic links, which would stay when the holder removes its file. Returns -1 if the file is missing.
int open_file(std::string const& file, int flags, char const* failure) {
    int const descriptor = open(file.c_str(), flags | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, S_IRUSR | S_IWUSR);
    if (descriptor < 0 && errno == ELOOP) complain(file, "this is a symbolic link; name the file itself");
    if (descriptor < 0 && errno != ENOENT) complain_of_error(file, failure);
    return descriptor;
}

int open_to_read(std::string const& file) { return open_file(file, O_RDONLY, "cannot be read"); }

// Returns nothing if the file is empty. Throws Trouble (usage) if it cannot be read, or was not written by `SessionFile::write`.
std::optional<HeldSession> read_held_session(std::string const& file, int descriptor) {
    check_trusted(file, descriptor);
    char text[4096];
    auto const size = pread(descriptor, text, sizeof text, 0);
    if (size < 0) complain_of_error(file, "cannot be read");
    if (size == 0) return std::nullopt;
    auto const content = Json::parse(text, text + size, nullptr, false);
    bool const is_ours = content.is_object() && content.value("url", Json{}).is_string() &&
                         content.value("session", Json{}).is_string() && content.value("process", Json{}).is_number_integer();
    if (!is_ours) complain(file, "this file was not written by rois bind --session-file");
    return HeldSession{content["url"], content["session"], content["process"]};
}

// Returns whether the name still refers to the open file: it may have been removed, or replaced by another holder.
bool is_still(std::string const& file, int descriptor) {
    struct stat open_one {};
    struct stat named {};
    return fstat(descriptor, &open_one) == 0 && lstat(file.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
           open_one.st_dev == named.st_dev;
}

}  // namespace

std::optional<HeldSession> find_held_session(std::string const& file, std::chrono::milliseconds deadline) {
    auto const end = std::chrono::steady_clock::now() + deadline;
    while (true) {
        UniqueDescriptor const open_file{open_to_read(file)};
        if (open_file.get() < 0) return std::nullopt;
        auto held = read_held_session(file, open_file.get());
        auto const holder = holder_of(open_file.get());
        if (holder == 0 && is_still(file, open_file.get())) return std::nullopt;
        if (held && held->holder == holder) return held;
        if (std::chrono::steady_clock::now() >= end)
            throw Trouble{Exit::no_answer, "--session-file " + rois::quoted(file) + ": process " + std::to_string(holder) +
                                               " has not opened its session under this file within " +
                                               std::to_string(deadline.count()) + " ms"};
        std::this_thread::sleep_for(poll_interval);
    }
}

void end_holder(std::string const& file, pid_t holder, std::chrono::milliseconds deadline) {
    UniqueDescriptor const open_file{open_to_read(file)};
    if (open_file.get() < 0 || holder_of(open_file.get()) != holder) return;
    if (kill(holder, SIGTERM) != 0 && errno != ESRCH)
        complain_of_error(file, "process " + std::to_string(holder) + " cannot be ended");
    kill(holder, SIGCONT);  // a stopped process ends, too
    auto const end = std::chrono::steady_clock::now() + deadline;
    while (holder_of(open_file.get()) == holder) {
        if (std::chrono::steady_clock::now() >= end)
            throw Trouble{Exit::no_answer, "process " + std::to_string(holder) + ", which holds the session, has not ended"};
        std::this_thread::sleep_for(poll_interval);
    }
}

Trouble no_holder(std::string const& file) {
    return {Exit::usage, "--session-file " + rois::quoted(file) +
                             ": no process holds a session under this file; rois bind --session-file FILE REF starts one"};
}

std::unique_ptr<SessionFile> SessionFile::lock(std::string const& file) {
    while (true) {
        UniqueDescriptor locked_file{open_file(file, O_RDWR | O_CREAT, "cannot be written")};
        int const descriptor = locked_file.get();
        if (descriptor < 0) complain_of_error(file, "cannot be written");
        check_trusted(file, descriptor);
        auto lock = whole_file(F_WRLCK);
        if (fcntl(descriptor, F_SETLK, &lock) != 0) return nullptr;
        if (!is_still(file, descriptor)) continue;
        auto left = read_held_session(file, descriptor);
        std::unique_ptr<SessionFile> locked{new SessionFile{file, locked_file.release()}};
        locked->left_ = std::move(left);
        return locked;
    }
}

SessionFile::~SessionFile() {
    remove();
    close(descriptor_);
}

bool SessionFile::is_there() const { return is_still(file_, descriptor_); }

void SessionFile::remove() const {
    if (!left_ && is_there()) unlink(file_.c_str());
}

void SessionFile::write(std::string const& url, std::string const& session) {
    auto const text = Json{{"url", url}, {"session", session}, {"process", getpid()}}.dump() + "\n";
    bool const written = fchmod(descriptor_, S_IRUSR | S_IWUSR) == 0 && ftruncate(descriptor_, 0) == 0 &&
                         pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
    if (!written) complain_of_error(file_, "cannot be written");
    left_.reset();
}

Background::Background() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Trouble{Exit::error, std::string{"cannot create a pipe: "} + std::strerror(errno)};
    std::fflush(nullptr);
    auto const parent = getpid();
    auto const child = fork();
    if (child < 0) throw Trouble{Exit::error, std::string{"cannot start a process in the background: "} + std::strerror(errno)};
    if (child == 0) {
        close(ends[0]);
        parent_ = ends[1];
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (getppid() != parent) _exit(static_cast<int>(Exit::interrupted));
        return;
    }
    close(ends[1]);
    char byte = 0;
    ssize_t size = 0;
    do {
        size = read(ends[0], &byte, 1);
    } while (size < 0 && errno == EINTR);
    if (size == 1) _exit(0);
    int status = 0;
    waitpid(child, &status, 0);
    _exit(WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(Exit::error));
}

Background::~Background() {
    if (parent_ >= 0) close(parent_);
}

void Background::ready() {
    prctl(PR_SET_PDEATHSIG, 0);
    setsid();
    std::fflush(nullptr);
    int const nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int const standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, standard);
    close(nowhere);
    char const byte = 0;
    auto const written = ::write(parent_, &byte, 1);
    close(std::exchange(parent_, -1));
    if (written != 1) throw Trouble{Exit::interrupted, ""};
}

}  // namespace rois::command
