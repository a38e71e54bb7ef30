// A schedule: clients with roles, an engine with a journal, robots, a sub engine, the disk, the links and the clocks do something
// at random, fail and crash. A schedule depends on its seed alone. The promises of docs/journal.md, docs/trust.md and
// docs/safety.md hold in each of them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "remote/two_engines.hpp"

namespace rois::schedules {

enum class Over : std::uint8_t { one_engine, sub_engine };  // `sub_engine`: half of the robots' components are in one

enum class Role : std::uint8_t {
    operates,
    operates_one,
    observes,
    administrates
};  // `operates_one`: one component, and sees no other

// An operation that was not answered yet.
struct Asked {
    enum class What : std::uint8_t { other, bind, release, start, stop, suspend, resume };
    What what = What::other;
    std::string ref{};
    std::uint64_t number = 0;  // of the command
    std::shared_ptr<TestedOperation> operation{};
};

// A client notes what it was promised, and what it has received.
struct Client {
    Role role;
    std::shared_ptr<Rights const> rights{};
    int turn = 0;  // of its rights
    SessionId session{};
    bool is_stored = false;  // its session
    bool is_linked = false;
    bool is_alive = true;   // answers pings
    Steady silent_since{};  // while it is not linked or not alive
    std::vector<Asked> asked{};
    std::set<std::string> bound{};
    std::set<std::uint64_t> accepted{};  // commands
    std::map<std::uint64_t, int> completed{};
    std::uint64_t last = 0;                             // sequence of the last notification that it has received
    std::map<std::string, std::uint64_t> last_event{};  // by subscription and component
};

// --- What things are called ---

inline char const* name_of(Client const& client) {
    constexpr std::array names{"the operator", "the operator of one", "the observer", "the administrator"};
    return names[static_cast<std::size_t>(client.role)];
}

inline char const* name_of(Asked::What what) {
    constexpr std::array names{"subscribe", "bind", "release", "start", "stop", "suspend", "resume"};
    return names[static_cast<std::size_t>(what)];
}

inline std::string id_of(std::uint64_t command) { return "c" + std::to_string(command); }

inline std::uint64_t number_in(std::string const& text) { return std::stoull(text.substr(text.find_first_of("0123456789"))); }

// Starts a component with the number of the command.
CommandUnit start_of(std::string const& ref, std::uint64_t number);

inline bool is_in_hall(std::string const& ref) { return ref.starts_with("hall."); }

class Schedule {
public:
    // `story`: what happens, for people; null: not needed.
    Schedule(std::uint64_t seed, Over, std::ostream* story = nullptr);

    // Returns the promises that were broken, the first ones only.
    std::vector<std::string> run();

private:
    void act();
    void act_as(Client&);
    void bind(Client&, std::string const& ref, bool take_over);
    static void may_lose(Client&, std::string const& ref);
    void command(Client&, std::string const& ref);
    void happen_to_robot(std::string const& ref);
    void happen_to_disk();
    void happen_to_hall();
    void crash();
    void stop_or_clear();
    void leave_or_return(Client&);
    void lose_rights(Client&);

    void give_rights(Client&);
    void open_session(Client&);
    void forget_session(Client&);
    void begin(Client&, Operation const&, Asked = {});
    void take_answers(bool written);
    void note(Client&, Asked const&, Reply const&, bool written);
    void note(Client&, Numbered const&);
    void read(Client&);

    void write(bool stored);
    void settle();
    void pass(std::chrono::milliseconds);
    void check_motion();
    void watch_robots();
    void robot_called(std::string const& ref, ScriptedComponent const&, std::string const& call);
    void finish();
    void check_that_everything_works();
    template <class... Words>
    void tell(Words const&... words) {
        if (story_ == nullptr) return;
        *story_ << std::chrono::duration_cast<std::chrono::milliseconds>(main().now.steady - begun_).count() << " ms";
        ((*story_ << ' ' << words), ...);
        *story_ << '\n';
    }
    void expect(bool holds, std::string const& promise, std::string const& what = {});

    int below(int end) { return static_cast<int>(dice_() % static_cast<unsigned>(end)); }
    bool one_in(int chances) { return below(chances) == 0; }
    World& main() { return engines_ ? engines_->main : *alone_; }
    Engine& engine() { return *main().engine; }
    MemoryJournal& journal() { return *main().journal; }
    ScriptedComponent& robot(std::string const& ref);

    std::mt19937_64 dice_;
    std::ostream* const story_;
    Steady begun_{};
    std::unique_ptr<World> alone_;  // or
    std::unique_ptr<TwoEngines> engines_;
    std::vector<std::string> refs_;
    std::array<Client, 4> clients_;

    // The motion of a robot, as seen from outside.
    struct Motion {
        std::uint64_t command = 0;  // 0: it stands still
        std::uint64_t suspended = 0;
        Steady unattended_since{};  // without a client that could stop it
    };
    std::map<std::string, Motion> motions_;  // by component

    std::uint64_t last_number_ = 0;  // of commands and events
    struct Command {
        Client* by = nullptr;
        bool has_run = false;
        bool has_finished = false;  // the robot says so
        bool is_refused = false;
    };
    std::map<std::uint64_t, Command> commands_;
    bool is_stopped_ = false;  // everything
    int deaths_ = 0;           // of the engine
    bool disk_has_failed_ = false;
    std::chrono::milliseconds disk_is_slow_for_{0};
    std::vector<std::string> broken_;
};

}  // namespace rois::schedules
