// Kills the gateway again and again while applications use it. What they have received must keep the promises of docs/journal.md:
// the checks read only their own records. ROIS_KILLS sets how often it is killed, and ROIS_SEED when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "journal/state_folder.hpp"
#include "kit/application.hpp"
#include "kit/gateway_process.hpp"
#include "kit/http_client.hpp"
#include "kit/websocket_client.hpp"

namespace rois::test {

namespace {

using namespace kit;
using namespace std::chrono_literals;

unsigned long number_in(char const* variable, unsigned long otherwise) {
    auto const* const text = std::getenv(variable);
    return text == nullptr ? otherwise : std::stoul(text);
}

// Where the gateway listens at present.
class Whereabouts {
public:
    Address get() {
        std::lock_guard const lock{mutex_};
        return address_;
    }
    void set(Address address) {
        std::lock_guard const lock{mutex_};
        address_ = std::move(address);
    }

private:
    std::mutex mutex_;
    Address address_;
};

struct Answer {
    std::string return_code, reason, whole;
};

// The notifications that an application has received: sequence and command id, or another kind.
using Received = std::vector<std::pair<unsigned long, std::string>>;

void note(pugi::xml_node notification, Received& received) {
    std::string const kind = notification.name();
    auto const id = kind == "completed" ? std::string{notification.child("command_id").text().get()} : kind;
    received.emplace_back(notification.attribute("sequence").as_ullong(), id);
}

// One connection of an application to the gateway, for as long as it lasts. All functions throw LineEnded when it ends.
class Dialogue {
public:
    virtual ~Dialogue() = default;

    virtual Answer call(std::string const& operation, Xml const& children = {}) = 0;
    // Reads the notifications that have arrived, or waits a second for more.
    virtual void read(Received&, bool waits) = 0;
    virtual std::string connect() = 0;  // returns the session
};

class OverHttp : public Dialogue {
public:
    OverHttp(Address const& address, std::string const& session) : gateway_{address} { gateway_.session = session; }
    ~OverHttp() override { gateway_.session.clear(); }

    Answer call(std::string const& operation, Xml const& children) override {
        auto const answer = gateway_.call(operation, children);
        return {answer.return_code(), answer.reason(), answer.body};
    }
    void read(Received& received, bool waits) override {
        auto const last = received.empty() ? 0UL : received.back().first;
        auto const answer = gateway_.notifications(static_cast<unsigned>(last), waits ? 1 : 0);
        EXPECT_EQ(answer.status, 200) << answer.body;
        for (auto const notification : answer.root().children()) note(notification, received);
    }
    std::string connect() override { return gateway_.call("connect").return_code() == "OK" ? gateway_.session : ""; }

private:
    HttpClient gateway_;
};

// Resumes the session. Notifications may come before any answer.
class OverWebSocket : public Dialogue {
public:
    OverWebSocket(Address const& address, std::string const& session, Received& received)
        : gateway_{address}, received_{received} {
        gateway_.line().set_patience(1s);
        if (session.empty()) return;
        gateway_.keep_session();
        auto const last = received.empty() ? 0UL : received.back().first;
        gateway_.ask("resume", "", {{"session", session}, {"last_sequence", std::to_string(last)}});
        auto const answer = response();
        EXPECT_EQ(answer.return_code, "OK") << answer.whole;
    }
    ~OverWebSocket() override { gateway_.keep_session(); }

    Answer call(std::string const& operation, Xml const& children) override {
        gateway_.ask(operation, children);
        return response();
    }
    void read(Received&, bool waits) override {
        if (waits) note(gateway_.next_document(), received_);
    }
    std::string connect() override {
        auto const answer = gateway_.call("connect");
        std::string session = answer.child("session").text().get();
        gateway_.keep_session();
        return session;
    }

private:
    Answer response() {
        while (true) {
            auto const document = gateway_.next_document();
            if (document.attribute("sequence")) {
                note(document, received_);
                continue;
            }
            std::ostringstream whole;
            document.print(whole);
            return {document.attribute("return_code").value(), document.child("reason").text().get(), whole.str()};
        }
    }

    WebSocketClient gateway_;
    Received& received_;
};

// An application that commands one component, and notes what it has sent and received.
class Witness {
public:
    enum class Given : std::uint8_t { unanswered, acknowledged, refused };

    Witness(std::string component, Transport transport, Whereabouts& where)
        : component_{std::move(component)}, transport_{transport}, where_{where} {}

