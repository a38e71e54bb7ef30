// Links and applications end at random moments: no motion lasts longer than its lease (decision 33), however badly the component
// behaves.

#include <algorithm>
#include <random>
#include <stdexcept>

#include "engine/world.hpp"

namespace rois {

namespace {

class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_{seed} {}

    int below(int end) { return static_cast<int>(engine_() % static_cast<std::uint32_t>(end)); }
    bool one_in(int chances) { return below(chances) == 0; }
    std::chrono::milliseconds time(std::chrono::milliseconds most) {
        return std::chrono::milliseconds{below(static_cast<int>(most.count()))};
    }

private:
    std::mt19937 engine_;
};

// Moves on command, with faults: throws halfway, confirms late, ends by itself.
class Mover final : public LocalComponent {
public:
    Mover(std::string const& ref, Dice& dice) : dice_{dice} {
        description_.ref.code = ref;
        description_.profile = std::make_shared<ComponentProfile>(navigation.profile);
        description_.moves = true;
        description_.provider = "stage";
        description_.returns_at_once = true;
    }

    bool moves() const { return moves_; }

    // Called once a tick.
    void live() {
        if (ticks_to_halt_ > 0) {
            --ticks_to_halt_;
            if (ticks_to_halt_ == 0) {
                moves_ = false;
                confirm_halt();
            }
        }
        if (moves_ && dice_.one_in(200)) {
            moves_ = false;
            port().completed(command_, dice_.one_in(2) ? CompletedStatus::ok : CompletedStatus::error);
        }
    }

    ComponentDescription const& description() const override { return description_; }
    ComponentStatus status() const override { return ComponentStatus::ready; }
    Prepared prepare(std::string_view command_type, ParameterList const&) override {
        if (command_type == "set_parameter") return [](CommandHandle, Instant) {};
        return [this](CommandHandle command, Instant) { begin(command); };
    }
    void resume(Instant) override { begin(command_); }
    void suspend(Instant) override {
        fail_at_times();
        moves_ = false;
    }
    Halted halt(Instant) override {
        fail_at_times();
        if (moves_ && ticks_to_halt_ == 0 && dice_.one_in(3)) ticks_to_halt_ = 1 + dice_.below(3);
        moves_ = ticks_to_halt_ > 0;
        return moves_ ? Halted::not_yet : Halted::confirmed;
    }

private:
    void begin(CommandHandle command) {
        command_ = command;
        moves_ = true;
        fail_at_times();
        if (!dice_.one_in(20)) port().started(command);
    }
    // At most twice in a row.
    void fail_at_times() {
        failures_ = failures_ < 2 && dice_.one_in(6) ? failures_ + 1 : 0;
        if (failures_ > 0) throw std::runtime_error("it was a bad moment");
    }

    Dice& dice_;
    ComponentDescription description_;
    CommandHandle command_{};
    bool moves_ = false;
    int ticks_to_halt_ = 0;  // while it halts; 0: it does not
    int failures_ = 0;       // in a row
};

// An application that sends random commands during its life. Its link breaks now and then, and may come back. It asks for leases
// of 2 s on any link.
class Mortal {
public:
    enum class Way : std::uint8_t { websocket, stream, requests };

