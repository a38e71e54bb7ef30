// The process that called this program: a shell or a script.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace rois::command {

// Thread-safe.
class Caller {
public:
    // The parent of this process. Construct it before the program goes to the background, where its parent is another process.
    Caller();

    // Returns whether the caller runs: it has not ended and is not stopped (SIGSTOP, Ctrl-Z). Returns false if it is not visible
    // from here, as with `docker exec`.
    bool is_alive() const;

private:
    pid_t process_;
    std::optional<std::string> born_;  // start time, to detect another process with the same id
};

}  // namespace rois::command
