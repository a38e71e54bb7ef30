// A sub engine (7.2): the link to its gateway, the session on it, and its components, which are added to this engine
// (docs/engines.md).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "links/link.hpp"
#include "remote/component_record.hpp"
#include "remote/rate_limit.hpp"
#include "remote/sub_engine.hpp"
#include "remote/translation.hpp"
#include "types/engine_state.hpp"
#include "types/messages.hpp"
#include "xml/codec/codec.hpp"

namespace rois::remote {

// What a sub engine needs. All functions are called on the thread of the links, except `post`.
class RemoteEngineHost {
public:
    virtual ~RemoteEngineHost() = default;

    virtual Steady now() const = 0;
    // The name of this engine.
    virtual std::string const& own_name() const = 0;
    // Calls `ring` once, at this time or soon afterwards.
    virtual void at(Steady, std::function<void()> ring) = 0;
    // Thread-safe: calls the function on the thread of the links.
    virtual void post(std::function<void()>) = 0;
    // Returns null for a sub engine that joins: it will call `joined`.
    virtual std::shared_ptr<client::Link> link(SubEngine const&, client::Link::Listener&) = 0;
    // Changes this engine's components. Throws std::exception with the reason if it refuses. Returns why frames and places are
    // left out.
    virtual std::vector<std::string> change(ComponentChange) = 0;
    // The session before a restart of this engine; it is asked for once. The session now: calls `then`, on any thread, when it is
    // stored for the time after a restart. The stop of everything that is to be cleared there (Engine::stopped_there). The ends
    // of commands of the earlier session.
    virtual Engine::EarlierSession earlier_session(std::string const& sub_engine) = 0;
    virtual void session_opened(std::string const& sub_engine, SessionId const&, std::function<void()> then) = 0;
    virtual void stopped_there(std::string const& sub_engine, std::optional<std::uint64_t> stop) = 0;
    virtual void commands_ended(std::string const& sub_engine, std::vector<CommandEnded>) = 0;
    // Returns the reason if one of these instances is this engine, or belongs to another sub engine. Otherwise assigns them to
    // this sub engine, instead of its earlier ones, and returns nothing. Instances of an entry with `engine` belong to no sub
    // engine: several entries may use the same gateway.
    virtual std::optional<std::string> why_loop(SubEngine const&, std::vector<std::string> const& instances) = 0;
    // Whether everything is stopped in this engine.
    virtual bool everything_is_stopped() const = 0;
    // Returns whether this engine's clock runs. If not, the sub engine receives no signs of life, and its robot stops.
    virtual bool is_alive() const = 0;
    // A line of the log about the sub engine.
    virtual void report(std::string const& sub_engine, std::string const& what) = 0;
    // Called whenever the state of the sub engine has changed.
    virtual void show(EngineState const&) = 0;
};

// Used on the thread of the links, except `run`.
class RemoteEngine final : public std::enable_shared_from_this<RemoteEngine>, private client::Link::Listener {
public:
    RemoteEngine(SubEngine, std::shared_ptr<RemoteEngineHost>);

    SubEngine const& settings() const { return settings_; }

    void begin();
    // Ends the session. Its components leave. Nothing happens after this.
    void end();
    // An exception, for example because memory is missing, may have interrupted this object at any place: gives up the session,
    // and connects again. If this throws, call it again.
    void recover();

    // Called when the sub engine has joined. `link` is open and replaces the previous one.
    void joined(std::shared_ptr<client::Link> link);
    bool has_link() const { return link_ != nullptr; }

    // Called when everything is stopped in this engine, and when that stop is cleared. The sub engine does the same, also with
    // what its own applications have begun.
    void ask_to_stop();
    void clear_stop();

    // Reports a problem. If the same one is reported again and again, the log has it once.
    void note(std::string const& what);

    // From any thread: calls the function on the thread of the links.
    void run(std::function<void(RemoteEngine&)>);

    // What the engine asks of a component.
    void attach(std::shared_ptr<ComponentRecord> const&);
    void bind(std::shared_ptr<ComponentRecord> const&, Ticket, Binding const&);
    void released(std::shared_ptr<ComponentRecord> const&);
    void prepare(std::shared_ptr<ComponentRecord> const&, Ticket, std::string const& command_type, ParameterList const&);
    void begin(std::shared_ptr<ComponentRecord> const&, CommandHandle, std::string const& command_type, ParameterList const&);
    void halt(std::shared_ptr<ComponentRecord> const&, Ticket);
    void pause(std::shared_ptr<ComponentRecord> const&, Ticket, std::string const& command_type);  // suspend or resume
    void query(std::shared_ptr<ComponentRecord> const&, Ticket, std::string const& query_type);

private:
    // Called with the answer, or with null: the sub engine has refused the request, or the session has ended before the answer
    // came. `why_no_answer` says which.
    using Then = std::function<void(Reply const*)>;
    struct Unanswered {
        client::Link::Document document;
        Then then;
        CommandId once;  // the command of an `execute`, which must not be performed twice; empty: may be sent again
    };

