// The log never delays a request, whatever happens to standard error.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <spdlog/details/log_msg.h>
#include <spdlog/pattern_formatter.h>
#include <unistd.h>

#include <thread>

#include "gateway/process/log_queue.hpp"
#include "kit/gateway_process.hpp"
#include "kit/http_client.hpp"
#include "kit/socket.hpp"
#include "kit/vocabulary.hpp"

namespace rois::test {

using namespace std::chrono_literals;
using testing::HasSubstr;

namespace {

struct Pipe : kit::Pipe {
    ~Pipe() {
        close(to_read);
        close(to_write);
    }

    // Writes until the pipe is full.
    void fill() const {
        std::string const much(4'096, '.');
        fcntl(to_write, F_SETFL, O_NONBLOCK);
        while (write(to_write, much.data(), much.size()) > 0) {
        }
        fcntl(to_write, F_SETFL, 0);
    }
    std::string read_now() const {
        std::string text(200'000, ' ');
        fcntl(to_read, F_SETFL, O_NONBLOCK);
        auto const size = read(to_read, text.data(), text.size());
        text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
        return text;
    }
};

// The real gateway with this standard error, or none if it is kit::closed.
class Gateway {
public:
    explicit Gateway(int error) {
        std::vector<std::string> const arguments{"--listen", "127.0.0.1:" + std::to_string(address.port), "--log-level", "debug"};
        process_ = kit::start(kit::gateway_program, arguments, {}, {.error = error});
    }
    ~Gateway() {
        if (process_ != 0) end();
    }
    Gateway(Gateway const&) = delete;
    Gateway& operator=(Gateway const&) = delete;

    bool is_ready() const {
        for (int i = 0; i < 200; ++i) {
            try {
                if (kit::HttpClient{address}.get("/readyz").status == 200) return true;
            } catch (kit::LineEnded const&) {
                std::this_thread::sleep_for(50ms);
            }
        }
        return false;
    }

    void say(int times) const {
        kit::HttpClient desk{address};
        desk.call("connect");
        EXPECT_EQ(desk.call("bind", kit::component_ref("speech_synthesis")).return_code(), "OK");
        for (int i = 0; i < times; ++i) {
            auto const reply =
                desk.call("execute", kit::sequence(kit::unit({.component = "speech_synthesis",
                                                              .arguments = {kit::speech_text("Hello, " + std::to_string(i))}})));
            ASSERT_EQ(reply.return_code(), "OK") << i;
        }
    }

    // Returns the exit code.
    int end() {
        kill(process_, SIGTERM);
        return kit::exit_code(std::exchange(process_, 0));
    }

    kit::Address address{.port = kit::Listener{}.port()};

private:
    pid_t process_ = 0;
};

struct TheLog : testing::Test {
    Pipe pipe;
    static inline std::atomic<Steady> now{Steady{1h}};
    LogQueue::Limits limits{.lines = 100, .bytes = 100'000, .a_second = 10, .flush = 100ms, .now = [] { return now.load(); }};

    static void say(LogQueue& log, std::string const& text) { log.log({"test", spdlog::level::info, text}); }
    static void plainly(LogQueue& log) {
        log.set_formatter(std::make_unique<spdlog::pattern_formatter>("%v", spdlog::pattern_time_type::utc, "\n"));
    }
};

}  // namespace

TEST_F(TheLog, HasALineForEachStep) {
    LogQueue log{pipe.to_write};
    plainly(log);
    say(log, "one");
    say(log, "two");
    log.flush();
    EXPECT_EQ(pipe.read_now(), "one\ntwo\n");
}

TEST_F(TheLog, HasTenLinesASecondOfOneCause) {
    LogQueue log{pipe.to_write, limits};
    plainly(log);
    for (int i = 0; i < 25; ++i)
        say(log, "session " + std::to_string(i) + " says '" + std::string(static_cast<std::size_t>(i), 'x') + "'");
    say(log, "something else");
    log.flush();
    auto const text = pipe.read_now();
    EXPECT_EQ(std::ranges::count(text, '\n'), 11);
    EXPECT_THAT(text, HasSubstr("something else"));
    EXPECT_EQ(log.left_out(), 15);
    now = now.load() + 1s;
    say(log, "session 77 says 'y'");
    log.flush();
    EXPECT_THAT(pipe.read_now(),
                HasSubstr("15 more lines like this one were left out: session 10 says 'xxxxxxxxxx'\nsession 77"));
}

TEST_F(TheLog, CountsLinesWhoseQuotedTextHasQuotationMarksAsOneCause) {
    LogQueue log{pipe.to_write, limits};
    plainly(log);
    for (char letter = 'a'; letter <= 'z'; ++letter)
        say(log, std::string{"refused 'GET /' of 'it's "} + letter + " \"and' " + letter + "'");
    log.flush();
    EXPECT_EQ(std::ranges::count(pipe.read_now(), '\n'), 10);
}

TEST_F(TheLog, DropsTheOldestLinesAndReportsTheirNumber) {
    pipe.fill();
    limits.a_second = 1'000;
    limits.now = std::chrono::steady_clock::now;
    LogQueue log{pipe.to_write, limits};
    plainly(log);
    for (int i = 0; i < 500; ++i) say(log, "line " + std::to_string(i));
    EXPECT_GE(log.dropped(), 399);
    while (pipe.read_now().find("line 499") == std::string::npos) {
        if (log.dropped() > 500) break;
    }
    EXPECT_LE(log.dropped(), 400);
}

TEST_F(TheLog, EndsWithin2SecondsWithoutAReader) {
    pipe.fill();
    limits.now = std::chrono::steady_clock::now;
    auto const begin = std::chrono::steady_clock::now();
    {
        LogQueue log{pipe.to_write, limits};
        say(log, "one");
        log.flush();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 2s);
}

TEST(StandardError, ThatIsNotReadDelaysNoRequest) {
    Pipe const pipe;
    pipe.fill();
    Gateway gateway{pipe.to_write};
    ASSERT_TRUE(gateway.is_ready());
    gateway.say(500);
    EXPECT_THAT(kit::HttpClient{gateway.address}.get("/metrics").body, HasSubstr("rois_log_lines_left_out_total"));
    EXPECT_EQ(gateway.end(), 0);
}

TEST(StandardError, ThatIsClosedDoesNotEndTheGateway) {
    Pipe pipe;
    Gateway gateway{pipe.to_write};
    ASSERT_TRUE(gateway.is_ready());
    close(std::exchange(pipe.to_read, -1));
    gateway.say(50);
    EXPECT_EQ(gateway.end(), 0);
}

TEST(StandardError, ThatWasNeverOpenIsNotReplacedByASocket) {
    Gateway gateway{kit::closed};
    ASSERT_TRUE(gateway.is_ready());
    gateway.say(50);
    EXPECT_EQ(gateway.end(), 0);
}

}  // namespace rois::test
