// Kills the gateway again and again while applications use it. What they have received must keep the promises of docs/journal.md:
// the checks read only their own records. ROIS_KILLS sets how often it is killed, and ROIS_SEED when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
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
        if (given_[waiting_] != Given::acknowledged && problems_.size() < 10)
            problems_.push_back(component_ + ": execute: " + answer.whole);
        waiting_.clear();
    }

    // Half of the commands run for longer than the gateway lives.
    Command next() const {
        if (last_ % 2 == 0) return {.component = component_, .type = "stop", .id = waiting_};
        if (component_ == "navigation")
            return {.component = component_, .id = waiting_, .arguments = {target_position({"9000, 2000, 0"})}};
        if (component_ == "speech_synthesis")
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

}  // namespace

TEST(Kills, LoseNothingAndRepeatNothing) {
    auto const kills = number_in("ROIS_KILLS", 5);
    std::mt19937_64 random{number_in("ROIS_SEED", 1)};
    StateFolder const folder;
    Whereabouts where;
    std::vector<std::unique_ptr<Witness>> witnesses;
    for (auto const& [component, transport] : {std::pair{"navigation", Transport::http},
                                               {"speech_synthesis", Transport::http},
                                               {"person_detection", Transport::websocket},
                                               {"sound_detection", Transport::websocket}})
        witnesses.push_back(std::make_unique<Witness>(component, transport, where));
    std::atomic<bool> done = false;
    auto gateway = std::make_unique<GatewayProcess>(folder.arguments());
    where.set(gateway->address());
    std::vector<std::jthread> threads;
    for (auto const& witness : witnesses) threads.emplace_back([&] { witness->run(done); });
    for (unsigned long kill = 0; kill < kills; ++kill) {
        std::this_thread::sleep_for(std::chrono::microseconds{std::uniform_int_distribution{20'000, 300'000}(random)});
        gateway->signal(SIGKILL);
        gateway->wait();
        gateway = std::make_unique<GatewayProcess>(folder.arguments());
        where.set(gateway->address());
    }
    std::this_thread::sleep_for(100ms);
    done = true;
    threads.clear();
    std::size_t acknowledged = 0, others = 0;
    for (auto const& witness : witnesses) {
        witness->expect_promises_kept();
        acknowledged += witness->acknowledged();
        others += witness->others();
    }
    std::printf("%lu kills, %zu commands acknowledged, %zu events and errors\n", kills, acknowledged, others);
}

}  // namespace rois::test
