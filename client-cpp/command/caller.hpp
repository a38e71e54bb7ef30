// The process that called this program: a shell or a script.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace rois::command {

// Thread-safe.
class Caller {
public:
    // Of this process. Made before the program goes to the background, where it has another parent.
    Caller();

    // Whether the caller runs: it has not ended and is not stopped (SIGSTOP, Ctrl-Z). False if it cannot be seen from here, as
    // with `docker exec`.
    bool is_alive() const;

private:
    pid_t process_;
    std::optional<std::string> born_;  // when, so that another process of the same number is told apart
};

}  // namespace rois::command
