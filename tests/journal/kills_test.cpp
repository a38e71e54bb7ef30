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
#include <string>
#include <thread>
#include <vector>

#include "journal/state_folder.hpp"
#include "kit/gateway_process.hpp"
#include "kit/http_client.hpp"
#include "kit/vocabulary.hpp"

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

// An application that commands one component, and notes what it has sent and received.
class Witness {
public:
    enum class Given : std::uint8_t { unanswered, acknowledged, refused };

    Witness(std::string name, std::string component, Whereabouts& where)
        : name_{std::move(name)}, component_{std::move(component)}, where_{where} {}

    // Uses the gateway until `done`, then reads the remaining notifications.
    void run(std::atomic<bool> const& done) {
        while (!done) attempt([&](HttpClient& gateway) { use(gateway); });
        while (last_ % 2 == 1 || !waiting_.empty())
            attempt([&](HttpClient& gateway) { command(gateway); });  // the last one stops
        for (int tries = 0; tries < 100 && !has_all(); ++tries) attempt([&](HttpClient& gateway) { read(gateway); });
    }

    void expect_promises_kept() const {
        std::map<std::string, int> completions;
        unsigned long expected = 1;
        for (auto const& [sequence, text] : received_) {
            EXPECT_EQ(sequence, expected++) << name_ << ": " << text;
            ++completions[text];
        }
        std::size_t acknowledged = 0;
        for (auto const& [id, given] : given_) {
            auto const count = completions.contains(id) ? completions.at(id) : 0;
            acknowledged += given == Given::acknowledged ? 1 : 0;
            EXPECT_LE(count, given == Given::refused ? 0 : 1) << name_ << ": " << id;
            EXPECT_GE(count, given == Given::acknowledged ? 1 : 0) << name_ << ": " << id;
        }
        EXPECT_GT(acknowledged, 0U) << name_;
        EXPECT_EQ(problems_, std::vector<std::string>{});
    }

    std::size_t acknowledged() const {
        return static_cast<std::size_t>(
            std::ranges::count(given_, Given::acknowledged, [](auto const& each) { return each.second; }));
    }

private:
    // The gateway may die at any moment.
    void attempt(auto const& what) {
        try {
            HttpClient gateway{where_.get()};
            gateway.session = session_;
            struct Keep {
                HttpClient& client;
                ~Keep() { client.session.clear(); }
            } const keep{gateway};
            what(gateway);
        } catch (LineEnded const&) {
            std::this_thread::sleep_for(5ms);
        }
    }

    void use(HttpClient& gateway) {
        if (session_.empty()) {
            if (gateway.call("connect").return_code() != "OK") return;
            session_ = gateway.session;
        }
        if (!is_bound_) {
            auto const answer = gateway.call("bind", component_ref(component_));
            if (answer.status != 200) problems_.push_back(name_ + ": bind: " + answer.body);
            if (answer.return_code() != "OK") return;
            is_bound_ = true;
        }
        for (int i = 0; i < 5; ++i) command(gateway);
        read(gateway);
    }

    // Repeats a command whose answer did not come: it must not run twice.
    void command(HttpClient& gateway) {
        if (waiting_.empty()) {
            waiting_ = name_ + "-" + std::to_string(++last_);
            given_[waiting_] = Given::unanswered;
        }
        auto const answer = gateway.call("execute", sequence(unit(next())));
        bool const was_known = answer.return_code() == "BAD_PARAMETER" && answer.reason().find("is in use") != std::string::npos;
        if (answer.return_code() == "OK" || was_known)
            given_[waiting_] = Given::acknowledged;
        else if (!answer.return_code().empty())
            given_[waiting_] = Given::refused;
        else
            problems_.push_back(name_ + ": execute: " + answer.body);
        if (given_[waiting_] == Given::refused && problems_.size() < 10) problems_.push_back(name_ + ": " + answer.body);
        waiting_.clear();
    }

    // Half of the commands run for longer than the gateway lives.
    Command next() const {
        if (last_ % 2 == 0) return {.component = component_, .type = "stop", .id = waiting_};
        if (component_ == "navigation")
            return {.component = component_, .id = waiting_, .arguments = {target_position({"9000, 2000, 0"})}};
        return {.component = component_, .id = waiting_, .arguments = {speech_text("Good morning, and welcome to the hall.")}};
    }

    void read(HttpClient& gateway) {
        auto const last = received_.empty() ? 0UL : received_.back().first;
        auto const answer = gateway.notifications(static_cast<unsigned>(last), has_all() ? 0 : 1);
        if (answer.status != 200) return problems_.push_back(name_ + ": notifications: " + answer.body);
        for (auto const notification : answer.root().children()) {
            std::string const kind = notification.name();
            auto const id = kind == "completed" ? std::string{notification.child("command_id").text().get()} : kind;
            received_.emplace_back(notification.attribute("sequence").as_ullong(), id);
        }
    }

    bool has_all() const {
        return std::ranges::all_of(given_, [&](auto const& each) {
            return each.second != Given::acknowledged ||
                   std::ranges::find(received_, each.first, [](auto const& one) { return one.second; }) != received_.end();
        });
    }

    std::string const name_;
    std::string const component_;
    Whereabouts& where_;
    std::string session_;
    bool is_bound_ = false;
    std::string waiting_;  // the id of a command without an answer
    unsigned last_ = 0;
    std::map<std::string, Given> given_;
    std::vector<std::pair<unsigned long, std::string>> received_;
    std::vector<std::string> problems_;
};

}  // namespace

TEST(Kills, LoseNothingAndRepeatNothing) {
    auto const kills = number_in("ROIS_KILLS", 5);
    std::mt19937_64 random{number_in("ROIS_SEED", 1)};
    StateFolder const folder;
    Whereabouts where;
    std::vector<std::unique_ptr<Witness>> witnesses;
    for (auto const* component : {"navigation", "speech_synthesis"})
        witnesses.push_back(std::make_unique<Witness>(std::string{component}.substr(0, 3), component, where));
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
    std::size_t acknowledged = 0;
    for (auto const& witness : witnesses) {
        witness->expect_promises_kept();
        acknowledged += witness->acknowledged();
    }
    std::printf("%lu kills, %zu commands acknowledged\n", kills, acknowledged);
}

}  // namespace rois::test
