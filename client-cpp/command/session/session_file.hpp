// A session that outlives one run of `rois`: a process in the background holds it, and a file names it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "command/exit.hpp"

namespace rois::command {

// The content of the file: the gateway, its session, and the process that holds the session.
struct HeldSession {
    std::string url;
    std::string session;
    pid_t holder = 0;
};

// Returns the session that a running process holds under this file. Returns nothing if the file is missing, or if its process has
// ended (the process locks the file for as long as it runs). Waits while a process is opening its session. Throws Trouble: usage
// if the file cannot be read, no_answer if that process has opened none within `deadline`.
std::optional<HeldSession> find_held_session(std::string const& file, std::chrono::milliseconds deadline);

// Ends this holder of the file, and waits until its session has ended. Returns at once if another process or none has locked the
// file. Throws Trouble (no_answer) if the holder has not ended within `deadline`.
void end_holder(std::string const& file, pid_t holder, std::chrono::milliseconds deadline);

// The error that no process holds a session under the file.
Trouble no_holder(std::string const& file);

// The holder's side: a file that only its owner can read, locked. The destructor calls `remove`.
class SessionFile {
public:
    // Creates the file and locks it. Returns null if another process has locked it. Throws Trouble (usage) if the file cannot be
    // written, or if it was not written by this program.
    static std::unique_ptr<SessionFile> lock(std::string const& file);
    ~SessionFile();
    SessionFile(SessionFile const&) = delete;
    SessionFile& operator=(SessionFile const&) = delete;

    // The session in the file, if its holder was killed.
    std::optional<HeldSession> const& left() const { return left_; }

    // From now on `find_held_session` returns this session. Throws Trouble (usage) if the file cannot be written.
    void write(std::string const& url, std::string const& session);

    // Returns whether the name still refers to this file. If not, `find_held_session` does not find this holder. From any thread.
    bool is_there() const;

    // Removes the file, unless the name refers to another file, or the file still names the session of a killed holder.
    void remove() const;

private:
    SessionFile(std::string file, int descriptor) : file_{std::move(file)}, descriptor_{descriptor} {}

    std::string const file_;
    int const descriptor_;
    std::optional<HeldSession> left_;
};

// Continues the program in a child process. Construct it before any thread starts. The parent waits, and ends with exit code 0
// when the child is ready, or with the child's exit code if that ends first. If the parent is killed before, the child gets
// SIGTERM.
class Background {
public:
    Background();
    ~Background();
    Background(Background const&) = delete;
    Background& operator=(Background const&) = delete;

    // Ends the parent, and detaches from its terminal and from standard input, output and error. Throws Trouble (interrupted) if
    // the parent was killed: its caller does not know of the session.
    void ready();

private:
    int parent_ = -1;  // a pipe; -1: the parent has ended
};

}  // namespace rois::command
