// Schedules of applications, components, a disk and crashes, made at random: the promises of docs/journal.md hold in each of
// them. ROIS_SCHEDULES is the number of schedules, and ROIS_FIRST_SCHEDULE the seed of the first one: a failure names its seed.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <random>
#include <set>

#include "engine/world.hpp"
#include "types/asking.hpp"

namespace rois {

namespace {

using Then = MemoryJournal::Then;

unsigned long number_in(char const* variable, unsigned long otherwise) {
    auto const* const text = std::getenv(variable);
    return text == nullptr ? otherwise : std::stoul(text);
}

// An application that notes what it was promised, and what it has received.
struct Client {
    std::string component;
    SessionId session{};
    bool is_bound = false;
    std::uint64_t last = 0;  // sequence of the last notification that it has received
    struct Given {
        std::shared_ptr<TestedOperation> asked{};
        std::string id{};  // of the command; empty: another operation
        bool binds = false;
        bool releases = false;
    };
    std::vector<Given> open{};  // without an answer
    std::set<std::string> accepted{};
    std::map<std::string, int> completed{};
};

class Schedule {
public:
    explicit Schedule(unsigned long seed) : random_{seed} {
        world_.keep_journal();
        for (auto& client : clients_) client.session = world_.connect().session;
        journal().then = Then::later;
    }

    void run() {
        for (int step = 0; step < 60; ++step) act();
        finish();
        for (auto& client : clients_) {
            for (auto const& [id, times] : client.completed) EXPECT_EQ(times, 1) << id;
            for (auto const& id : client.accepted) EXPECT_EQ(client.completed[id], 1) << id;
        }
    }

private:
    int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }
    Client& one() { return clients_[static_cast<std::size_t>(below(2))]; }
    MemoryJournal& journal() { return *world_.journal; }

    void act() {
        auto& client = one();
        auto& component = world_[client.component];
        switch (below(13)) {
            case 0:
            case 1:
            case 2:
                return execute(client, start_of(client));
            case 3:
                return execute(client, stop(client.component));
            case 4:
                return client.is_bound && below(4) == 0 ? begin(client, Release{ref(client)}, {.releases = true})
                                                        : begin(client, Bind{ref(client)}, {.binds = true});
            case 5:
                return begin(client, Subscribe{"reached_target", {}, false});
            case 6:
                return world_["navigation"].fires("reached_target");
            case 7:
                return component.finishes();
            case 8:
                component.stands_still();
                return read(client);
            case 9:
                return write(below(6) > 0);
            case 10:
                return world_.advance(std::chrono::milliseconds{50 * (1 + below(5))});
            case 11:
                return below(3) == 0 ? change_stop() : read(client);
            default:
                return below(3) == 0 ? die() : read(client);
        }
    }

    static Identifier ref(Client const& client) { return Application::identifier(client.component); }
    static CommandUnit start_of(Client const& client) { return client.component == "navigation" ? go("") : say(""); }

    void begin(Client& client, Operation const& operation, Client::Given given = {}) {
        given.asked = world_.begin_to_say(client.session, operation);
        client.open.push_back(std::move(given));
        take_answers(client, Promised::no);
    }

    void execute(Client& client, CommandUnit unit) {
        auto const id = client.component + std::to_string(++commands_);
        begin(client, Execute{{{named(id, std::move(unit))}}}, {.id = id});
    }

    // An answer that comes before the disk has written is no promise: stops are answered while the journal fails.
    enum class Promised : std::uint8_t { no, yes };
    void take_answers(Client& client, Promised promised) {
        std::erase_if(client.open, [&](Client::Given const& given) {
            if (!given.asked->said) return false;
            auto const* reply = std::get_if<Reply>(&*given.asked->said);
            EXPECT_NE(reply, nullptr) << "the session is gone";
            if (reply == nullptr) return true;
            auto const& outcome = outcome_of(*reply);
            bool const is_ok = outcome.return_code == ReturnCode::ok && promised == Promised::yes;
            if (is_ok && !given.id.empty()) client.accepted.insert(given.id);
            if (given.binds && is_ok) client.is_bound = true;
            if (given.releases) client.is_bound = false;
            return true;
        });
        for (auto const& given : client.open)
            if (given.releases) client.is_bound = false;
    }

    // The disk has written what the engine has given, or could not.
    void write(bool stored) {
        if (!journal().has_waiting()) return;
        for (auto& client : clients_) take_answers(client, Promised::no);
        journal().settle(stored);
        is_written_ = stored;
        world_.engine->and_work([&] { stored ? world_.engine->stored(world_.now) : world_.engine->not_stored(world_.now); },
                                world_.now);
        is_written_ = false;
        for (auto& client : clients_) take_answers(client, stored ? Promised::yes : Promised::no);
    }

    void change_stop() {
        if (stops_ == Stops::no) {
            world_.engine->stop_everything(world_.now);
            stops_ = Stops::asked;
            world_.engine->when_stored([this, stop = ++stops_asked_] {
                if (is_written_ && stops_ == Stops::asked && stop == stops_asked_) stops_ = Stops::promised;
            });
        } else {
            world_.engine->and_work([&] { world_.engine->clear(); }, world_.now);
            stops_ = Stops::no;
        }
    }

    void die() {
        for (auto& client : clients_) take_answers(client, Promised::no);
        bool const was_promised = stops_ == Stops::promised;
        world_.restart({navigation, speech});
        world_.engine->begin(world_.now);
        EXPECT_TRUE(world_.engine->everything_is_stopped() || !was_promised);
        stops_ = world_.engine->everything_is_stopped() ? Stops::promised : Stops::no;
        for (auto& client : clients_) {
            client.open.clear();
            world_.engine->link_opened(client.session, LinkKind::websocket, world_.now);
        }
    }

    void read(Client& client) {
        auto const queue = world_.engine->notifications(client.session);
        ASSERT_NE(queue, nullptr) << "the session is gone";
        for (auto const& [sequence, notification] : queue->read(client.last, 1'000)) {
            EXPECT_EQ(sequence, client.last + 1);
            client.last = sequence;
            if (auto const* completed = std::get_if<Completed>(&notification->body))
                ++client.completed[completed->command_id.text];
        }
    }

    void finish() {
        for (int i = 0; i < 4; ++i) {
            write(true);
            world_.advance(300ms);
        }
        journal().then = Then::stored;
        world_.engine->and_work([] {}, world_.now);
        if (stops_ != Stops::no) change_stop();
        for (auto& client : clients_) {
            take_answers(client, Promised::no);
            world_[client.component].stands_still();
            auto const reply = Application{world_, client.session}.execute(stop(client.component));
            EXPECT_TRUE(reply.return_code == ReturnCode::ok || !client.is_bound) << reply.reason;
        }
        world_.advance(10s);
        for (auto& client : clients_) read(client);
    }

    std::mt19937_64 random_;
    World world_{navigation, speech};
    std::array<Client, 2> clients_{Client{.component = "navigation"}, Client{.component = "speech"}};
    enum class Stops : std::uint8_t { no, asked, promised } stops_ = Stops::no;
    bool is_written_ = false;  // while the engine learns that the disk has written
    unsigned stops_asked_ = 0;
    unsigned commands_ = 0;
};

}  // namespace

TEST(Crashes, BreakNoPromiseInAnySchedule) {
    auto const first = number_in("ROIS_FIRST_SCHEDULE", 1), many = number_in("ROIS_SCHEDULES", 500);
    for (auto seed = first; seed < first + many && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE("ROIS_FIRST_SCHEDULE=" + std::to_string(seed));
        Schedule schedule{seed};
        schedule.run();
    }
}

}  // namespace rois
