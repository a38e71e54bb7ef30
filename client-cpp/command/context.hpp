// What every command has: its options, where it writes, and its session.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "command/options.hpp"
#include "command/printer.hpp"
#include "command/session.hpp"
#include "command/signals.hpp"
#include "xml/schemas.hpp"

namespace rois::command {

class Context {
public:
    Context(Options options, Signals&);
    ~Context();
    Context(Context const&) = delete;
    Context& operator=(Context const&) = delete;

    Options const& options() const { return options_; }
    Printer& printer() { return printer_; }
    Signals& signals() { return signals_; }

    // Opened when it is asked for the first time. Throws Trouble.
    Session& session();
    std::shared_ptr<xml::Schemas const> schemas();
    // Of `--record`; null without.
    std::shared_ptr<RecordingWriter> const& recorded() const { return recorded_; }
    // With `--record`: the command does what it should, so the recording replaces what the file had. Throws Trouble.
    void keep_recording();

    // The reply of an operation that is OK; otherwise it is told, and Trouble is thrown with its code.
    template <class Op>
    typename Op::Reply ok(Op operation) {
        return std::get<typename Op::Reply>(checked(std::move(operation)));
    }

    // The same, written.
    template <class Op>
    typename Op::Reply show(Op operation) {
        auto reply = checked(std::move(operation), Written::yes);
        return std::get<typename Op::Reply>(std::move(reply));
    }

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
    Reply checked(Operation, Written = Written::no);
    [[noreturn]] void refuse(Reply const&);

    Options options_;
    Signals& signals_;
    Printer printer_;
    std::shared_ptr<RecordingWriter> recorded_;
    std::shared_ptr<xml::Schemas const> schemas_;
    std::unique_ptr<Session> session_;
};

// "--for" from now on.
Until end_of(Options const&);

// What the commands do. Each throws Trouble when it does not go well.
void profile(Context&);
void search(Context&);
void query(Context&);
void get(Context&);
void health(Options const&, Printer&);

void bind(Context&);
void release(Context&);
void set(Context&);
void start(Context&);
void stop(Context&);
void execute(Context&);

void subscribe(Context&);
void watch(Context&);
void send(Context&);

void record(Context&);
void record_others(Context&);
void replay(Context&);
void scenario(Context&);

}  // namespace rois::command
