// The clients of a schedule: their operations, and the promises and notifications that they get.
#include <algorithm>
#include <utility>

#include "schedules/schedule.hpp"
#include "types/asking.hpp"

namespace rois::schedules {

using Then = MemoryJournal::Then;
using What = Asked::What;

CommandUnit start_of(std::string const& ref, std::uint64_t number) {
    bool const speaks = ref.ends_with("speech");
    auto const value = std::to_string(number);
    return start(ref, {speaks ? text("speech_text", value) : texts("target_position", {value + ", 0, 0"})});
}

void Schedule::act_as(Client& client) {
    if (!client.is_linked || !client.is_alive) return one_in(3) ? leave_or_return(client) : void();
    auto const& ref = refs_[static_cast<std::size_t>(below(static_cast<int>(refs_.size())))];
    switch (below(8)) {
        case 0:
            return bind(client, ref, client.role == Role::administrates && one_in(3));
        case 1:
            if (!one_in(4)) return read(client);
            may_lose(client, ref);
            return begin(client, Release{Application::identifier(ref)}, {.what = What::release, .ref = ref});
        case 2:
            return begin(client, Subscribe{"reached_target", {}, true});
        case 3:
            return read(client);
        default:
            return command(client, ref);
    }
}

void Schedule::bind(Client& client, std::string const& ref, bool take_over) {
    if (take_over)
        for (auto& other : clients_) may_lose(other, ref);
    begin(client, Bind{Application::identifier(ref), Switching::none, take_over}, {.what = What::bind, .ref = ref});
}

// It does not rely on this component any more, also if a binding is still being asked for.
void Schedule::may_lose(Client& client, std::string const& ref) {
    client.bound.erase(ref);
    for (auto& each : client.asked)
        if (each.what == What::bind && each.ref == ref) each.what = What::other;
}

void Schedule::command(Client& client, std::string const& ref) {
    auto const number = ++last_number_;
    commands_[number] = {.by = &client};
    constexpr std::array<What, 8> kinds{What::start, What::start, What::start,   What::start,
                                        What::start, What::stop,  What::suspend, What::resume};
    auto const what = kinds[static_cast<std::size_t>(below(8))];
    auto unit = what == What::start     ? start_of(ref, number)
                : what == What::stop    ? stop(ref)
                : what == What::suspend ? suspend(ref)
                                        : resume(ref);
    begin(client, Execute{{{named(id_of(number), std::move(unit))}}}, {.what = what, .ref = ref, .number = number});
}

void Schedule::give_rights(Client& client) {
    using Patterns = std::vector<std::string>;
    Patterns const one{engines_ ? "hall.*" : "navigation"}, all{"*"};
    auto const& seen = client.role == Role::operates_one ? one : all;
    auto const id = std::to_string(static_cast<int>(client.role)) + "-" + std::to_string(++client.turn);
    client.rights = std::make_shared<Rights const>("client", seen, client.role == Role::observes ? Patterns{} : seen, id);
}

void Schedule::open_session(Client& client) {
    write(true);
    journal().then = Then::stored;
    auto const steps = journal().steps;
    client.session = main().connect_as(client.rights).session;
    client.is_stored = journal().steps > steps;
    journal().then = Then::later;
    tell(name_of(client), "opens a session", client.is_stored ? "" : "that is not stored");
    client.is_linked = client.is_alive = true;
}

void Schedule::forget_session(Client& client) {
    if (client.is_linked || client.is_alive) client.silent_since = main().now.steady;
    client = {.role = client.role,
              .rights = client.rights,
              .turn = client.turn,
              .is_alive = false,
              .silent_since = client.silent_since};
}

void Schedule::leave_or_return(Client& client) {
    if (client.session.text.empty()) return open_session(client);
    if (engine().notifications(client.session, client.rights.get()) == nullptr) return read(client);
    bool const was_there = client.is_linked && client.is_alive;
    if (!client.is_linked) {
        engine().link_opened(client.session, LinkKind::websocket, main().now);
        client.is_linked = client.is_alive = true;
    } else if (one_in(3)) {
        client.is_alive = !client.is_alive;
    } else {
        main().engine->and_work([&] { engine().link_closed(client.session, LinkKind::websocket, Closing::lost, main().now); },
                                main().now);
        client.is_linked = false;
    }
    if (was_there) client.silent_since = main().now.steady;
    tell(name_of(client), !client.is_linked ? "has lost its link" : client.is_alive ? "is there" : "hangs");
}

void Schedule::lose_rights(Client& client) {
    tell(name_of(client), "loses its rights");
    client.rights->withdraw();
    main().engine->end_withdrawn(main().now);
    forget_session(client);
    give_rights(client);
}

void Schedule::begin(Client& client, Operation const& operation, Asked asked) {
    tell(name_of(client), "asks:", name_of(asked.what), asked.ref, asked.number == 0 ? "" : id_of(asked.number));
    asked.operation = main().begin_to_say(client.session, operation);
    client.asked.push_back(std::move(asked));
}

void Schedule::take_answers(bool written) {
    for (auto& client : clients_) {
        auto const come = [](Asked const& each) { return !each.operation->said; };
        std::vector<Asked> const answered = [&] {
            auto const first = std::ranges::stable_partition(client.asked, come).begin();
            std::vector<Asked> taken{first, client.asked.end()};
            client.asked.erase(first, client.asked.end());
            return taken;
        }();
        for (auto const& each : answered) {
            if (auto const* reply = std::get_if<Reply>(&*each.operation->said))
                note(client, each, *reply, written);
            else if (std::get<Refusal>(*each.operation->said) == Refusal::no_session)
                expect(!client.is_linked || !client.is_stored, "a session with a link stays", name_of(client));
        }
    }
}

// An answer before the disk has written is not a promise if it may come while the journal fails.
void Schedule::note(Client& client, Asked const& asked, Reply const& reply, bool written) {
    auto const& outcome = outcome_of(reply);
    tell("answer to", name_of(client), asked.ref, asked.number == 0 ? "" : id_of(asked.number), to_text(outcome.return_code),
         outcome.reason, written ? "(written)" : "");
    bool const is_ok = outcome.return_code == ReturnCode::ok;
    bool const commands = asked.what != What::other && asked.what != What::release;
    if (commands) expect(!is_ok || client.role != Role::observes, "an observer commands nothing");
    if (asked.number != 0) {
        auto& command = commands_.at(asked.number);
        command.is_refused = !is_ok;
        expect(is_ok || !command.has_run, "a refused command does not run", outcome.reason);
        bool const acts_at_once = asked.what == What::stop || asked.what == What::suspend;
        if (is_ok && (written || !acts_at_once)) client.accepted.insert(asked.number);
        if (asked.what == What::stop) expect(outcome.return_code != ReturnCode::out_of_resources, "a full disk refuses no stop");
    }
    if (asked.what != What::bind || !is_ok || !written) return;
    for (auto const& other : clients_)
        expect(&other == &client || is_in_hall(asked.ref) || !other.bound.contains(asked.ref), "one client binds a component",
               asked.ref);
    client.bound.insert(asked.ref);
}

void Schedule::read(Client& client) {
    auto const queue = client.session.text.empty() ? nullptr : engine().notifications(client.session, client.rights.get());
    if (queue == nullptr) {
        expect(client.session.text.empty() || !client.is_linked || !client.is_stored, "a session with a link stays",
               name_of(client));
        return forget_session(client);
    }
    for (auto const& each : queue->read(client.last, 1'000)) note(client, each);
}

void Schedule::note(Client& client, Numbered const& numbered) {
    auto const& [sequence, notification] = numbered;
    auto const* lost = std::get_if<Lost>(&notification->body);
    expect(sequence == client.last + (lost == nullptr ? 1 : lost->count), "notifications have consecutive numbers",
           std::to_string(sequence));
    client.last = sequence;
    if (auto const* completed = std::get_if<Completed>(&notification->body)) {
        tell(name_of(client), "receives", sequence, "completed", completed->command_id.text, to_text(completed->status));
        auto const number = number_in(completed->command_id.text);
        auto const& command = commands_.at(number);
        expect(command.by == &client, "a completion is for the client whose command it is", completed->command_id.text);
        expect(++client.completed[number] == 1, "a command completes once", completed->command_id.text);
        bool const is_abort = completed->status == CompletedStatus::abort;
        expect(!command.is_refused || is_abort, "a refused command is at most aborted, after a crash",
               completed->command_id.text);
        bool const says_done = completed->status == CompletedStatus::ok && command.has_run;
        expect(!says_done || command.has_finished, "a start is OK when the robot has finished", completed->command_id.text);
    } else if (auto const* event = std::get_if<ReceiveEvent>(&notification->body)) {
        expect(client.rights->sees(event->component_ref.code), "a client hears only of what it may see",
               event->component_ref.code);
        auto const number = number_in(find(event->results->parameters, "target")->values.at(0));
        auto& last = client.last_event[event->subscribe_id.text + " " + event->component_ref.code];
        expect(number > last, "events come in their order, and once", std::to_string(number) + " after " + std::to_string(last));
        last = number;
    }
}

}  // namespace rois::schedules
