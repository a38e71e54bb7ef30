#include <span>

#include "xml/codec/codec.hpp"
#include "xml/codec/encoding.hpp"
#include "xml/codec/names.hpp"

namespace rois::xml {

namespace {

// The root element of an answer. write() adds the content of a successful one; one overload for each kind of content.
constexpr std::string_view root_of(Connect::Reply const&) { return "connect_response"; }
constexpr std::string_view root_of(Resume::Reply const&) { return "resume_response"; }
constexpr std::string_view root_of(Disconnect::Reply const&) { return "disconnect_response"; }
constexpr std::string_view root_of(GetProfile::Reply const&) { return "get_profile_response"; }
constexpr std::string_view root_of(GetErrorDetail::Reply const&) { return "get_error_detail_response"; }
constexpr std::string_view root_of(Search::Reply const&) { return "search_response"; }
constexpr std::string_view root_of(Bind::Reply const&) { return "bind_response"; }
constexpr std::string_view root_of(BindAny::Reply const&) { return "bind_any_response"; }
constexpr std::string_view root_of(Release::Reply const&) { return "release_response"; }
constexpr std::string_view root_of(GetParameter::Reply const&) { return "get_parameter_response"; }
constexpr std::string_view root_of(SetParameter::Reply const&) { return "set_parameter_response"; }
constexpr std::string_view root_of(Execute::Reply const&) { return "execute_response"; }
constexpr std::string_view root_of(GetCommandResult::Reply const&) { return "get_command_result_response"; }
constexpr std::string_view root_of(Query::Reply const&) { return "query_response"; }
constexpr std::string_view root_of(Subscribe::Reply const&) { return "subscribe_response"; }
constexpr std::string_view root_of(Unsubscribe::Reply const&) { return "unsubscribe_response"; }
constexpr std::string_view root_of(GetEventDetail::Reply const&) { return "get_event_detail_response"; }
constexpr std::string_view root_of(StopEverything::Reply const&) { return "stop_everything_response"; }
constexpr std::string_view root_of(ClearStop::Reply const&) { return "clear_stop_response"; }

template <class T>
concept HasNothing = std::is_same_v<T, Resume::Reply> || std::is_same_v<T, Disconnect::Reply> || std::is_same_v<T, Bind::Reply> ||
    std::is_same_v<T, Release::Reply> || std::is_same_v<T, Unsubscribe::Reply> || std::is_same_v<T, ClearStop::Reply>;
template <class T>
concept HasOnlyResults = std::is_same_v<T, GetErrorDetail::Reply> || std::is_same_v<T, GetCommandResult::Reply> ||
    std::is_same_v<T, GetEventDetail::Reply>;

// Replies with elements or attributes of the RoIS namespace. Profiles declare their prefixes themselves.
template <class T>
concept HasRois = HasOnlyResults<T> || std::is_same_v<T, Search::Reply> || std::is_same_v<T, BindAny::Reply> ||
    std::is_same_v<T, GetParameter::Reply> || std::is_same_v<T, Execute::Reply> || std::is_same_v<T, Query::Reply>;

void write(Writer&, HasNothing auto const&) {}

void write(Writer& out, HasOnlyResults auto const& reply) { write_results(out, reply.results); }

void write(Writer& out, Connect::Reply const& reply) { out.element("session", reply.session.text); }

void write(Writer& out, StopEverything::Reply const& reply) {
    for (auto const& ref : reply.not_halted) out.element("not_halted", ref);
}

void write_traits(Writer& out, ComponentTraits const& traits) {
    out.constant("moves", traits.moves ? "true" : "false").constant("when_stopped", to_text(traits.status_when_stopped));
    for (auto const& position : traits.positions) out.element("position", position);
    for (auto const& [parameter, known] : traits.codebooks)
        for (auto const& codebook : known) out.start("codebook").attribute("parameter", parameter).text(codebook).end();
    for (auto const& group : traits.alternatives) {
        out.start("alternatives");
        for (auto const& parameter : group) out.element("parameter", parameter);
        out.end();
    }
}

void write_space(Writer& out, Space const& space) {
    out.start("space");
    for (auto const& frame : space.frames) {
        out.start("frame").attribute("crs", frame.crs).attribute("base", frame.base);
        out.element("position", numbers_text(frame.position)).element("orientation", numbers_text(frame.orientation));
        if (!frame.covariance.empty()) out.element("covariance", numbers_text(frame.covariance));
        out.end();
    }
    for (auto const& [name, area] : space.places) {
        out.start("place").attribute("name", name).attribute("crs", area.crs);
        out.element("low", numbers_text(std::span{area.low}.first(area.dimensions)));
        out.element("high", numbers_text(std::span{area.high}.first(area.dimensions))).end();
    }
    out.end();
}

void write(Writer& out, GetProfile::Reply const& reply) {
    write_profile(out, *reply.profile, "engine." + reply.profile->object.name);
    out.start("components");
    for (auto const& entry : reply.components) {
        out.start("component").attribute("ref", entry.ref).attribute("type", entry.type).attribute("engine", entry.engine);
        if (entry.traits) write_traits(out, *entry.traits);
        out.end();
    }
    out.end();
    if (reply.space != Space{}) write_space(out, reply.space);
    for (auto const& entry : reply.components) write_profile(out, *entry.profile, "profile." + entry.ref);
}

void write(Writer& out, Search::Reply const& reply) {
    out.start("component_ref_list");
    for (auto const& ref : reply.component_ref_list) write_identifier(out, "component_ref", ref);
    out.end();
}

void write(Writer& out, BindAny::Reply const& reply) { write_identifier(out, "component_ref", reply.component_ref); }

void write(Writer& out, GetParameter::Reply const& reply) { write_parameters(out, "parameters", "parameter", reply.parameters); }

void write(Writer& out, SetParameter::Reply const& reply) { out.element("command_id", reply.command_id.text); }

void write(Writer& out, Execute::Reply const& reply) { write_sequence(out, reply.command_unit_list); }

void write(Writer& out, Query::Reply const& reply) {
    write_identifier(out, "component_ref", reply.component_ref);
    write_results(out, reply.results);
    for (auto const& row : reply.other_rows) write_results(out, row);
}

void write(Writer& out, Subscribe::Reply const& reply) { out.element("subscribe_id", reply.subscribe_id.text); }

void write_attributes(Writer&, auto const&) {}
void write_attributes(Writer& out, Connect::Reply const& reply) {
    if (reply.window) out.attribute("window", static_cast<std::uint64_t>(reply.window->count()));
}
void write_attributes(Writer& out, StopEverything::Reply const& reply) {
    if (reply.stop) out.attribute("stop", *reply.stop);
}

template <class R>
void write_answer(Writer& out, R const& reply, std::string_view request_id) {
    bool const good = reply.return_code == ReturnCode::ok;
    out.start(root_of(reply)).constant("xmlns", message_namespace);
    if (good && HasRois<R>) declare_rois(out);
    if (good && std::is_same_v<R, Execute::Reply>) declare_xsi(out);
    out.constant("return_code", to_text(reply.return_code)).attribute_unless_empty("request_id", request_id);
    if (good) {
        write_attributes(out, reply);
        write(out, reply);
    } else {
        out.element("reason", reply.reason);
    }
    out.end();
}

}  // namespace

std::string encode(Reply const& reply, std::string_view request_id) {
    Writer out;
    std::visit([&](auto const& each) { write_answer(out, each, request_id); }, reply);
    return std::move(out).written();
}

std::string encode(Fault const& fault) {
    Writer out;
    out.start("fault").constant("xmlns", message_namespace).attribute("code", to_text(fault.code));
    if (fault.place) out.attribute("line", fault.place->line).attribute("column", fault.place->column);
    out.attribute_unless_empty("request_id", fault.request_id).element("reason", fault.reason).end();
    return std::move(out).written();
}

std::string encode(std::vector<EngineState> const& engines) {
    using milliseconds = std::chrono::duration<double, std::milli>;
    Writer out;
    out.start("engines").constant("xmlns", message_namespace);
    for (auto const& each : engines) {
        out.start("engine").attribute("name", each.name).constant("state", to_text(each.is)).attribute("link", each.link);
        if (each.round_trip) out.constant("round_trip", number_text(milliseconds{*each.round_trip}.count()));
        out.attribute("components", std::uint64_t{each.components}).attribute("losses", each.losses);
        if (!each.last_error.empty()) out.element("last_error", each.last_error);
        out.end();
    }
    out.end();
    return std::move(out).written();
}

std::string encode(StopState const& state) {
    Writer out;
    out.start("stop_state").constant("xmlns", message_namespace).element("stopped", state.stopped ? "true" : "false");
    for (auto const& ref : state.not_halted) out.element("not_halted", ref);
    out.end();
    return std::move(out).written();
}

}  // namespace rois::xml
