// A world for the engine's tests: scripted components, a clock that the test advances, and applications.
//     World world{navigation, speech};
//     auto desk = world.connect();
//     desk.bind("navigation");
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/parts.hpp"
#include "engine/working_engine.hpp"
#include "types/messages.hpp"

namespace rois {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class World;

// A service application with its own session. It reads its notifications when the test asks for them.
class Application {
public:
    Application(World& world, SessionId session, Rights const* = nullptr);

    SessionId session;

    // Returns the answer to an operation. The test fails if it was refused before it was performed.
    template <class Operation>
    typename Operation::Reply ask(Operation operation);

    // Returns nullopt if the operation was performed.
    std::optional<Refusal> refusal_of(Operation const&);

    ReturnCode bind(std::string const& ref) { return ask(Bind{identifier(ref)}).return_code; }
    ReturnCode release(std::string const& ref) { return ask(Release{identifier(ref)}).return_code; }
    std::string bind_any(QueryExpression condition = {});  // returns the ref, or the return code
    std::vector<std::string> search(QueryExpression condition = {});
    void leave() { ask(Disconnect{}); }

    SetParameter::Reply set_parameter(std::string const& ref, ParameterList parameters);
    GetParameter::Reply get_parameter(std::string const& ref) { return ask(GetParameter{identifier(ref)}); }

    template <class... Units>
    Execute::Reply execute(Units... units) {
        return ask(Execute{{std::vector<CommandUnit>{std::move(units)...}}});
    }

    // The result of get_command_result: "RUNNING", "OK charge=80", or the return code if it is not OK.
    std::string result_of(std::string const& command_id, QueryExpression condition = {});
    // The result `reason`, or "".
    std::string reason_of(std::string const& command_id);

    std::string status_of(std::string const& ref);
    Query::Reply query(std::string const& query_type, QueryExpression condition = {});
    Subscribe::Reply subscribe(std::string const& event_type, QueryExpression condition = {}, bool inline_results = false);
    ReturnCode unsubscribe(SubscribeId const& id) { return ask(Unsubscribe{id}).return_code; }
    GetEventDetail::Reply detail_of(EventId const& id, QueryExpression condition = {});
    GetErrorDetail::Reply detail_of(ErrorId const& id, QueryExpression condition = {});

    // The notifications since the last call, as text: "3 completed go OK", "4 reached_target navigation", "5
    // COMPONENT_INTERNAL_ERROR speech", "9 lost 5". Also works after the session's end.
    std::vector<std::string> received(std::size_t most = 100'000);

    // The last notification of this kind.
    template <class Kind>
    Kind last_received() const {
        return std::get<Kind>(last_);
    }
    template <class Kind>
    Kind const* last_if() const {  // null: the last one is of another kind
        return std::get_if<Kind>(&last_);
    }

    // An answer that keeps its notifications back (decision 22) was sent, or is sent later.
    void answered(NotificationQueue::Hold);
    void answer_is_late(NotificationQueue::Hold);

    bool notifications_closed() const { return notifications_->closed(); }
    NotificationQueue& notifications() { return *notifications_; }

    static Identifier identifier(std::string const& code) {
        return {.code = code, .authority = {}, .codebook_ref = {}, .version = {}};
    }

private:
    void show_published(bool some);

    World* world_;
    std::shared_ptr<NotificationQueue> notifications_;
    std::uint64_t after_ = 0;
    Notification last_;
};

class World : public Outbox {
public:
    World(std::initializer_list<Part> parts) : World{std::vector<Part>{parts}, EngineSettings{}} {}
    World(std::vector<Part> const& parts, EngineSettings settings);
    // Gives no session the id of one of the earlier world.
    void succeed(World const& earlier) { secrets_ = earlier.secrets_; }

    // An application with an open WebSocket, or one that has only sent `connect`.
    Application connect(Connect const& = {});
    Application connect_without_link(Connect const& = {});
    // An application with these rights, which all its operations have.
    Application connect_as(std::shared_ptr<Rights const>, Connect const& = {});

    // Access to a component, and functions that advance time in the steps of the gateway's clock.
    ScriptedComponent& operator[](std::string_view ref) { return *components_.at(std::string{ref}); }
    void advance(std::chrono::milliseconds);