    // Uses the gateway until `done`, then reads the remaining notifications.
    void run(std::atomic<bool> const& done) {
        while (!done) attempt([&](Dialogue& gateway) { use(gateway); });
        while (last_ % 2 == 1 || !waiting_.empty()) attempt([&](Dialogue& gateway) { command(gateway); });  // the last one stops
        for (int tries = 0; tries < 100 && !has_all(); ++tries)
            attempt([&](Dialogue& gateway) { gateway.read(received_, true); });
    }

    void expect_promises_kept() const {
        std::map<std::string, int> completions;
        unsigned long expected = 1;
        for (auto const& [sequence, text] : received_) {
            EXPECT_EQ(sequence, expected++) << component_ << ": " << text;
            ++completions[text];
        }
        for (auto const& [id, given] : given_) {
            auto const count = completions.contains(id) ? completions.at(id) : 0;
            EXPECT_LE(count, given == Given::refused ? 0 : 1) << component_ << ": " << id;
            EXPECT_GE(count, given == Given::acknowledged ? 1 : 0) << component_ << ": " << id;
        }
        EXPECT_GT(acknowledged(), 0U) << component_;
        EXPECT_EQ(problems_, std::vector<std::string>{});
    }

    std::size_t acknowledged() const {
        return static_cast<std::size_t>(
            std::ranges::count(given_, Given::acknowledged, [](auto const& each) { return each.second; }));
    }

    // The commands that may have begun.
    std::size_t starts() const { return (last_ + 1) / 2; }

    // The notifications that are not the end of a command.
    std::size_t others() const { return received_.size() - acknowledged(); }

private:
    // The gateway may die at any moment.
    void attempt(auto const& what) {
        try {
            if (transport_ == Transport::http) {
                OverHttp gateway{where_.get(), session_};
                what(gateway);
            } else {
                OverWebSocket gateway{where_.get(), session_, received_};
                what(gateway);
            }
        } catch (LineEnded const&) {
            std::this_thread::sleep_for(5ms);
        }
    }

    void use(Dialogue& gateway) {
        if (session_.empty()) session_ = gateway.connect();
        if (session_.empty()) return;
        if (!is_bound_) {
            auto const answer = gateway.call("bind", component_ref(component_));
            if (answer.return_code.empty()) problems_.push_back(component_ + ": bind: " + answer.whole);
            if (answer.return_code != "OK") return;
            if (transport_ == Transport::websocket) gateway.call("subscribe", text_element("event_type", "person_detected"));
            is_bound_ = true;
        }
        for (int i = 0; i < 5; ++i) command(gateway);
        gateway.read(received_, !has_all());
    }

    // Repeats a command whose answer did not come: it must not run twice.
    void command(Dialogue& gateway) {
        if (waiting_.empty()) {
            waiting_ = component_ + "-" + std::to_string(++last_);
            given_[waiting_] = Given::unanswered;
        }
        auto const answer = gateway.call("execute", sequence(unit(next())));
        bool const was_known = answer.return_code == "BAD_PARAMETER" && answer.reason.find("is in use") != std::string::npos;
        if (answer.return_code == "OK" || was_known)
            given_[waiting_] = Given::acknowledged;
        else if (!answer.return_code.empty())
            given_[waiting_] = Given::refused;
        if (given_[waiting_] == Given::refused && is_of_sub_engine_)
            is_bound_ = false;  // the sub engine may be away
        else if (given_[waiting_] != Given::acknowledged && problems_.size() < 10)
            problems_.push_back(component_ + ": execute: " + answer.whole);
        waiting_.clear();
    }

    // Half of the commands run for longer than the gateway lives.
    Command next() const {
        if (last_ % 2 == 0) return {.component = component_, .type = "stop", .id = waiting_};
        if (component_.ends_with("navigation"))
            return {.component = component_, .id = waiting_, .arguments = {target_position({"9000, 2000, 0"})}};
        if (component_.ends_with("speech_synthesis"))
            return {
                .component = component_, .id = waiting_, .arguments = {speech_text("Good morning, and welcome to the hall.")}};
        return {.component = component_, .id = waiting_};
    }

    bool has_all() const {
        return std::ranges::all_of(given_, [&](auto const& each) {
            return each.second != Given::acknowledged ||
                   std::ranges::find(received_, each.first, [](auto const& one) { return one.second; }) != received_.end();
        });
    }

