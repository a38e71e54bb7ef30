// The real program, run by a test.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "client/address.hpp"

namespace rois::test {

using Variables = std::map<std::string, std::string>;

// How a program ended, and what it wrote.
struct Ended {
    int exit_code = -1;  // minus the signal when one killed it
    std::string out;
    std::string error;
};

// Runs rois-gateway with these arguments until it ends.
Ended run_gateway(std::vector<std::string> const& arguments, Variables const& = {});

// A gateway that listens on a free port of the loopback; ended with it. It is a failure when that does not go well.
class GatewayProcess {
public:
    // Waits until it listens. Throws std::runtime_error with what it said when it does not.
    explicit GatewayProcess(std::vector<std::string> arguments = {}, Variables const& = {});
    ~GatewayProcess();
    GatewayProcess(GatewayProcess const&) = delete;
    GatewayProcess& operator=(GatewayProcess const&) = delete;

    std::uint16_t port() const { return port_; }
    std::string const& url() const { return url_; }
    client::Address address() const { return {.port = port_}; }
    std::size_t resident_bytes() const;

    void signal(int number);
    // Waits for its end.
    Ended wait();

private:
    pid_t process_ = 0;
    int errors_ = -1;  // its standard error
    std::string log_;  // read from it until now
    std::string url_;
    std::uint16_t port_ = 0;
};

// One gateway for all tests of this program that need no settings of their own.
GatewayProcess& shared_gateway();

}  // namespace rois::test
