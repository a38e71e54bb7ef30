#include "types/instant.hpp"
#include "xml/codec/codec.hpp"
#include "xml/codec/encoding.hpp"
#include "xml/codec/names.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view head_of(ReceiveEvent const&) { return R"(<receive_event sequence=")"; }
constexpr std::string_view head_of(ReceiveError const&) { return R"(<receive_error sequence=")"; }
constexpr std::string_view head_of(Completed const&) { return R"(<completed sequence=")"; }
constexpr std::string_view head_of(ComponentChanged const&) { return R"(<component_changed sequence=")"; }
constexpr std::string_view head_of(Switched const&) { return R"(<switched sequence=")"; }
constexpr std::string_view head_of(Lost const&) { return R"(<lost sequence=")"; }
constexpr std::string_view head_of(ProfileChanged const&) { return R"(<profile_changed sequence=")"; }

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
    if (error.text) out.element("text", *error.text);
}

void write(Writer& out, Completed const& completed) {
    if (completed.results) declare_rois(out);
    if (completed.active) out.attribute("active", *completed.active ? "true" : "false");
    out.element("command_id", completed.command_id.text).element("status", to_text(completed.status));
    if (completed.results) write_results(out, *completed.results);
    if (!completed.reason.empty()) out.element("reason", completed.reason);
}

void write(Writer& out, ComponentChanged const& changed) {
    declare_rois(out);
    write_identifier(out, "component_ref", changed.component_ref);
    out.element("status", to_text(changed.status));
    write_results(out, changed.results);
}

void write(Writer& out, Switched const& switched) {
    declare_rois(out);
    write_identifier(out, "component_ref", switched.component_ref);
    out.element("from", switched.from).element("to", switched.to).element("reason", switched.reason);
}

void write(Writer& out, Lost const& lost) { out.attribute("count", lost.count); }

void write(Writer&, ProfileChanged const&) {}

}  // namespace

std::string_view notification_head(Notification const& notification) {
    return std::visit([](auto const& each) { return head_of(each); }, notification);
}

// Writes the document without its sequence, then cuts off `<root`. The closing quote of the sequence overwrites the last letter
// of the root's name.
std::string notification_tail(Notification const& notification) {
    auto const head = notification_head(notification);
    auto const root = head.substr(1, head.find(' ') - 1);
    Writer out;
    out.start(root).constant("xmlns", message_namespace);
    std::visit([&](auto const& each) { write(out, each); }, notification);
    out.end();
    auto text = std::move(out).written();
    text.erase(0, root.size());
    text.front() = '"';
    return text;
}

std::string notifications_begin() {
    std::string text{"<notifications xmlns=\""};
    return text.append(message_namespace).append("\">");
}

std::string notifications_end() { return "</notifications>"; }

}  // namespace rois::xml
