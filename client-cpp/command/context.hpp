// The context of a command: its options, its output and its session.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "command/options.hpp"
#include "command/output/printer.hpp"
#include "command/session/caller.hpp"
#include "command/session/session.hpp"
#include "command/session/session_file.hpp"
#include "command/signals.hpp"
#include "xml/validation/schemas.hpp"

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
    // If this process holds the session file, writes the file and ends the parent process. Throws Trouble.
    void go_to_background();

    // The first call opens or joins the session. Throws Trouble.
    Session& session();
    // For `bind`, after the joined session has ended: the next call of `session` joins one that another process holds, or opens
    // one. Throws Trouble.
    void begin_again(NoSession const&);
    std::shared_ptr<xml::Schemas const> schemas();
    // The recording of --record; null without --record.
    std::shared_ptr<RecordingWriter> const& recorded() const { return recorded_; }
    // With --record, replaces the old content of the file by the recording. Call when the command has succeeded so far. Throws
    // Trouble.
    void keep_recording();

    // Returns the reply of an operation if it is OK. Otherwise writes the refusal, with the text of `hint` after the engine's
    // reason, and throws Trouble with its code.
    template <class Op>
    typename Op::Reply ok(Op operation, std::function<std::string()> const& hint = {}) {
        return std::get<typename Op::Reply>(checked(std::move(operation), Written::no, hint));
    }

    // Like `asked`, and writes the reply.
    template <class Op>
    typename Op::Reply show(Op operation, std::function<std::string()> const& hint = {}) {
        auto reply = checked(std::move(operation), Written::yes, hint);
        return std::get<typename Op::Reply>(std::move(reply));
    }

    // Binds the component with --switching. If it is unknown, the refusal lists the known components.
    Bind::Reply bound(Identifier);

    // The list of known components for the refusal of an unknown one; empty if the component is known.
    std::string hint_for_component(std::string const& ref);

    // The engine's components; none if the engine does not answer.
    std::vector<ComponentEntry> components(QueryExpression condition = {});

    // Reports an error that this program has found itself as if the engine had refused the operation: as a document or, for
    // people, only the reason.
    template <class Op>
    [[noreturn]] void refuse(ReturnCode code, std::string const& reason) {
        typename Op::Reply reply;
        reply.return_code = code;
        reply.reason = reason;
        refuse(Reply{std::move(reply)});
    }

    // The condition of --where or --condition.
    QueryExpression condition();

    // Returns the component with this ref. If it is unknown, reports the known components and throws Trouble.
    ComponentEntry component(std::string const& ref);

private:
    enum class Written { no, yes };
    Reply checked(Operation, Written, std::function<std::string()> const& hint);
    [[noreturn]] void refuse(Reply const&);
    bool owns(Identifier const& component);  // whether this session has bound it
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
    std::unique_ptr<SessionFile> session_file_;  // of a session in the background; locked until that has ended
    std::unique_ptr<Session> session_;
};

// Returns the names of the components' messages of this kind, each once.
std::vector<std::string> message_names(std::vector<ComponentEntry> const&, MessageKind);

// Returns the components with their types: "move (Move), navigation (Navigation)".
std::string components_and_types(std::vector<ComponentEntry> const&);

// Writes an error notification, and calls `explain`.
void report_error(Context&, News const&);

// Asks the engine for the text of an error and prints it on standard error, with the next step if a motion is held.
void explain(Context&, ReceiveError const&);

// Writes a remark, such as "no component matches", on standard error.
void remark(std::string const& text);

// Returns the end of --for, counted from the start of the program; nothing without --for.
Until end_of(Options const&);

// Returns the components that have not confirmed that they stand still, from the body of /readyz.
std::vector<std::string> not_confirmed(std::string_view readiness);

// The commands. Each throws Trouble if it fails.
void profile(Context&);
void search(Context&);
void query(Context&);
void get(Context&);
void engines(Options const&, Printer&);
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
