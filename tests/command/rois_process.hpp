// The `rois` program, run by a test.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "server/gateway_process.hpp"

namespace rois::test {

// Runs rois with these arguments and this standard input until it ends. Without other variables, ROIS_URL leads nowhere.
Ended run_rois(std::vector<std::string> const& arguments, std::string const& input = {}, Variables const& variables = {});

// One that goes on until it is told to end.
class RoisProcess {
public:
    explicit RoisProcess(std::vector<std::string> const& arguments, Variables const& variables = {});
    ~RoisProcess();  // ends it when it still runs
    RoisProcess(RoisProcess const&) = delete;
    RoisProcess& operator=(RoisProcess const&) = delete;

    // The next line of its standard output, without its line end. A failure when there is none.
    std::string line();
    // The next line that has this in it.
    std::string line_with(std::string const& text);

    // The next line of its standard error, which `wait` leaves out then. Throws std::runtime_error when it has ended.
    std::string error_line();

    // As `| head` does: what it writes from now on cannot be written.
    void stop_reading();

    void signal(int number);
    // Waits for its end; `out` is what was not read as lines.
    Ended wait();

private:
    pid_t process_ = 0;
    int out_ = -1;
    int error_ = -1;
    std::string read_;
    std::string error_read_;
};

// A file in a folder of this test program that is removed at the end.
std::string file_with(std::string const& name, std::string const& text);
std::string file_named(std::string const& name);
std::string text_of(std::string const& file);

std::vector<std::string> lines_of(std::string const& text);

}  // namespace rois::test
