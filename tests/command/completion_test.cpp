// Completion in an interactive bash on a terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "command/rois_process.hpp"

namespace rois::test {
namespace {

// An interactive bash that has read the completion.
class Shell {
public:
    explicit Shell(std::string const& url) {
        // Binds a key that prints the current line.
        auto const rc = file_with("bashrc", "source '" ROIS_SOURCE_DIR
                                            "/client-cpp/command/completion/rois'\n"
                                            R"(bind -x '"\C-xp": printf "[[%s]]" "$READLINE_LINE"')"
                                            "\nPATH='" ROIS_BINARY_DIR "/bin':$PATH\n");
        process_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
        if (process_ < 0) throw std::runtime_error{"no terminal"};
        if (process_ > 0) return;
        setenv("ROIS_URL", url.c_str(), 1);
        setenv("TERM", "dumb", 1);
        unsetenv("ROIS_SESSION");
        execlp("bash", "bash", "--noprofile", "--rcfile", rc.c_str(), "-i", nullptr);
        _exit(127);
    }
    ~Shell() {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
        close(terminal_);
    }
    Shell(Shell const&) = delete;
    Shell& operator=(Shell const&) = delete;

    // Returns the line with all completions, or the line after another key.
    std::string completed(std::string const& typed, std::string const& key = "\x1b*") {
        auto const keys = "\x15" + typed + key + "\x18p";
        if (write(terminal_, keys.data(), keys.size()) < 0) throw std::runtime_error{"cannot write to the terminal"};
        auto const end = said_until("]]");
        auto const begin = said_.rfind("[[", end) + 2;
        auto line = said_.substr(begin, end - begin);
        said_.clear();
        return line;
    }

private:
    std::size_t said_until(std::string const& text) {
        auto at = said_.find(text);
        while (at == std::string::npos) {
            pollfd ready{terminal_, POLLIN, 0};
            char bytes[4096];
            auto const size = poll(&ready, 1, 20'000) > 0 ? read(terminal_, bytes, sizeof bytes) : 0;
            if (size <= 0) throw std::runtime_error{"no more output from bash after: " + said_};
            said_.append(bytes, static_cast<std::size_t>(size));
            at = said_.find(text);
        }
        return at;
    }

    pid_t process_ = 0;
    int terminal_ = -1;
    std::string said_;
};

TEST(TheCompletion, CompletesCommandsOptionsAndNamesOfTheEngine) {
    Shell shell{shared_gateway().url()};
    struct Row {
        std::string typed;
        std::string completed;
    };
    for (auto const& [typed, completed] : std::vector<Row>{
             {"rois sea", "rois search "},
             {"rois re", "rois record release replay resume "},
             {"rois stop-", "rois stop-all "},
             {"rois resume navi", "rois resume navigation "},
             {"rois --colour a", "rois --colour always auto "},
             {"rois --xml que", "rois --xml query "},
             {"rois start --no", "rois start --no-wait "},
             {"rois bind --w", "rois bind --where "},
             {"rois start navi", "rois start navigation "},
             {"rois query robot_position --of sys", "rois query robot_position --of system_information "},
             {"rois set navigation ", "rois set navigation routing_policy= target_position= time_limit= "},
             {"rois get navigation time", "rois get navigation time_limit "},
             {"rois query eng", "rois query engine_status "},
             {"rois bind navigation --switching re", "rois bind navigation --switching restart "},
             {"rois start --switching abort navi", "rois start --switching abort navigation "},
             {"rois watch person_l", "rois watch person_localized "},
             {"rois watch sw", "rois watch switched "},
             {"rois watch person_localized --start person_loc", "rois watch person_localized --start person_localization "},
             {"rois send " ROIS_SOURCE_DIR "/READ", "rois send " ROIS_SOURCE_DIR "/README.md "},
             {"rois start elev", "rois start elev"},
             {"rois query ", "rois query component_status engine_status get_parameter robot_position "},
             {"rois execute navigation ", "rois execute navigation resume set_parameter start stop suspend "},
             {"rois execute navigation start time", "rois execute navigation start time_limit= "},
             {"rois execute spee", "rois execute speech_recognition speech_synthesis "},
         })
        EXPECT_EQ(shell.completed(typed), completed);
    EXPECT_EQ(shell.completed("rois set navigation time", "\t"), "rois set navigation time_limit=") << "no space at the end";
    EXPECT_EQ(shell.completed("rois watch person_d", "\t"), "rois watch person_detected ");
}

TEST(TheCompletion, UsesTheProgramAndTheEngineOfTheLine) {
    Shell shell{"http://127.0.0.1:1"};
    auto const url = shared_gateway().url();
    for (auto const& begin : {"rois --url " + url, "rois --url=" + url, "rois --http --url '" + url + "'",
                              ROIS_BINARY_DIR "/bin/rois --colour auto --url " + url}) {
        EXPECT_EQ(shell.completed(begin + " start navi"), begin + " start navigation ");
        EXPECT_EQ(shell.completed(begin + " set reaction rea"), begin + " set reaction reaction_ref= ");
    }
    EXPECT_EQ(shell.completed("rois start --url " + url + " navi"), "rois start --url " + url + " navigation ");
    EXPECT_EQ(shell.completed("rois query robot_position --url " + url + " --of sys"),
              "rois query robot_position --url " + url + " --of system_information ");
    EXPECT_EQ(shell.completed("rois --url http://127.0.0.1:2 start navi"), "rois --url http://127.0.0.1:2 start navi");
}

TEST(TheCompletion, IsSilentWithoutAnEngine) {
    Shell shell{"http://127.0.0.1:1"};
    EXPECT_EQ(shell.completed("rois start navi"), "rois start navi");
    EXPECT_EQ(shell.completed("rois heal"), "rois health ");
}

}  // namespace
}  // namespace rois::test
