// A sub engine (7.2): the link to its gateway, our session there, and its components, which it adds to this engine
// (docs/engines.md).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "engine/engine.hpp"
#include "links/link.hpp"
#include "remote/part.hpp"
#include "remote/sub_engine.hpp"
#include "remote/translation.hpp"
#include "types/engine_state.hpp"
#include "types/messages.hpp"
#include "xml/codec/codec.hpp"

namespace rois::remote {

// What a sub engine needs. All functions are called on the thread of the links, except `post`.
class Surroundings {
public:
    virtual ~Surroundings() = default;

    virtual Steady now() const = 0;
    // Calls `ring` once, at this time or soon afterwards.
    virtual void at(Steady, std::function<void()> ring) = 0;
    // Thread-safe: calls the function on the thread of the links.
    virtual void post(std::function<void()>) = 0;
    // Returns null for a sub engine that joins: it will call `joined`.
    virtual std::shared_ptr<client::Link> link(SubEngine const&, client::Link::Listener&) = 0;
    // Changes this engine's components. Throws std::exception with the reason if it refuses.
    virtual void change(ComponentChange) = 0;
    // Returns the reason if one of these instances is this engine, or belongs to another sub engine. Otherwise assigns them to
    // this sub engine, instead of its earlier ones, and returns nothing.
    virtual std::optional<std::string> why_loop(std::string const& sub_engine, std::vector<std::string> const& instances) = 0;
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
    RemoteEngine(SubEngine, std::shared_ptr<Surroundings>);

    SubEngine const& settings() const { return settings_; }

    void begin();
    // Ends the session. Its components leave. Nothing happens after this.
    void end();
    // An exception, for example because memory is missing, may have interrupted this object at any place: gives up the session,
    // and connects again. If this throws, call it again.
    void recover();

    // A sub engine that joins is there, on an open link, which replaces an older one.
    void joined(std::shared_ptr<client::Link>);
    bool has_link() const { return link_ != nullptr; }

    // Reports a problem. If the same one is reported again and again, the log has it once.
    void note(std::string const& what);

    // From any thread: calls the function on the thread of the links.
    void run(std::function<void(RemoteEngine&)>);

    // What the engine asks of a component.
    void attach(std::shared_ptr<Part> const&);
    void bind(std::shared_ptr<Part> const&, Ticket);
    void released(std::shared_ptr<Part> const&);
    void prepare(std::shared_ptr<Part> const&, Ticket, std::string const& command_type, ParameterList const&);
    void begin(std::shared_ptr<Part> const&, CommandHandle, std::string const& command_type, ParameterList const&);
    void halt(std::shared_ptr<Part> const&, Ticket);
    void pause(std::shared_ptr<Part> const&, Ticket, std::string const& command_type);  // suspend or resume
    void query(std::shared_ptr<Part> const&, Ticket, std::string const& query_type);

private:
    // Called with the answer, or with null: the session has ended before it came.
    using Then = std::function<void(Reply const*)>;
    struct Open {
        client::Link::Document document;
        Then then;
        CommandId once;  // of an execute, which must not be performed twice
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
    bool is_flooded() const;
    void go_on_when_handled(std::uint64_t era);
    void opened(Connect::Reply const&);
    void resumed(ReturnCode);
    void session_ended();
    void send_again();
    void give_up_link(std::string const& reason);
    void give_up(std::string const& reason);
    void end_commands(std::string const& why);
    void leave(std::string const& reason);
    void await_next_attempt();
    void give_signs_of_life(std::uint64_t session);
    void show();
    void ask(Operation, Then, CommandId once = {});

    // --- remote_engine.cpp: its profile and components ---
    using Parts = std::map<std::string, std::shared_ptr<Part>, std::less<>>;  // by their refs there
    void report_state(Part&, ComponentChanged const&) const;
    void command(std::shared_ptr<Part> const&, std::string const& command_type,
                 std::function<void(CompletedStatus, std::string const& reason)> const& then);
    void ask_profile();
    void take_profile(GetProfile::Reply const&);
    void enter(GetProfile::Reply const&);
    void subscribe();
    void restore();
    void bind_there(std::shared_ptr<Part> const&, Then const&);
    void release_unwanted(std::shared_ptr<Part> const&);
    ComponentDescription description_of(ComponentEntry const&, Part const&, Translation const&) const;
    std::shared_ptr<Part> part_of(std::string_view ref) const;
    void operator()(ReceiveEvent const&);
    void operator()(ReceiveError const&);
    void operator()(Completed const&);
    void operator()(Lost const&) {}
    void operator()(ProfileChanged const&) { ask_profile(); }
    void operator()(ComponentChanged const&);

    SubEngine settings_;
    std::shared_ptr<Surroundings> surroundings_;
    std::string last_error_;
    Translation translation_;
    xml::AnswerReader reader_;
    Parts parts_;
    std::map<std::string, ComponentChanged, std::less<>> states_;  // by refs there, also of components that are not here yet
    std::map<std::string, std::function<void(Completed const&)>, std::less<>> commands_;  // whose end is expected, by id
    std::set<std::string> subscribed_;                                                    // event types

    std::shared_ptr<client::Link> link_;  // null between attempts
    SessionId session_;                   // empty: none
    std::uint64_t last_sequence_ = 0;
    bool is_open_ = false;  // requests can be sent
    std::map<std::uint64_t, Open> open_;
    std::uint64_t last_request_ = 0;
    std::uint64_t last_command_ = 0;
    std::uint64_t documents_ = 0;           // received
    std::uint64_t era_ = 0;                 // counts attempts and lost links: alarms of an earlier one are void
    unsigned failures_ = 0;                 // in a row
    bool is_present_ = false;               // its profile was read, and its components have not left
    bool is_given_up_ = false;              // the session, which may still exist there
    std::optional<Steady> lost_at_;         // when the session lost its link; until its components are there again
    bool profile_asked_ = false;            // and not answered yet
    bool profile_changed_ = false;          // since then
    Steady last_sign_{};                    // of life
    std::optional<Steady> asked_for_sign_;  // the first sign of life that is not answered yet
    EngineState state_;                     // as it was shown last
    bool is_over_ = false;
};

}  // namespace rois::remote
