// A world for the engine's tests: scripted components, a clock that moves when told, applications that speak in the domain's
// words. `World world{navigation, speech}; auto desk = world.connect(); desk.bind("navigation"); ...`
#pragma once

#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/engine.hpp"
#include "parts.hpp"
#include "types/messages.hpp"

namespace rois {

class World;

// A service application with a session of its own. It hears what it is told when it listens.
class Application {
public:
    Application(World& world, SessionId session);

    SessionId session;

    // The answer to an operation; the test fails when it was refused before it ran.
    template <class Operation>
    typename Operation::Reply ask(Operation operation);

    // Nothing when it ran.
    std::optional<Refusal> refusal_of(Operation const&);

    ReturnCode bind(std::string const& ref) { return ask(Bind{identifier(ref)}).return_code; }
    ReturnCode release(std::string const& ref) { return ask(Release{identifier(ref)}).return_code; }
    std::string bind_any(QueryExpression condition = {});  // the ref, or the return code
    std::vector<std::string> search(QueryExpression condition = {});
    void leave() { ask(Disconnect{}); }

    SetParameter::Reply set_parameter(std::string const& ref, ParameterList parameters);
    GetParameter::Reply get_parameter(std::string const& ref) { return ask(GetParameter{identifier(ref)}); }

    template <class... Units>
    Execute::Reply execute(Units... units) {
        return ask(Execute{{std::vector<CommandUnit>{std::move(units)...}}});
    }

    // What get_command_result says: "RUNNING", "OK charge=80", or the return code when it says no.
    std::string result_of(std::string const& command_id, QueryExpression condition = {});
    // The reason that it gives, if it does.
    std::string reason_of(std::string const& command_id);

    std::string status_of(std::string const& ref);
    Query::Reply query(std::string const& query_type, QueryExpression condition = {});
    Subscribe::Reply subscribe(std::string const& event_type, QueryExpression condition = {}, bool inline_results = false);
    ReturnCode unsubscribe(SubscribeId const& id) { return ask(Unsubscribe{id}).return_code; }
    GetEventDetail::Reply detail_of(EventId const& id, QueryExpression condition = {});
    GetErrorDetail::Reply detail_of(ErrorId const& id, QueryExpression condition = {});

    // What was told since it last listened, in words: "3 completed go OK", "4 reached_target navigation",
    // "5 COMPONENT_INTERNAL_ERROR speech", "9 lost 5". Heard also after the session's end.
    std::vector<std::string> heard(std::size_t most = 100'000);

    // The same as it came, for the last of them.
    template <class Kind>
    Kind last_heard() const {
        return std::get<Kind>(last_);
    }

    bool told_of_the_end() const { return notifications_->closed(); }
    NotificationQueue& notifications() { return *notifications_; }

    static Identifier identifier(std::string const& code) {
        return {.code = code, .authority = {}, .codebook_ref = {}, .version = {}};
    }

private:
    World* world_;
    std::shared_ptr<NotificationQueue> notifications_;
    std::uint64_t after_ = 0;
    Notification last_;
};

class World : public Outbox {
public:
    World(std::initializer_list<Part> parts) : World{std::vector<Part>{parts}, EngineSettings{}} {}
    World(std::vector<Part> const& parts, EngineSettings settings);

    // An application with a WebSocket that stays open; and one that has only asked for a session.
    Application connect();
    Application connect_without_link();

    // A component; and time, in steps as the gateway's clock makes them.
    ScriptedComponent& operator[](std::string_view ref) { return *components_.at(std::string{ref}); }
    void advance(std::chrono::milliseconds);

    // Components come and go at once.
    void change(std::vector<std::string> going, std::vector<Part> const& coming);

    // Somebody sets the machine's calendar; no time passes.
    void set_calendar(std::chrono::hours by) { now.utc += by; }

    // Does this where things happen by themselves.
    void happen(std::function<void()> what);

    std::variant<Reply, Refusal> say(SessionId const& session, Operation const& operation) {
        return engine->handle(session, operation, now);
    }
    std::uint64_t stray_answers() const { return engine->statistics().stray_answers; }

    void notify(NotificationQueue& queue) override { ++notified[queue.session()]; }

    Instant now{Steady{std::chrono::hours{1}}, Utc{std::chrono::hours{24 * 20'777 + 12}}};  // 2026-11-20, noon
    std::map<SessionId, int> notified;  // how often the outbox was called for a session
    std::unique_ptr<Engine> engine;

private:
    std::shared_ptr<Stage> stage_ = std::make_shared<Stage>();
    std::map<std::string, ScriptedComponent*> components_;
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

CommandUnit go(std::string const& id, std::string const& ref = "navigation");  // start with a place to go to
CommandUnit say(std::string const& id, std::string const& ref = "speech");     // start with something to say

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

// "target=a b is_final_target=true": names with their values.
std::string in_words(ParameterList const&);

}  // namespace rois
