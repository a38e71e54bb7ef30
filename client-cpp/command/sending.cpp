// The command send.
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <variant>

#include "command/context.hpp"
#include "command/input/input.hpp"
#include "command/output/pretty.hpp"
#include "command/output/terminal.hpp"
#include "types/asking.hpp"
#include "types/text/texts.hpp"
#include "xml/codec/codec.hpp"
#include "xml/codec/decoding.hpp"

namespace rois::command {

namespace {

// Writes the fault, and underlines its place in the sent document. Throws Trouble.
void report_fault(Context& context, Fault const& fault, std::string const& sent, std::string const& answer) {
    auto& printer = context.printer();
    if (printer.form() == Form::json) {
        printer.text(line_of(to_json(fault)));
    } else {
        printer.text(pretty(answer));
    }
    std::string text = context.options().file + ":";
    if (fault.place) text += std::to_string(fault.place->line) + ":" + std::to_string(fault.place->column) + ":";
    text += " " + std::string{to_text(fault.code)} + ": " + harmless(fault.reason);
    bool const coloured = shows_colours(context.options().colour, STDERR_FILENO);
    if (fault.place) text += "\n" + underlined(sent, *fault.place, coloured);
    if (text.ends_with('\n')) text.pop_back();
    throw Trouble{Exit::fault, text};
}

}  // namespace

void send(Context& context) {
    auto const sent = text_of_file(context.options().file);
    auto const answer = context.session().send(sent);
    context.keep_recording();
    auto& printer = context.printer();
    auto const received = xml::AnswerReader{}.read(answer);
    if (received && std::holds_alternative<Fault>(*received)) report_fault(context, std::get<Fault>(*received), sent, answer);
    auto const* const answered = received ? std::get_if<xml::Answered>(&*received) : nullptr;
    if (printer.form() == Form::json && answered != nullptr) {
        printer.text(line_of(to_json(answered->reply, xml::operation_names()[answered->reply.index()])));
    } else {
        printer.text(pretty(answer));
    }
    if (answered == nullptr) throw Trouble{Exit::no_answer, "the answer is not a document of RoIS"};
    auto const code = outcome_of(answered->reply).return_code;
    if (code != ReturnCode::ok) throw Trouble{exit_of(code), ""};
}

}  // namespace rois::command
