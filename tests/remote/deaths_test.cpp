// Links, sub engines, their programs and applications fail at random moments: every acknowledged command ends exactly once, and
// no robot acts on when its application or the link to its engine has gone.
#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <set>

#include "remote/two_engines.hpp"

namespace rois {

namespace {

constexpr auto longest_motion = 6s;  // after the link or the application has gone

Part moving(Part part) {
    part.moves = true;
    return part;
}

class Life {
public:
    explicit Life(std::uint32_t seed) : dice_{seed} { open(); }

    void run() {
        for (int step = 0; step < 60 && !testing::Test::HasFailure(); ++step) {
            act();
            pass(std::chrono::milliseconds{50 * (1 + below(one_in(8) ? 120 : 12))});
        }
        engines_.repair();
        engines_.hold_back(false);
        pass(60s);  // the longest pause between two attempts is 30 s
        robot().finishes();
        pass(10s);
        collect();
        for (auto const& id : accepted_) EXPECT_EQ(ended_[id], 1) << id;
        for (auto const& [id, times] : ended_) EXPECT_TRUE(accepted_.contains(id)) << id << " ended, and was never accepted";
        auto const bound = engines_.ask(*desk_, Bind{Application::identifier("hall.navigation")});
        EXPECT_EQ(bound.return_code, ReturnCode::ok) << bound.reason << testing::PrintToString(engines_.reported);
        auto const executed = engines_.execute(*desk_, go("last", "hall.navigation"));
        EXPECT_EQ(executed.return_code, ReturnCode::ok) << executed.reason << testing::PrintToString(engines_.reported);
        EXPECT_TRUE(acts()) << "it works again";
    }

private:
    int below(int end) { return static_cast<int>(dice_() % static_cast<std::uint32_t>(end)); }
    bool one_in(int chances) { return below(chances) == 0; }
    ScriptedComponent& robot() { return engines_.hall["navigation"]; }

    void open() { desk_.emplace(engines_.main.connect()); }

    void act() {
        auto const& desk = *desk_;
        switch (below(13)) {
            case 0:
            case 1:
                begin(Bind{Application::identifier("hall.navigation")});
                break;
            case 2:
            case 3:
            case 4: {
                auto const id = "c" + std::to_string(++commands_);
                begin(Execute{{{go(id, "hall.navigation")}}});
                break;
            }
            case 5: {
                auto const id = "c" + std::to_string(++commands_);
                begin(Execute{{{named(id, stop("hall.navigation"))}}});
                break;
            }
            case 6:
                finishes();
                break;
            case 7:
            case 8:
                engines_.cut();
                break;
            case 9:
                engines_.repair();
                engines_.hold_back(one_in(4));
                break;
            case 10:  // its component leaves, and another one comes
                if (one_in(3)) engines_.hall.change({"navigation"}, {moving(navigation)});
                begins_ = {};
                break;
            case 11:  // its program dies
                if (one_in(3)) engines_.restart_hall();
                begins_ = {};
                break;
            case 12:  // the application ends
                if (!one_in(4)) break;
                collect();
                engines_.main.engine->end(desk.session, engines_.main.now);
                engines_.settle();
                collect();
                open_.clear();
                open();
                break;
        }
    }

    void finishes() {
        if (!acts()) return;
        robot().finishes();
        robot().calls.emplace_back("finished");
    }

    void begin(Operation const& operation) {
        open_.push_back(engines_.main.begin_to_say(desk_->session, operation));
        engines_.settle();
    }

    // The robot was started, and has neither ended nor been halted or suspended since.
    bool acts() {
        auto const& calls = robot().calls;
        auto const last = std::find_if(calls.rbegin(), calls.rend(), [](std::string const& call) {
            return call.starts_with("start") || call == "halt" || call == "suspend" || call == "resume" || call == "finished";
        });
        return last != calls.rend() && (last->starts_with("start") || *last == "resume");
    }

    void pass(std::chrono::milliseconds time) {
        for (auto passed = 0ms; passed < time; passed += 50ms) {
            engines_.advance(50ms);
            collect();
            auto const gone = engines_.is_cut();
            if (!gone || !acts()) {
                begins_.reset();
            } else if (!begins_) {
                begins_ = engines_.main.now.steady;
            } else {
                ASSERT_LE(engines_.main.now.steady - *begins_, longest_motion) << "it acts on without a link";
            }
        }
    }

    void collect() {
        for (auto const& operation : open_) {
            if (!operation->said) continue;
            auto const* reply = std::get_if<Reply>(&*operation->said);
            auto const* executed = reply == nullptr ? nullptr : std::get_if<Execute::Reply>(reply);
            if (executed == nullptr || executed->return_code != ReturnCode::ok) continue;
            for (auto const& id : ids_of(executed->command_unit_list.command_unit_list)) accepted_.insert(id);
        }
        std::erase_if(open_, [](auto const& operation) { return operation->said.has_value(); });
        for (auto const& words : desk_->received()) {
            auto const at = words.find(" completed ");
            if (at == std::string::npos) continue;
            auto const id = words.substr(at + 11, words.rfind(' ') - at - 11);
            ++ended_[id];
        }
    }

    std::mt19937 dice_;
    TwoEngines engines_{{moving(navigation), speech}};
    std::optional<Application> desk_;
    std::vector<std::shared_ptr<TestedOperation>> open_;
    std::set<std::string> accepted_;
    std::map<std::string, int> ended_;
    int commands_ = 0;
    std::optional<Steady> begins_;  // since when it acts without a link
};

}  // namespace

TEST(DeathsOfSubEngines, LoseNoCommandAndLetNothingActOn) {
    auto const* chosen = std::getenv("ROIS_SEED");
    auto const first = chosen == nullptr ? 1U : static_cast<std::uint32_t>(std::stoul(chosen));
    for (auto seed = first; seed < first + (chosen == nullptr ? 1'000U : 1U); ++seed) {
        SCOPED_TRACE("ROIS_SEED=" + std::to_string(seed));
        Life{seed}.run();
        if (HasFailure()) return;
    }
}

}  // namespace rois
