#include "types/instant.hpp"
#include "xml/codec.hpp"
#include "xml/encoding.hpp"
#include "xml/names.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view root_of(ReceiveEvent const&) { return "receive_event"; }
constexpr std::string_view root_of(ReceiveError const&) { return "receive_error"; }
constexpr std::string_view root_of(Completed const&) { return "completed"; }
constexpr std::string_view root_of(Lost const&) { return "lost"; }
constexpr std::string_view root_of(ProfileChanged const&) { return "profile_changed"; }

void write(Writer& out, ReceiveEvent const& event) {
    declare_rois(out);
    out.element("event_id", event.event_id.text).element("event_type", event.event_type);
    out.element("subscribe_id", event.subscribe_id.text).element("expire", to_text(event.expire));
    write_identifier(out, "component_ref", event.component_ref);
    if (event.results != nullptr) write_results(out, *event.results);
}

void write(Writer& out, ReceiveError const& error) {
    if (error.component_ref) declare_rois(out);
    out.element("error_id", error.error_id.text).element("error_type", to_text(error.error_type));
    if (error.component_ref) write_identifier(out, "component_ref", *error.component_ref);
}

void write(Writer& out, Completed const& completed) {
    out.element("command_id", completed.command_id.text).element("status", to_text(completed.status));
}

void write(Writer& out, Lost const& lost) { out.attribute("count", lost.count); }

void write(Writer&, ProfileChanged const&) {}

std::string_view root_of(Notification const& notification) {
    return std::visit([](auto const& each) { return root_of(each); }, notification);
}

}  // namespace

std::string notification_head(Notification const& notification, std::uint64_t sequence) {
    std::string text;
    Writer{text}.start(root_of(notification)).attribute("sequence", sequence);
    return text;
}

// Written whole, without the beginning that the head has.
std::string notification_tail(Notification const& notification) {
    std::string text;
    Writer out{text};
    auto const root = root_of(notification);
    out.start(root).attribute("xmlns", message_namespace);
    std::visit([&](auto const& each) { write(out, each); }, notification);
    out.end();
    return text.erase(0, root.size() + 1);
}

std::string notifications_begin() {
    std::string text{"<notifications xmlns=\""};
    return text.append(message_namespace).append("\">");
}

std::string notifications_end() { return "</notifications>"; }

}  // namespace rois::xml