    std::string const component_;
    bool const is_of_sub_engine_ = component_.find('.') != component_.npos;
    Transport const transport_;
    Whereabouts& where_;
    std::string session_;
    bool is_bound_ = false;
    std::string waiting_;  // the id of a command without an answer
    unsigned last_ = 0;
    std::map<std::string, Given> given_;
    Received received_;
    std::vector<std::string> problems_;
};

// Kills one of the gateways `kills` times, while the witnesses use the first one.
class Hall {
public:
    // `arguments`: of each gateway.
    explicit Hall(std::vector<std::vector<std::string>> arguments) : arguments_{std::move(arguments)} {
        for (auto const& each : arguments_) gateways_.push_back(std::make_unique<GatewayProcess>(each));
        where_.set(gateways_.front()->address());
    }

    void add(std::string component, Transport transport) {
        witnesses_.push_back(std::make_unique<Witness>(std::move(component), transport, where_));
    }

    void play() {
        auto const kills = number_in("ROIS_KILLS", 5);
        std::mt19937_64 random{number_in("ROIS_SEED", 1)};
        std::atomic<bool> done = false;
        std::vector<std::jthread> threads;
        for (auto const& witness : witnesses_) threads.emplace_back([&] { witness->run(done); });
        for (unsigned long kill = 0; kill < kills; ++kill) {
            std::this_thread::sleep_for(std::chrono::microseconds{std::uniform_int_distribution{20'000, 300'000}(random)});
            auto const which = std::uniform_int_distribution<std::size_t>{0, gateways_.size() - 1}(random);
            auto& gateway = gateways_[which];
            gateway->signal(SIGKILL);
            logs_ += gateway->wait().error;
            gateway = std::make_unique<GatewayProcess>(arguments_[which]);
            if (which == 0) where_.set(gateway->address());
        }
        std::this_thread::sleep_for(100ms);
        done = true;
        threads.clear();
        std::size_t acknowledged = 0, others = 0;
        for (auto const& witness : witnesses_) {
            witness->expect_promises_kept();
            acknowledged += witness->acknowledged();
            others += witness->others();
        }
        std::printf("%lu kills, %zu commands acknowledged, %zu events and errors\n", kills, acknowledged, others);
    }

    std::vector<std::unique_ptr<Witness>> const& witnesses() const { return witnesses_; }

    // Ends all gateways, and returns the logs of all that ever ran.
    std::string logs() {
        for (auto& gateway : gateways_) {
            gateway->signal(SIGTERM);
            logs_ += gateway->wait().error;
        }
        gateways_.clear();
        return logs_;
    }

private:
    std::vector<std::vector<std::string>> arguments_;
    std::vector<std::unique_ptr<GatewayProcess>> gateways_;
    std::string logs_;
    Whereabouts where_;
    std::vector<std::unique_ptr<Witness>> witnesses_;
};

}  // namespace

TEST(Kills, LoseNothingAndRepeatNothing) {
    StateFolder const folder;
    Hall hall{{folder.arguments()}};
    hall.add("navigation", Transport::http);
    hall.add("speech_synthesis", Transport::http);
    hall.add("person_detection", Transport::websocket);
    hall.add("sound_detection", Transport::websocket);
    hall.play();
}

// Either engine is killed. What an application commands runs in the sub engine.
TEST(Kills, LoseNothingOfASubEngineAndRepeatNothingThere) {
    StateFolder const folder, folder_of_robot;
    auto const port = std::to_string(20'000 + ::getpid() % 10'000);  // the system gives none of these to other sockets
    auto const engines = folder.name() + ".json";
    std::ofstream{engines} << R"({"engines": [{"name": "robot1", "url": "ws://127.0.0.1:)" << port << R"("}]})";
    Hall hall{{{"--state", folder.name(), "--robots", "none", "--engines", engines},
               {"--state", folder_of_robot.name(), "--listen", "127.0.0.1:" + port, "--log-level", "debug"}}};
    std::array const components{"navigation", "speech_synthesis", "person_detection", "sound_detection"};
    for (std::string const name : components)
        hall.add("robot1." + name, name.ends_with("detection") ? Transport::websocket : Transport::http);
    hall.play();
    auto const logs = hall.logs();
    bool const few = number_in("ROIS_KILLS", 5) < 50;  // then not each component may have begun on a busy machine
    std::size_t all = 0;
    for (std::size_t i = 0; i < components.size(); ++i) {
        auto const began = "start of " + std::string{components[i]} + ", begins";
        std::size_t times = 0;
        for (auto at = logs.find(began); at != logs.npos; at = logs.find(began, at + 1)) ++times;
        all += times;
        EXPECT_TRUE(few || times > 0) << began;
        EXPECT_LE(times, hall.witnesses()[i]->starts()) << began;
    }
    EXPECT_GT(all, 0U);
    std::filesystem::remove(engines);
}

}  // namespace rois::test
