// Starts programs and reads what they write.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

namespace rois::kit {

using Variables = std::map<std::string, std::string>;

// Preloads a library into a program. The address sanitizer, which expects to be the first one, accepts that.
Variables preloading(std::string const& library, Variables = {});

// How a program ended, and its output.
struct Ended {
    int exit_code = -1;  // minus the signal if a signal killed the program
    std::string out;
    std::string error;
};

// Both ends are closed by exec. The owner closes them.
struct Pipe {
    Pipe();
    int to_read = -1;
    int to_write = -1;
};

constexpr int inherited = -1;
constexpr int closed = -2;

// The standard streams of a new process: a descriptor, `inherited` or `closed`.
struct Streams {
    int in = inherited;
    int out = inherited;
    int error = inherited;
};

// Starts a program and returns its process id. A program without a slash is searched in PATH. `variables` are added to the
// environment. Throws std::system_error if the program is missing or not executable.
pid_t start(std::string const& program, std::vector<std::string> const& arguments, Variables const&, Streams const&);

// Waits for the end of a process. Returns its exit code, or minus the signal that killed it.
int exit_code(pid_t);

// Appends the next bytes to `text`; blocks until there are some. Returns false at the end of the stream.
bool read_some(int from, std::string& text);

// Reads both streams of a process to their ends, and closes them. Kills the process after 100 s.
void read_both(pid_t, int out, std::string& out_text, int error, std::string& error_text);

// Runs a program with this standard input until it ends.
Ended run(std::string const& program, std::vector<std::string> const& arguments, std::string const& input = {},
          Variables const& = {});

// Runs a command line of the shell.
Ended run_shell(std::string const& command_line);

}  // namespace rois::kit