    // The process has died and begun again: the engine has no sessions but those in the journal, and components in their first
    // state.
    void restart(std::vector<Part> const& parts, EngineSettings settings = {});

    // Removes and adds components in one step. `between` may add to the change.
    using Change = std::function<std::vector<std::string>(ComponentChange)>;
    std::function<void(ComponentChange, Change const&)> between = [](ComponentChange change, Change const& perform) {
        perform(std::move(change));
    };
    void change(std::vector<std::string> going, std::vector<Part> const& coming);
    // This component has been removed in another way.
    void forget(std::string const& ref);

    // Changes the calendar time; no time passes.
    void set_calendar(std::chrono::hours by) { now.utc += by; }

    // Runs this as a part of the devices' next advance.
    void happen(std::function<void()> what);

    Said say(SessionId const& session, Operation const& operation) { return begin_to_say(session, operation)->said.value(); }
    // The answer may come later.
    std::shared_ptr<TestedOperation> begin_to_say(SessionId const& session, Operation const& operation) {
        let_look();
        auto const rights = rights_.find(session);
        return engine->begin_to_handle(session, operation, now, rights == rights_.end() ? nullptr : rights->second);
    }
    std::uint64_t stray_answers() const { return engine->statistics().stray_answers; }

    void notify(NotificationQueue& queue) override { ++notified[queue.session()]; }

    // Without a journal, or with one: the variable ROIS_TEST_JOURNAL lets all tests use one.
    std::unique_ptr<MemoryJournal> journal;
    void keep_journal();
    Engine::RightsOf rights_of = [](std::string const&) { return nullptr; };

    Instant now{Steady{std::chrono::hours{1}}, Utc{std::chrono::hours{24 * 20'777 + 12}}};  // 2026-11-20, noon
    std::map<SessionId, int> notified;  // number of Outbox::notify calls, by session
    std::unique_ptr<WorkingEngine> engine;

private:
    void let_look();

    std::shared_ptr<Stage> stage_ = std::make_shared<Stage>();
    std::map<std::string, ScriptedComponent*> components_;
    std::map<SessionId, std::shared_ptr<Rights const>> rights_;  // null for other sessions
    int secrets_ = 0;
};

template <class Operation>
typename Operation::Reply Application::ask(Operation operation) {
    auto said = world_->say(session, operation);
    return std::get<typename Operation::Reply>(std::get<Reply>(std::move(said)));
}

// --- Command units ---

CommandUnit command(std::string command_type, std::string const& ref, ParameterList arguments = {});
inline CommandUnit start(std::string const& ref, ParameterList arguments = {}) {
    return command("start", ref, std::move(arguments));
}
inline CommandUnit stop(std::string const& ref) { return command("stop", ref); }
inline CommandUnit suspend(std::string const& ref) { return command("suspend", ref); }
inline CommandUnit resume(std::string const& ref) { return command("resume", ref); }
inline CommandUnit set(std::string const& ref, ParameterList arguments) {
    return command("set_parameter", ref, std::move(arguments));
}

CommandUnit go(std::string const& id, std::string const& ref = "navigation");  // start with a target
CommandUnit say(std::string const& id, std::string const& ref = "speech");     // start with a text

CommandUnit named(std::string id, CommandUnit unit);
CommandUnit after(std::chrono::milliseconds delay, CommandUnit unit);
CommandUnit pause(std::chrono::milliseconds delay);
CommandUnit in_sequence(std::vector<CommandUnit> units);
CommandUnit in_parallel(std::vector<CommandUnit> units);
CommandUnit branches(std::vector<std::vector<CommandUnit>> lists);
CommandUnit flat(std::vector<CommandUnit> commands);

// All command ids, in document order.
std::vector<std::string> ids_of(std::vector<CommandUnit> const& units);

// --- Conditions and values ---

Condition equal(std::string path, std::string literal);
Condition equal_reversed(std::string literal, std::string path);
Condition alike(std::string path, std::string literal);  // matchCase="false"
Condition both(std::vector<Condition> operands);
Condition either(std::vector<Condition> operands);
Condition not_understood(std::string reason);

Parameter value(std::string name, std::string type, std::vector<std::string> values);

// Parameters as text: "target=a b is_final_target=true".
std::string in_words(ParameterList const&);

}  // namespace rois
