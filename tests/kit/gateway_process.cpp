#include "kit/gateway_process.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <utility>

namespace rois::kit {

Ended run_gateway(std::vector<std::string> const& arguments, Variables const& variables) {
    return run(gateway_program, arguments, {}, variables);
}

GatewayProcess::GatewayProcess(std::vector<std::string> arguments, Variables const& variables, std::string const& program) {
    if (std::ranges::find(arguments, "--listen") == arguments.end()) {
        arguments.insert(arguments.end(), {"--listen", "127.0.0.1:0"});
    }
    Pipe const error;
    process_ = start(program, arguments, variables, {.error = error.to_write});
    close(error.to_write);
    errors_ = error.to_read;
    reader_ = std::thread{[this] {
        std::string more;
        while (read_some(errors_, more)) {
            std::lock_guard const lock{mutex_};
            log_ += std::exchange(more, {});
            news_.notify_all();
        }
        std::lock_guard const lock{mutex_};
        ended_ = true;
        news_.notify_all();
    }};
    static std::string const mark = "listening on ";
    auto const listening = [&] {
        auto const at = log_.find(mark);
        return at != std::string::npos && log_.find_first_of("\"\n", at) != std::string::npos;
    };
    std::unique_lock lock{mutex_};
    news_.wait(lock, [&] { return ended_ || listening(); });
    if (!listening()) {
        lock.unlock();
        throw std::runtime_error{"the gateway does not listen: " + wait().error};
    }
    auto const begin = log_.find(mark) + mark.size();
    url_ = log_.substr(begin, log_.find_first_of("\"\n", begin) - begin);
    port_ = static_cast<std::uint16_t>(std::stoi(url_.substr(url_.rfind(':') + 1)));
}

GatewayProcess::~GatewayProcess() {
    if (process_ != 0) {
        signal(SIGTERM);
        EXPECT_EQ(wait().exit_code, 0) << log_;
    }
    auto const* const test = testing::UnitTest::GetInstance()->current_test_info();
    if (test && test->result()->Failed()) std::cerr << "log of the gateway at " << url_ << ":\n" << log_;
}

std::size_t GatewayProcess::resident_bytes() const {
    std::ifstream in{"/proc/" + std::to_string(process_) + "/statm"};
    std::size_t whole = 0, resident = 0;
    in >> whole >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void GatewayProcess::limit_address_space(std::size_t more) const {
    std::ifstream in{"/proc/" + std::to_string(process_) + "/statm"};
    rlim_t whole = 0;
    in >> whole;
    rlimit const limit{whole * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + more, RLIM_INFINITY};
    EXPECT_EQ(prlimit(process_, RLIMIT_AS, &limit, nullptr), 0);
}

Address GatewayProcess::media_address() {
    std::string const mark = "://127.0.0.1:";
    auto const log = log_with("media are served under");
    auto const port = log.find(mark, log.find("media are served under")) + mark.size();
    return {.port = static_cast<std::uint16_t>(std::stoi(log.substr(port)))};
}

std::string GatewayProcess::log_with(std::string_view text) {
    std::unique_lock lock{mutex_};
    auto const is_there = [&] { return log_.find(text) != std::string::npos; };
    news_.wait_for(lock, std::chrono::seconds{10}, [&] { return ended_ || is_there(); });
    EXPECT_TRUE(is_there()) << "in the log: " << text;
    return log_;
}

void GatewayProcess::signal(int number) { kill(process_, number); }

Ended GatewayProcess::wait() {
    reader_.join();
    close(errors_);
    Ended ended;
    ended.exit_code = exit_code(process_);
    ended.error = log_;
    process_ = 0;
    return ended;
}

GatewayProcess& shared_gateway() {
    // Ends before the result of the program is known, so that a bad exit code of the gateway is a failure.
    class Shared : public testing::Environment {
    public:
        void TearDown() override { gateway.reset(); }
        std::unique_ptr<GatewayProcess> gateway;
    };
    static auto* const shared = dynamic_cast<Shared*>(testing::AddGlobalTestEnvironment(new Shared));
    if (!shared->gateway) shared->gateway = std::make_unique<GatewayProcess>();
    return *shared->gateway;
}

}  // namespace rois::kit
