// What every command has: its options, where it writes, and its session.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "command/caller.hpp"
#include "command/options.hpp"
#include "command/printer.hpp"
#include "command/session.hpp"
#include "command/session_file.hpp"
#include "command/signals.hpp"
#include "xml/schemas.hpp"

namespace rois::command {

class Context {
public:
    // `background` may be null: the program runs in the foreground.
    Context(Options options, Signals&, Caller const&, Background* background = nullptr);
    ~Context();
    Context(Context const&) = delete;
    Context& operator=(Context const&) = delete;

    Options const& options() const { return options_; }
    Printer& printer() { return printer_; }
    Signals& signals() { return signals_; }

    // Whether this process holds the session of the session file.
    bool holds_session_file() const { return session_file_ != nullptr; }
    // Whether other calls find this process by the session file.
    bool is_found_by_session_file() const { return session_file_ && session_file_->is_there(); }
    // If this process holds the session file: writes it and ends the parent. Throws Trouble.
    void go_to_background();

    // Opened when it is asked for the first time. Throws Trouble.
    Session& session();
    // Of `bind`: the joined session has ended. The next `session` is one that another process holds, or one of its own. Throws
    // Trouble.
    void begin_again(NoSession const&);
    std::shared_ptr<xml::Schemas const> schemas();
    // Of `--record`; null without.
    std::shared_ptr<RecordingWriter> const& recorded() const { return recorded_; }
    // With `--record`: the command does what it should, so the recording replaces what the file had. Throws Trouble.
    void keep_recording();

    // The reply of an operation that is OK. Otherwise writes the refusal, and throws Trouble with its code. The text of `hint`
    // follows the engine's reason.
    template <class Op>
    typename Op::Reply ok(Op operation, std::function<std::string()> const& hint = {}) {
        return std::get<typename Op::Reply>(checked(std::move(operation), Written::no, hint));
    }

    // The same, written.
    template <class Op>
    typename Op::Reply show(Op operation, std::function<std::string()> const& hint = {}) {
        auto reply = checked(std::move(operation), Written::yes, hint);
        return std::get<typename Op::Reply>(std::move(reply));
    }

    // Binds the component. If it is unknown, the refusal names those that there are.
    Bind::Reply bound(Identifier);

    // For the refusal of an unknown component: those that there are. Empty if the component is known.
    std::string hint_for_component(std::string const& ref);

    // The engine's components; none if the engine does not answer.
    std::vector<ComponentEntry> components();

    // Refuses what this program itself sees to be wrong in what the engine has told: a document like the engine's own refusals of
    // that operation, or the reason alone for people.
    template <class Op>
    [[noreturn]] void refuse(ReturnCode code, std::string const& reason) {
        typename Op::Reply reply;
        reply.return_code = code;
        reply.reason = reason;
        refuse(Reply{std::move(reply)});
    }

    // The condition that the options give, by text or file.
    QueryExpression condition();

    // The component of that ref. Refuses one that is unknown, with those that there are.
    ComponentEntry component(std::string const& ref);

private:
    enum class Written { no, yes };
    Reply checked(Operation, Written, std::function<std::string()> const& hint);
    [[noreturn]] void refuse(Reply const&);
    void take_session_file();
    void replace_lost_session(NoSession const&);
    void end_left_session();
    void leave_no_file_if_interrupted();

    Options options_;
    Signals& signals_;
    Caller const& caller_;
    Background* const background_;
    Printer printer_;
    std::shared_ptr<RecordingWriter> recorded_;
    std::shared_ptr<xml::Schemas const> schemas_;
    std::unique_ptr<SessionFile> session_file_;  // of a session in the background; locked until the session has ended
    std::unique_ptr<Session> session_;
};

// The names of the components' messages of this kind, each once.
std::vector<std::string> message_names(std::vector<ComponentEntry> const&, MessageKind);

// The components with their types: "move (Move), navigation (Navigation)".
std::string components_and_types(std::vector<ComponentEntry> const&);

// Writes an error of the engine, and explains it.
void tell_error(Context&, News const&);

// Says on standard error what the engine says more of an error, and how to go on after a hold. Asks the engine.
void explain(Context&, ReceiveError const&);

// Writes a remark on standard error, such as that a result is empty.
void remark(std::string const& text);

// When the time of --for is over, counted from the start of the program.
Until end_of(Options const&);

// The components that have not confirmed that they stand still, as the answer to /readyz names them.
std::vector<std::string> not_confirmed(std::string_view readiness);

// What the commands do. Each throws Trouble when it does not go well.
void profile(Context&);
void search(Context&);
void query(Context&);
void get(Context&);
void health(Options const&, Printer&);
void stop_all(Options const&, Printer&);
void clear(Options const&, Printer&);

void bind(Context&);
void release(Context&);
void set(Context&);
void start(Context&);
void stop(Context&);
void resume(Context&);
void execute(Context&);

void subscribe(Context&);
void watch(Context&);
void send(Context&);

void record(Context&);
void record_others(Context&);
void replay(Context&);
void scenario(Context&);

}  // namespace rois::command
