// The real program, run by a test.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
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

    pid_t id() const { return process_; }
    std::uint16_t port() const { return port_; }
    std::string const& url() const { return url_; }
    client::Address address() const { return {.port = port_}; }
    std::size_t resident_bytes() const;
    // From now on the process gets only so many more bytes of address space.
    void limit_address_space(std::size_t more) const;

    // What it has logged, as soon as the text is in it; after ten seconds also without it.
    std::string log_with(std::string_view text);

    void signal(int number);
    // Waits for its end.
    Ended wait();

private:
    pid_t process_ = 0;
    int errors_ = -1;  // its standard error, which the reader reads on, so that no log is too long
    std::thread reader_;
    std::mutex mutex_;  // guards the next two
    std::condition_variable news_;
    std::string log_;
    bool ended_ = false;  // nothing more comes
    std::string url_;
    std::uint16_t port_ = 0;
};

// One gateway for all tests of this program that need no settings of their own.
GatewayProcess& shared_gateway();

}  // namespace rois::test