    Mortal(World& world, Dice& dice, std::vector<std::string> refs)
        : world_{world}, dice_{dice}, refs_{std::move(refs)}, way_{static_cast<Way>(dice.below(3))}, dies_{dice.time(6'000ms)} {
        Connect const asked{.motion_lease = 2'000ms, .motion_lease_http = 2'000ms, .motion_proof = {}};
        session_ = std::get<Connect::Reply>(std::get<Reply>(world_.say({}, asked))).session;
        if (way_ != Way::requests) world_.engine->link_opened(session_, link(), world_.now);
    }

    std::vector<std::string> const& refs() const { return refs_; }
    bool lives() const { return !died_; }
    // When the engine last received a sign of life.
    Steady last_sign_of_life() const { return last_sign_of_life_; }

    void live(std::chrono::milliseconds passed) {
        if (died_) return;
        dies_ -= passed;
        if (dies_ <= 0ms) return die();
        if (is_cut() && (cut_for_ -= passed) <= 0ms) reconnect();
        if (is_cut()) return;
        last_sign_of_life_ = world_.now.steady;
        if (dice_.one_in(100)) return cut();
        if (way_ == Way::websocket) world_.engine->note_pong(session_, world_.now);
        if (way_ == Way::requests || dice_.one_in(10)) act();
    }

private:
    LinkKind link() const { return way_ == Way::websocket ? LinkKind::websocket : LinkKind::stream; }

    void die() {
        died_ = true;
        if (is_cut()) return;
        if (dice_.one_in(10))
            world_.say(session_, Disconnect{});
        else
            break_link();
    }

    // The system closes a broken stream when its probes are not answered: here at once. A WebSocket falls silent, or closes.
    void break_link() {
        closed_ = way_ == Way::stream || (way_ == Way::websocket && dice_.one_in(2));
        if (closed_) world_.engine->link_closed(session_, link(), Closing::lost, world_.now);
    }

    bool is_cut() const { return cut_for_ > 0ms; }
    void cut() {
        cut_for_ = 1ms + dice_.time(4'000ms);
        break_link();
    }
    void reconnect() {
        if (closed_) world_.engine->link_opened(session_, link(), world_.now);
        closed_ = false;
    }

    void act() {
        auto const ref = refs_[static_cast<std::size_t>(dice_.below(static_cast<int>(refs_.size())))];
        auto const id = Application::identifier(ref);
        switch (dice_.below(12)) {
            case 0:
                return say(Release{id});
            case 1:
                return command(stop(ref));
            case 2:
                return command(suspend(ref));
            case 3:
                return command(resume(ref));
            case 4:
                say(Bind{id});
                return command(after(dice_.time(4'000ms), go("", ref)));
            case 5:
                say(Bind{id});
                return command(in_sequence({rois::command("dock", ref), pause(dice_.time(1'500ms)), go("", ref)}));
            case 6:
                return command(rois::command("dock", ref));
            case 7:
            case 8:
                say(Bind{id});
                return command(go("", ref));
            default:
                return say(Search{});
        }
    }
    void command(CommandUnit unit) { say(Execute{{{std::move(unit)}}}); }
    void say(Operation const& operation) { world_.begin_to_say(session_, operation); }  // the answer may come later

    World& world_;
    Dice& dice_;
    std::vector<std::string> refs_;
    Way way_;
    std::chrono::milliseconds dies_;
    SessionId session_;
    Steady last_sign_of_life_;
    bool died_ = false;
    std::chrono::milliseconds cut_for_{0};  // until its link comes back
    bool closed_ = false;                   // its link
};

// The longest motion after the last sign of life of the only application that can command it.
std::chrono::nanoseconds longest_unproven_motion(std::uint32_t seed, int& moved) {
    Dice dice{seed};
    World world{std::vector<Part>{}, EngineSettings{}};
    std::vector<Mover*> movers;
    for (auto const* ref : {"base", "arm", "chair"}) {
        auto mover = std::make_unique<Mover>(ref, dice);
        movers.push_back(mover.get());
        world.engine->add(std::move(mover));
    }
    std::vector<Mortal> mortals;
    mortals.emplace_back(world, dice, std::vector<std::string>{"base"});
    mortals.emplace_back(world, dice, std::vector<std::string>{"arm", "chair"});
    auto const commander = [&](Mover const& mover) -> Mortal const& {
        return mortals[mover.description().ref.code == "base" ? 0 : 1];
    };
    std::chrono::nanoseconds longest{0};
    auto const is_over = [&](Mortal const& mortal) {
        return !mortal.lives() && world.now.steady >= mortal.last_sign_of_life() + 3s;
    };
    while (!std::ranges::all_of(mortals, is_over)) {
        auto const passed = 10ms + dice.time(40ms);
        world.now = world.now + passed;
        for (auto& mortal : mortals) mortal.live(passed);
        world.happen([&] {
            for (auto* mover : movers) mover->live();
        });
        for (auto const* mover : movers) {
            if (!mover->moves()) continue;
            ++moved;
            longest = std::max(longest, world.now.steady - commander(*mover).last_sign_of_life());
        }
    }
    return longest;
}

}  // namespace

TEST(Deaths, OfLinksAndApplicationsEndTheirMotion) {
    int moved = 0;
    for (std::uint32_t seed = 1; seed <= 10'000; ++seed)
        ASSERT_LE(longest_unproven_motion(seed, moved), 2'500ms) << "with the seed " << seed;
    EXPECT_GT(moved, 1'000'000) << "otherwise the test proves little";
}

}  // namespace rois
