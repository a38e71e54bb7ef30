#include "engine/journal/recorder.hpp"

#include <algorithm>
#include <iterator>
#include <new>

#include "engine/attempts.hpp"
#include "engine/registry.hpp"
#include "engine/rights.hpp"

namespace rois {

namespace {

constexpr std::chrono::seconds too_long{1};  // for the journal to store changes
constexpr std::chrono::milliseconds between_tries{200};

StoredSession to_store(Session const& session) {
    auto const& terms = session.lease.terms();
    StoredSession stored{.session = session.number,
                         .id = session.id,
                         .rights = session.rights ? session.rights->id() : std::string{},
                         .window = session.window,
                         .lease = terms.linked,
                         .lease_http = terms.http,
                         .links_count = terms.links_count,
                         .is_engine = session.is_engine,
                         .receives_switches = session.receives_switches,
                         .last_stop = session.last_stop,
                         .owns_stop = session.owns_stop,
                         .bindings = session.absent};
    for (auto const* component : session.bound)
        stored.bindings.push_back(
            {component->ref().code, component->switching, component->preference, component->changed_parameters()});
    return stored;
}

StoredCommand to_store(Command const& command) {
    StoredCommand stored{
        .session = command.session_number, .id = command.id, .type = command.type, .ref = command.ref, .end = {}};
    bool const is_asked_for = command.type != "set_parameter";  // its parameters may not have been stored
    if (command.component && is_asked_for) stored.provider = command.component->provider();
    if (!stored.provider.empty()) stored.handle = static_cast<std::uint64_t>(command.handle);
    if (command.state == Command::State::ended)
        stored.end = {.status = command.status,
                      .reason = command.reason,
                      .results = command.results,
                      .at = command.ended_utc,
                      .notified = command.notified};
    return stored;
}

// Requires enough capacity.
void append(auto& to, auto& from) noexcept {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

bool Recorder::Collected::any() const {
    return engine || !sessions.empty() || !with_news.empty() || !commands.empty() || !subscriptions.empty() ||
           !others.ended.empty() || !others.forgotten_commands.empty();
}

void Recorder::Collected::forget(Session& session) {
    sessions.erase(&session);
    with_news.erase(&session);
    std::erase_if(commands, [&](auto const& command) { return command->session == &session || command->session == nullptr; });
    std::erase_if(subscriptions, [&](auto const& each) { return each.first.first == session.number; });
    std::erase_if(others.forgotten_commands, [&](auto const& each) { return each.session == session.number; });
}

// The changes of `earlier` that are still true come before these. A subscription that has ended before it was stored leaves no
// trace.
void Recorder::Collected::add(Collected& earlier) {
    auto const make_room = [](auto& to, auto const& from) { to.reserve(to.size() + from.size()); };
    make_room(others.ended, earlier.others.ended);
    make_room(others.forgotten_commands, earlier.others.forgotten_commands);
    // Nothing below throws.
    for (auto const& [key, before] : earlier.subscriptions)
        if (auto const later = subscriptions.find(key); later != subscriptions.end()) later->second.is_new = before.is_new;
    subscriptions.merge(earlier.subscriptions);
    std::erase_if(subscriptions, [](auto const& each) { return each.second.is_new && !each.second.asked; });
    engine = engine || earlier.engine;
    sessions.merge(earlier.sessions);
    with_news.merge(earlier.with_news);
    commands.merge(earlier.commands);
    append(others.ended, earlier.others.ended);
    append(others.forgotten_commands, earlier.others.forgotten_commands);
    earlier = {};
}

void Recorder::opened(Session& session) {
    bool const can_return = session.rights == nullptr || !session.rights->id().empty();
    if (!is_on() || session.owner != nullptr || !can_return) return;
    session.is_stored = true;
    session.notifications->show_when_stored();
    changed_.sessions.insert(&session);
}

void Recorder::changed(Session& session) {
    if (stores(session)) changed_.sessions.insert(&session);
}

void Recorder::ended(Session& session) {
    if (!stores(session)) return;
    changed_.forget(session);
    given_.forget(session);
    if (session.has_been_stored || is_being_stored_) changed_.others.ended.push_back(session.number);
    session.is_stored = false;
}

void Recorder::subscribed(Session const& session, SubscribeId const& id, Subscribe const& asked, Has has) {
    if (!stores(session)) return;
    Subscribed const subscription{asked, has == Has::subscribed};
    auto const [place, is_first] = changed_.subscriptions.try_emplace({session.number, id.text}, subscription);
    if (!is_first) place->second.asked = asked;
}

void Recorder::unsubscribed(Session const& session, SubscribeId const& id) {
    if (!stores(session)) return;
    auto const place = changed_.subscriptions.try_emplace({session.number, id.text}).first;
    place->second.asked.reset();
    if (place->second.is_new) changed_.subscriptions.erase(place);
}

void Recorder::changed(std::shared_ptr<Command> const& command) {
    if (command->session != nullptr && stores(*command->session)) changed_.commands.insert(command);
}

void Recorder::forgot(Session const& session, std::shared_ptr<Command> const& command) {
    if (!stores(session)) return;
    if (command->has_been_stored || is_being_stored_)
        changed_.others.forgotten_commands.push_back({session.number, command->id.text});
    never_mind(command);
}

std::string Recorder::why_no_commands() const {
    if (!is_on()) return {};
    auto problem = journal_->why_no_commands();
    if (problem.empty() && is_failing_)
        problem = "the journal cannot be written now: no command or subscription begins until it can";
    return problem;
}

void Recorder::when_stored(Then then) { (changed_.any() ? waiting_ : then_).push_back(std::move(then)); }

void Recorder::notify(NotificationQueue& queue) {
    if (!queue.shows_when_stored()) return readers_.notify(queue);
    auto const session = sessions_.find(queue.session());
    if (session == sessions_.end()) return;
    try {
        changed_.with_news.insert(session->second.get());
    } catch (std::bad_alloc const&) {
        news_missed_ = true;
    }
}

void Recorder::add_notifications(Session& session, Changes& changes, std::vector<Shown>& to_show) {
    auto unstored = session.notifications->unstored();
    if (unstored.notifications.empty()) return;
    to_show.push_back({session.notifications, unstored.notifications.back().sequence});
    for (auto const& gone : unstored.gone) changes.forgotten_notifications.push_back({session.number, gone.from, gone.until});
    for (auto& each : unstored.notifications) {
        if (auto const* completed = std::get_if<Completed>(&each.notification->body)) {
            auto const command = session.commands.find(completed->command_id);
            if (command != session.commands.end()) {
                command->second->notified = true;
                changed_.commands.insert(command->second);
            }
        }
        changes.notifications.push_back({session.number, std::move(each)});
    }
}

std::shared_ptr<Changes> Recorder::changes(StoredEngine const& engine, std::vector<Shown>& to_show) {
    auto changes = std::make_shared<Changes>(changed_.others);
    changes->engine = engine;
    if (news_missed_)
        for (auto const& [id, session] : sessions_)
            if (stores(*session)) changed_.with_news.insert(session.get());
    for (auto* session : changed_.with_news) add_notifications(*session, *changes, to_show);
    for (auto const& [key, each] : changed_.subscriptions) {
        if (each.asked)
            changes->subscriptions.push_back({key.first, {key.second}, *each.asked});
        else
            changes->unsubscribed.push_back({key.first, key.second});
    }
    for (auto const* session : changed_.sessions) changes->sessions.push_back(to_store(*session));
    for (auto const& command : changed_.commands) changes->commands.push_back(to_store(*command));
    return changes;
}

void Recorder::give(std::function<StoredEngine()> const& engine) noexcept {
    try {
        changed_.add(given_);  // which could not be stored
        std::vector<Shown> to_show;
        auto all = changes(engine(), to_show);
        then_.reserve(then_.size() + waiting_.size());
        // Nothing below throws.
        for (auto const& each : to_show) each.queue->being_stored(each.until);
        to_show_ = std::move(to_show);
        given_ = std::exchange(changed_, {});
        news_missed_ = false;
        for (auto& then : waiting_) then_.push_back(std::move(then));
        waiting_.clear();
        is_being_stored_ = true;
        since_.reset();
        journal_->store(std::move(all));
    } catch (std::bad_alloc const&) {
        return;
    }
}

void Recorder::call(std::vector<Then> const& list, bool stored, Instant now, Attempts& attempts) {
    for (auto const& then : list) attempts([&] { then(stored, now); });
}

void Recorder::stored(Instant now, Attempts& attempts) {
    is_being_stored_ = is_failing_ = false;
    for (auto* session : given_.sessions) session->has_been_stored = true;
    for (auto const& command : given_.commands) command->has_been_stored = true;
    given_ = {};
    for (auto const& each : std::exchange(to_show_, {}))
        if (each.queue->show(each.until)) attempts([&] { readers_.notify(*each.queue); });
    call(std::exchange(then_, {}), true, now, attempts);
}

void Recorder::not_stored(Instant now, Attempts& attempts) {
    is_being_stored_ = false;
    is_failing_ = true;
    next_try_ = now.steady + between_tries;
    for (auto const& each : std::exchange(to_show_, {})) each.queue->not_stored();
    call(std::exchange(then_, {}), false, now, attempts);
}

void Recorder::look(Instant now, Attempts& attempts) {
    if (next_try_ && now.steady >= *next_try_) next_try_.reset();
    if (is_being_stored_ && !since_) since_ = now.steady;
    if (is_being_stored_ && now.steady - *since_ >= too_long) {
        is_failing_ = true;
        call(std::exchange(then_, {}), false, now, attempts);
    }
    if (is_failing_) call(std::exchange(waiting_, {}), false, now, attempts);
}

}  // namespace rois
