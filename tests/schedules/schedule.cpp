#include "schedules/schedule.hpp"

#include <algorithm>
#include <utility>

#include "types/asking.hpp"

namespace rois::schedules {

namespace {

using Then = MemoryJournal::Then;
using What = Asked::What;

// How long a robot may move without a client that could stop it: the motion lease, and in a sub engine the time to notice
// that the link has gone.
constexpr auto longest_motion = 2'500ms;
constexpr auto longest_motion_in_hall = 6s;

Part moving(Part part) {
    part.moves = true;
    return part;
}

std::vector<Part> robots() { return {moving(navigation), speech}; }

// The number of the command that a component was started with.
std::uint64_t started(ScriptedComponent const& robot) {
    auto const* target = find(robot.started_with, "target_position");
    return number_in((target != nullptr ? target : find(robot.started_with, "speech_text"))->values.at(0));
}

}  // namespace

Schedule::Schedule(std::uint64_t seed, Over over, std::ostream* story)
    : dice_{seed},
      story_{story},
      clients_{Client{.role = Role::operates}, Client{.role = Role::operates_one}, Client{.role = Role::observes},
               Client{.role = Role::administrates}} {
    if (over == Over::sub_engine) {
        engines_ =
            std::make_unique<TwoEngines>(robots(), TwoEngines::hall_settings(), Places{}, std::vector<NamedPlace>{}, robots());
        refs_ = {"navigation", "speech", "hall.navigation", "hall.speech"};
    } else {
        alone_ = std::make_unique<World>(robots(), EngineSettings{});
        refs_ = {"navigation", "speech"};
    }
    begun_ = main().now.steady;
    main().keep_journal();
    main().rights_of = [this](std::string const& id) -> std::shared_ptr<Rights const> {
        auto const client = std::ranges::find_if(clients_, [&](Client const& each) { return each.rights->id() == id; });
        return client == clients_.end() ? nullptr : client->rights;
    };
    for (auto& client : clients_) give_rights(client);
    watch_robots();
    for (auto& client : clients_) open_session(client);
}

std::vector<std::string> Schedule::run() {
    for (int i = 0; i < 60 && broken_.empty(); ++i) act();
    if (broken_.empty()) finish();
    if (engines_)
        for (auto const& line : engines_->reported) tell("the engine about the hall:", line);
    return broken_;
}

void Schedule::expect(bool holds, std::string const& promise, std::string const& what) {
    if (!holds) broken_.push_back(promise + (what.empty() ? "" : ": " + what));
}

ScriptedComponent& Schedule::robot(std::string const& ref) {
    return is_in_hall(ref) ? engines_->hall[ref.substr(5)] : main()[ref];
}

// --- What happens ---

void Schedule::act() {
    auto& client = clients_[static_cast<std::size_t>(below(4))];
    auto const& ref = refs_[static_cast<std::size_t>(below(static_cast<int>(refs_.size())))];
    switch (below(20)) {
        default:
            act_as(client);
            break;
        case 8:
        case 9:
        case 10:
            happen_to_robot(ref);
            break;
        case 11:
        case 12:
        case 13:
            happen_to_disk();
            break;
        case 14:
            leave_or_return(client);
            break;
        case 15:
            if (engines_) happen_to_hall();
            break;
        case 16:
            if (one_in(3)) crash();
            break;
        case 17:
            if (one_in(4)) stop_or_clear();
            break;
        case 18:
            if (one_in(10)) lose_rights(client);
            if (one_in(10)) main().set_calendar(std::chrono::hours{one_in(2) ? 24 : -24});
            break;
        case 19:
            pass(std::chrono::milliseconds{50 * (1 + below(one_in(8) ? 60 : 6))});
            break;
    }
    settle();
    take_answers(false);
}

void Schedule::happen_to_robot(std::string const& ref) {
    auto& acts = robot(ref);
    auto& motion = motions_[ref];
    switch (below(5)) {
        case 0:
            if (ref.ends_with("navigation"))
                acts.fires("reached_target",
                           {text("target", std::to_string(++last_number_)), value("is_final_target", "bool", {"true"})});
            break;
        case 1:
        case 2:
            if (motion.command == 0) break;
            commands_.at(std::exchange(motion.command, 0)).has_finished = true;
            acts.finishes();
            break;
        case 3:
            acts.halts_later = one_in(3);
            break;
        default:
            acts.stands_still();
            break;
    }
}

void Schedule::happen_to_disk() {
    if (one_in(8)) journal().full = journal().full.empty() ? "the disk is full" : "";
    write(!one_in(6));
}

void Schedule::happen_to_hall() {
    auto const what = below(6);
    constexpr std::array words{"the link breaks",      "the link breaks", "answers are late",
                               "it may die or change", "all is well",     "all is well"};
    tell("the hall:", words[static_cast<std::size_t>(what)]);
    switch (what) {
        case 0:
        case 1:
            return engines_->cut();
        case 2:
            return engines_->hold_back(true);
        case 3:
            if (one_in(3)) engines_->restart_hall();
            if (one_in(3)) engines_->hall.change({"navigation"}, {moving(navigation)});  // another robot comes
            return watch_robots();
        default:
            engines_->repair();
            return engines_->hold_back(false);
    }
}

// The process of the engine dies and begins again, and the clients reconnect.
void Schedule::crash() {
    tell("the engine dies");
    ++deaths_;
    take_answers(false);
    bool const was_stopped = is_stopped_;
    for (auto& client : clients_) client.asked.clear();
    if (engines_) {
        engines_->restart_main();
    } else {
        alone_->restart(robots(), {});
        alone_->engine->begin(alone_->now);
    }
    journal().then = Then::later;
    watch_robots();
    expect(engine().everything_is_stopped() || !was_stopped, "a stop of everything survives the death of the process");
    is_stopped_ = engine().everything_is_stopped();
    for (auto& client : clients_)
        if (!client.is_stored && !client.session.text.empty()) forget_session(client);
    for (auto& client : clients_)
        if (client.is_linked) engine().link_opened(client.session, LinkKind::websocket, main().now);
}

void Schedule::stop_or_clear() {
    tell(is_stopped_ ? "the stop is cleared" : "everything is stopped");
    is_stopped_ = !is_stopped_;
    if (!is_stopped_) return main().engine->and_work([&] { engine().clear(); }, main().now);
    main().engine->stop_everything(main().now);
    for (auto const& ref : refs_)
        expect(is_in_hall(ref) || motions_[ref].command == 0, "a stop of everything stops everything", ref);
}

// --- The world ---

// The disk has written what the engine has given, or could not.
void Schedule::write(bool stored) {
    if (!journal().has_waiting()) return;
    take_answers(false);
    tell("the disk", stored ? "writes" : "does not write");
    disk_has_failed_ = disk_has_failed_ || !stored;
    journal().settle(stored);
    auto& engine = *main().engine;
    engine.and_work([&] { stored ? engine.stored(main().now) : engine.not_stored(main().now); }, main().now);
    for (auto& client : clients_) client.is_stored = client.is_stored || stored;
    take_answers(stored);
}

void Schedule::settle() {
    if (engines_) engines_->settle();
}

void Schedule::pass(std::chrono::milliseconds time) {
    for (auto passed = 0ms; passed < time; passed += 50ms) {
        for (auto const& client : clients_)
            if (client.is_linked && client.is_alive) engine().note_pong(client.session, main().now);
        engines_ ? engines_->advance(50ms) : alone_->advance(50ms);
        disk_is_slow_for_ = journal().has_waiting() ? disk_is_slow_for_ + 50ms : 0ms;
        disk_has_failed_ = disk_has_failed_ || disk_is_slow_for_ >= 1s;
        take_answers(false);
        check_motion();
    }
}

void Schedule::check_motion() {
    auto const now = main().now.steady;
    for (auto& [ref, motion] : motions_) {
        if (motion.command == 0 || !ref.ends_with("navigation")) continue;
        auto const& owner = *commands_.at(motion.command).by;
        bool const is_attended = owner.is_linked && owner.is_alive && !(is_in_hall(ref) && engines_->is_cut());
        if (is_attended) motion.unattended_since = now;
        auto const longest = is_in_hall(ref) ? std::chrono::milliseconds{longest_motion_in_hall} : longest_motion;
        expect(now - motion.unattended_since <= longest, "a robot does not move on without a client that can stop it", ref);
    }
}

void Schedule::watch_robots() {
    for (auto const& ref : refs_) {
        auto& component = robot(ref);
        if (component.watch) continue;
        motions_[ref] = {};
        component.watch = [this, ref, &component](std::string const& call) { robot_called(ref, component, call); };
    }
}

void Schedule::robot_called(std::string const& ref, ScriptedComponent const& component, std::string const& call) {
    auto& motion = motions_[ref];
    constexpr std::array told{"start", "halt", "suspend", "resume"};
    if (std::ranges::find(told, call) != told.end()) tell("robot", ref, call, call == "start" ? id_of(started(component)) : "");
    if (call == "start") {
        auto& command = commands_.at(started(component));
        expect(!std::exchange(command.has_run, true), "a command runs once", id_of(started(component)));
        expect(!command.is_refused, "a refused command does not run");
        expect(command.by->role != Role::observes, "an observer moves nothing");
        expect(command.by->rights->commands(ref), "a client moves only what it may command", ref);
        expect(is_in_hall(ref) || !is_stopped_, "nothing begins while everything is stopped", ref);
        motion = {.command = started(component), .unattended_since = main().now.steady};
    } else if (call == "halt") {
        motion = {};
    } else if (call == "suspend" && motion.command != 0) {
        motion.suspended = std::exchange(motion.command, 0);
    } else if (call == "resume" && motion.suspended != 0) {
        motion.command = std::exchange(motion.suspended, 0);
        motion.unattended_since = main().now.steady;
    }
}

// --- The end: everything that failed works again ---

void Schedule::finish() {
    if (engines_) {
        engines_->repair();
        engines_->hold_back(false);
    }
    journal().full.clear();
    for (int i = 0; i < 4; ++i) {
        write(true);
        pass(300ms);
    }
    journal().then = Then::stored;
    main().engine->and_work([] {}, main().now);
    take_answers(true);
    if (is_stopped_) stop_or_clear();
    for (auto& client : clients_) {
        read(client);
        while (!client.is_linked || !client.is_alive) leave_or_return(client);
    }
    journal().then = Then::stored;
    // A stop that it has passed on may stay there until someone clears it, if this engine has died before it could store it.
    if (engines_ && disk_has_failed_ && deaths_ > 0) engines_->hall.engine->clear();
    auto const is_back = [&] { return !engines_ || engines_->shown.is == EngineState::Is::present; };
    for (int i = 0; i < 100 && !is_back(); ++i) pass(700ms);  // the longest pause between two attempts is 30 s
    for (auto const& ref : refs_) {
        robot(ref).halts_later = false;
        robot(ref).stands_still();
    }
    pass(1s);
    check_that_everything_works();
    pass(12s);
    for (auto& client : clients_) {
        read(client);
        for (auto const number : client.accepted)
            expect(client.completed.contains(number), "every command that was accepted completes", id_of(number));
    }
}

// The administrator takes every component, starts it and stops it.
void Schedule::check_that_everything_works() {
    auto& chief = clients_[3];
    auto const ask = [&](Operation const& operation, Asked asked) {
        begin(chief, operation, std::move(asked));
        for (int i = 0; i < 40 && !chief.asked.empty(); ++i) {
            settle();
            take_answers(true);
            if (!chief.asked.empty()) pass(50ms);
        }
        expect(chief.asked.empty(), "every operation is answered");
    };
    for (auto const& ref : refs_) {
        for (auto& client : clients_) may_lose(client, ref);
        auto const bind = [&] {
            ask(Bind{Application::identifier(ref), Switching::none, true}, {.what = What::bind, .ref = ref});
        };
        bind();
        if (is_in_hall(ref) && !chief.bound.contains(ref)) {  // bound in a session there whose id was not stored before a crash
            pass(31s);
            bind();
        }
        auto const number = ++last_number_;
        commands_[number] = {.by = &chief};
        ask(Execute{{{named(id_of(number), start_of(ref, number))}}}, {.what = What::start, .ref = ref, .number = number});
        settle();
        expect(motions_[ref].command == number, "in the end, everything works again", ref);
        auto const last = ++last_number_;
        commands_[last] = {.by = &chief};
        ask(Execute{{{named(id_of(last), stop(ref))}}}, {.what = What::stop, .ref = ref, .number = last});
        settle();
        expect(motions_[ref].command == 0, "in the end, everything can be stopped", ref);
    }
}

}  // namespace rois::schedules
