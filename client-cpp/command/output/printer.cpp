#include "command/output/printer.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>
#include <variant>

#include "command/exit.hpp"
#include "command/output/describe.hpp"
#include "command/output/pretty.hpp"
#include "command/output/terminal.hpp"
#include "types/asking.hpp"
#include "types/text/texts.hpp"
#include "xml/codec/codec.hpp"

namespace rois::command {

namespace {

// "12:00:01.123", in UTC like the engine's times.
std::string time_of_day() {
    auto const text = to_text(std::chrono::system_clock::now());
    return text.substr(11, 12);
}

std::string document_of(Notification const& notification, std::uint64_t sequence) {
    return std::string{xml::notification_head(notification)} + std::to_string(sequence) + xml::notification_tail(notification);
}

}  // namespace

void Printer::write(std::string const& text) {
    std::lock_guard const lock{mutex_};
    bool const written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (written) return;
    if (errno == EPIPE) throw Trouble{Exit::interrupted, ""};  // the reader has ended, as in `rois watch | head -1`
    throw Trouble{Exit::usage, std::string{"cannot write to standard output: "} + std::strerror(errno)};
}

void Printer::text(std::string_view text) { write(std::string{text}); }

void Printer::reply(Reply const& reply, std::string_view operation) {
    auto const& outcome = outcome_of(reply);
    if (form_ == Form::xml) return write(pretty(xml::encode(reply, {})));
    if (form_ == Form::json) return write(line_of(to_json(reply, operation)));
    if (outcome.return_code == ReturnCode::ok) return write(described(reply, coloured_));
    throw Trouble{exit_of(outcome.return_code), std::string{operation} + ": " + std::string{to_text(outcome.return_code)} +
                                                    (outcome.reason.empty() ? "" : ": " + harmless(outcome.reason))};
}

void Printer::fault(Fault const& fault, std::string_view operation) {
    if (form_ == Form::xml) return write(pretty(xml::encode(fault)));
    if (form_ == Form::json) return write(line_of(to_json(fault)));
    throw Trouble{Exit::fault, std::string{operation} + ": " + std::string{to_text(fault.code)} + ": " + harmless(fault.reason)};
}

void Printer::notification(Notification const& notification, std::uint64_t sequence) {
    if (form_ == Form::xml) return write(pretty(document_of(notification, sequence)));
    if (form_ == Form::json) return write(line_of(to_json(notification, sequence)));
    write(painted(time_of_day(), Colour::quiet, coloured_) + "  " + described(notification, coloured_) + "\n");
}

void Printer::state(StateChange const& change) {
    auto const bad = change.state == State::lost || change.state == State::closed;
    auto const reason = change.reason.empty() ? "" : ": " + change.reason;
    line(painted(time_of_day(), Colour::quiet, coloured_) + "  " +
             painted(to_text(change.state), bad ? Colour::bad : Colour::good, coloured_) + harmless(reason),
         "connection", to_json(change));
}

void Printer::gap(Gap const& gap) {
    auto text = std::string{gap.why == Gap::Why::dropped ? "notifications were missed"
                                                         : "a new session: notifications that were not received are lost"};
    if (gap.count) text += ", " + std::to_string(*gap.count) + " of them";
    for (auto const& each : gap.not_restored) text += "; not restored: " + each;
    line(painted(time_of_day(), Colour::quiet, coloured_) + "  " + painted("gap", Colour::bad, coloured_) + "  " + harmless(text),
         "gap", to_json(gap));
}

void Printer::profile(ComponentEntry const& entry) {
    if (form_ == Form::human || !entry.profile) return write(described(entry, coloured_));
    if (form_ == Form::json) return write(line_of(to_json(*entry.profile)));
    write(pretty(xml::encode(*entry.profile, "profile." + entry.ref)));
}

void Printer::line(std::string_view human, std::string_view element, Json const& object) {
    if (form_ == Form::human) return write(std::string{human} + "\n");
    if (form_ == Form::json) return write(line_of(object));
    pugi::xml_document document;
    auto node = document.append_child(std::string{element}.c_str());
    for (auto const& [name, value] : object.items()) {
        auto const text = value.is_string() ? value.get<std::string>() : value.dump();
        node.append_attribute(name.c_str()).set_value(text.c_str());
    }
    std::ostringstream out;
    document.save(out, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
    write(out.str() + "\n");
}

}  // namespace rois::command
