// Runs rois-gateway.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "kit/address.hpp"
#include "kit/process.hpp"

namespace rois::kit {

constexpr auto gateway_program = ROIS_BINARY_DIR "/bin/rois-gateway";

// Runs rois-gateway with these arguments until it ends.
Ended run_gateway(std::vector<std::string> const& arguments, Variables const& = {});

// A gateway that listens on a free port of the loopback. The destructor ends it; the test fails if its exit code is not 0. After
// a failed test, the destructor prints the gateway's log.
class GatewayProcess {
public:
    // Waits until the gateway listens. Throws std::runtime_error with its output if the gateway ends before that. `program` is
    // the gateway, or a program that becomes it.
    explicit GatewayProcess(std::vector<std::string> arguments = {}, Variables const& = {},
                            std::string const& program = gateway_program);
    ~GatewayProcess();
    GatewayProcess(GatewayProcess const&) = delete;
    GatewayProcess& operator=(GatewayProcess const&) = delete;

    pid_t id() const { return process_; }
    std::uint16_t port() const { return port_; }
    std::string const& url() const { return url_; }
    Address address() const { return {.port = port_}; }
    Address media_address();  // of the gateway's media server, without TLS
    std::size_t resident_bytes() const;
    // Limits the address space of the process to its present size and this number of bytes.
    void limit_address_space(std::size_t more) const;

    // Returns the log as soon as it contains the text. It must come within ten seconds.
    std::string log_with(std::string_view text);

    void signal(int number);
    // Waits for the end of the process.
    Ended wait();

private:
    pid_t process_ = 0;
    int errors_ = -1;  // standard error of the gateway; the reader thread empties the pipe, so that the gateway never blocks
    std::thread reader_;
    std::mutex mutex_;  // guards the members below
    std::condition_variable news_;
    std::string log_;
    bool ended_ = false;  // the reader has reached the end of the log
    std::string url_;
    std::uint16_t port_ = 0;
};

// The gateway with default settings that all tests of a program share.
GatewayProcess& shared_gateway();

}  // namespace rois::kit
