// Runs the `rois` program.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "kit/gateway_process.hpp"

namespace rois::test {

using kit::Ended;
using kit::GatewayProcess;
using kit::shared_gateway;
using kit::Variables;

// Runs rois with these arguments and this standard input until it ends. Unless `variables` sets ROIS_URL, no gateway answers
// there.
Ended run_rois(std::vector<std::string> const& arguments, std::string const& input = {}, Variables const& variables = {});

// A running `rois` process.
class RoisProcess {
public:
    explicit RoisProcess(std::vector<std::string> const& arguments, Variables const& variables = {});
    ~RoisProcess();  // kills it if it still runs
    RoisProcess(RoisProcess const&) = delete;
    RoisProcess& operator=(RoisProcess const&) = delete;

    // Returns the next line of its standard output, without its line end. Throws std::runtime_error if it has ended.
    std::string line();
    // Returns the next line with this text.
    std::string line_with(std::string const& text);

    // Returns the next line of its standard error, which `wait` then leaves out. Throws std::runtime_error if it has ended.
    std::string error_line();

    // Closes its standard output, as `| head` does.
    void stop_reading();

    void signal(int number);
    // Waits for its end; `out` is the output that was not read as lines.
    Ended wait();

private:
    pid_t process_ = 0;
    int out_ = -1;
    int error_ = -1;
    std::string read_;
    std::string error_read_;
};

// Files in a folder of this test program, which is removed at the end.
std::string file_with(std::string const& name, std::string const& text);
std::string file_named(std::string const& name);
std::string text_of(std::string const& file);

std::vector<std::string> lines_of(std::string const& text);

}  // namespace rois::test