    // --- remote_session.cpp: the link and the session ---
    void attempt();
    void limit_attempt();
    void connected() override;
    void attached() override {}
    void document(std::string_view) override;
    void failed(std::string const& reason, client::Failure) override;
    void pinged() override {}
    void take(xml::Answered const&);
    void take(Fault const&);
    void take(xml::NumberedNotification const&);
    bool is_flooded();
    void go_on_when_handled(std::uint64_t era);
    void opened(Connect::Reply const&);
    void begin_session(SessionId const&);
    void if_still_lost(Steady when, Steady lost_at, void (RemoteEngine::*then)(std::string const&), std::string what);
    void resumed(ReturnCode);
    void session_ended();
    void forget_session();
    void ask_about_earlier_commands();
    void take_earlier(xml::Answered const&);
    void lose_earlier_session();
    void end_earlier_session();
    void reject(std::string const& problem);
    void send_again();
    void give_up_link(std::string const& reason);
    void give_up(std::string const& reason);
    void end_commands(std::string const& why);
    void leave(std::string const& reason);
    void await_next_attempt();
    Connect request_for_session() const;
    void give_signs_of_life(std::uint64_t era);
    void take_sign(Reply const&);
    void show();
    // Whether there is a session. Requests wait while it has no link.
    bool can_ask() const { return !session_.text.empty() && !is_given_up_ && !is_over_; }
    void ask(Operation, Then, CommandId once = {});

    // --- remote_engine.cpp: its profile and components ---
    using Records = std::map<std::string, std::shared_ptr<ComponentRecord>, std::less<>>;  // by their refs in the sub engine
    void report_state(ComponentRecord&, ComponentChanged const&) const;
    void ask_profile();
    void take_profile(GetProfile::Reply const&);
    void enter(GetProfile::Reply const&);
    void note_missing();
    void report_left_out(std::vector<std::string> const& why) const;
    void subscribe();
    void restore();
    void restore(std::shared_ptr<ComponentRecord> const&);
    void restore_parameters(std::shared_ptr<ComponentRecord> const&);
    ComponentDescription description_of(ComponentEntry const&, ComponentRecord const&, Translation const&) const;
    std::shared_ptr<ComponentRecord> record_of(std::string_view ref) const;
    void operator()(ReceiveEvent const&);
    void operator()(ReceiveError const&);
    void operator()(Completed const&);
    void operator()(Lost const&) {}  // while there is a link, only events are lost
    void operator()(ProfileChanged const&) { ask_profile(); }
    void operator()(ComponentChanged const&);
    void operator()(Switched const&);

    // --- remote_requests.cpp: what this engine asks ---
    std::string why_no_answer() const;
    void bind_there(std::shared_ptr<ComponentRecord> const&, Then const&);
    void release_unwanted(std::shared_ptr<ComponentRecord> const&);
    void confirm_halt(std::shared_ptr<ComponentRecord> const&);
    void end_activity(std::shared_ptr<ComponentRecord> const&);
    std::string fresh_id() { return "c" + std::to_string(++last_command_); }  // of a command that this engine adds
    static std::string number_of(CommandHandle command) { return std::to_string(static_cast<std::uint64_t>(command)); }
    static std::string id_of(CommandHandle command) { return "h" + number_of(command); }  // also after a restart
    void command(std::shared_ptr<ComponentRecord> const&, std::string const& command_type, ParameterList arguments,
                 std::string const& id, std::function<void(CompletedStatus, std::string const& reason)> const& then);
    void judge_failed_halt(std::shared_ptr<ComponentRecord> const&);
    void check_binding(std::shared_ptr<ComponentRecord> const&, std::function<void()> const& if_held);
    void halt_by_release(std::shared_ptr<ComponentRecord> const&);
    void clear_stop_there();
    void note_stop_there(std::optional<std::uint64_t> stop);

    SubEngine settings_;
    std::shared_ptr<RemoteEngineHost> host_;
    std::string last_error_;
    Translation translation_;
    EngineProfile profile_;  // as the sub engine has sent it last
    Space space_;            // the same
    xml::AnswerReader reader_;
    Records records_;
    std::map<std::string, ComponentChanged, std::less<>> states_;  // by refs in the sub engine; some have no record yet
    std::map<std::string, std::function<void(Completed const&)>, std::less<>> commands_;  // commands that have not ended, by id
    std::vector<std::string> missing_;  // refs that the engines file names and the sub engine does not have
    std::set<std::string> subscribed_;  // event types that `subscribe` was sent for

    std::shared_ptr<client::Link> link_;  // null between attempts
    SessionId session_;                   // empty: no session
    Engine::EarlierSession earlier_;      // before a restart of this engine; without an id when it has been ended
    std::vector<CommandEnded> ended_;     // commands of that session, in the names of the sub engine
    std::uint64_t last_sequence_ = 0;
    bool is_open_ = false;                            // requests can be sent
    std::map<std::uint64_t, Unanswered> unanswered_;  // requests, by their numbers
    std::uint64_t last_request_ = 0;
    std::string refusal_;  // why the sub engine has refused a request, while `then` of that request runs
    std::uint64_t last_command_ = 0;
    RateLimit notifications_{1'000, 5'000};  // that it may send
    std::uint64_t documents_ = 0;            // number of received documents
    std::uint64_t era_ = 0;          // incremented by each attempt and each lost link; a timer of an earlier era does nothing
    unsigned failures_ = 0;          // failed attempts in a row
    bool is_present_ = false;        // the profile was read, and the components have not left
    bool is_given_up_ = false;       // the session is given up; it may still exist in the sub engine
    std::optional<Steady> lost_at_;  // when the session lost its link; empty once the components are present again
    bool profile_asked_ = false;     // a `get_profile` is not answered yet
    bool profile_changed_ = false;   // the profile changed after it was requested
    Steady last_sign_{};             // when the last sign of life was sent
    std::optional<Steady> asked_for_sign_;     // when the first sign of life that is not answered yet was sent
    EngineState state_;                        // the state that `show` passed on last
    bool stop_is_asked_ = false;               // a `stop_everything` is not answered yet
    bool has_resumed_ = false;                 // and no notification has come since
    std::optional<std::uint64_t> stop_there_;  // to clear there; ClearStop::own: the number is not known (yet)
    bool is_over_ = false;
};

}  // namespace rois::remote
