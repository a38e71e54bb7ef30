// The component programs that this gateway starts for sub engines that join (the key `command` of the engines file).
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rois::remote {

struct ProgramTimes {
    std::chrono::milliseconds shortest_pause{1'000};  // before a program is started again; doubled each time
    std::chrono::milliseconds longest_pause{60'000};  // also: a program that has run longer restarts with the shortest
    std::chrono::milliseconds immediately{5'000};     // a program is given up after five ends within this time of its start
    std::chrono::milliseconds to_end{2'000};          // from SIGTERM to SIGKILL; part of docs/safety.md#the-end
};

// Starts each program again when it has ended, and ends all of them with this process. Thread-safe.
class Programs {
public:
    struct Wanted {
        std::string name;                  // of the sub engine
        std::vector<std::string> command;  // the program, and its arguments
        std::string folder;                // in which it runs
        std::string url;                   // of the gateway that it joins: its variable ROIS_URL
        std::string joins;                 // the name by which it joins: its variable ROIS_NAME

        bool operator==(Wanted const&) const = default;
    };
    // Called on the thread of the programs. Lines of a program's output, and what happens to it.
    struct Listener {
        std::function<void(std::string const& name, std::string const& line)> says;
        std::function<void(std::string const& name, std::string const& what)> happens;
        // Makes a token with which the program joins: its variable ROIS_TOKEN. Called before each start. Empty: it needs none.
        std::function<std::string(std::string const& name)> token = [](std::string const&) { return std::string{}; };
    };

    explicit Programs(Listener, ProgramTimes = {});
    // Ends all programs: with SIGTERM, and later with SIGKILL. Waits for that.
    ~Programs();
    Programs(Programs const&) = delete;
    Programs& operator=(Programs const&) = delete;

    // Sets the programs. Programs with unchanged settings keep running. A program that was given up is started again.
    void set(std::vector<Wanted>);

private:
    class All;
    std::unique_ptr<All> all_;
};

}  // namespace rois::remote
