#include "xml/codec/codec.hpp"
#include "xml/codec/decoding.hpp"
#include "xml/codec/encoding.hpp"
#include "xml/codec/names.hpp"

namespace rois::xml {

namespace {

template <class Op>
concept HasCondition = requires(Op op) {
    op.condition;
};
template <class Op>
concept HasRois = requires(Op op) {
    op.component_ref;
}
|| std::is_same_v<Op, Execute>;

void write_ref(Writer& out, Identifier const& component_ref) { write_identifier(out, "component_ref", component_ref); }

// Writes the children before the condition. One overload for each operation that has such children.
void write(Writer&, auto const&) {}
void write(Writer& out, GetErrorDetail const& op) { out.element("error_id", op.error_id.text); }
void write(Writer& out, Bind const& op) { write_ref(out, op.component_ref); }
void write(Writer& out, Release const& op) { write_ref(out, op.component_ref); }
void write(Writer& out, GetParameter const& op) { write_ref(out, op.component_ref); }
void write(Writer& out, SetParameter const& op) {
    write_ref(out, op.component_ref);
    write_parameters(out, "parameters", "parameter", op.parameters);
}
void write(Writer& out, Execute const& op) { write_sequence(out, op.command_unit_list); }
void write(Writer& out, GetCommandResult const& op) { out.element("command_id", op.command_id.text); }
void write(Writer& out, Query const& op) { out.element("query_type", op.query_type); }
void write(Writer& out, Subscribe const& op) { out.element("event_type", op.event_type); }
void write(Writer& out, Unsubscribe const& op) { out.element("subscribe_id", op.subscribe_id.text); }
void write(Writer&, StopEverything const&) {}
void write(Writer&, ClearStop const&) {}
void write(Writer& out, GetEventDetail const& op) { out.element("event_id", op.event_id.text); }

void write_attributes(Writer&, auto const&) {}
void write_attributes(Writer& out, Connect const& op) {
    if (op.motion_lease) out.attribute("motion_lease", static_cast<std::uint64_t>(op.motion_lease->count()));
    if (op.motion_lease_http) out.attribute("motion_lease_http", static_cast<std::uint64_t>(op.motion_lease_http->count()));
    if (op.is_engine) out.attribute("role", "engine");
    if (op.switches) out.attribute("switches", "true");
    if (op.window) out.attribute("window", static_cast<std::uint64_t>(op.window->count()));
    if (op.motion_proof) out.attribute("motion_proof", *op.motion_proof == MotionProof::request ? "request" : "pong");
}
void write_attributes(Writer& out, ClearStop const& op) { out.attribute("stop", op.stop); }
void write_attributes(Writer& out, Resume const& op) {
    out.attribute("session", op.session.text).attribute("last_sequence", op.last_sequence);
}
template <class Op>
requires requires(Op op) { op.check_only; }
void write_attributes(Writer& out, Op const& op) {
    if (op.check_only) out.attribute("check_only", "true");
}
template <class Op>
requires requires(Op op) { op.switching; }
void write_attributes(Writer& out, Op const& op) {
    if (op.switching != Switching::none) out.attribute("switching", to_text(op.switching));
    if constexpr (requires { op.take_over; })
        if (op.take_over) out.attribute("take_over", "true");
}
void write_attributes(Writer& out, Subscribe const& op) {
    if (op.inline_results) out.attribute("inline_results", "true");
}

void declare_for(Writer& out, QueryExpression const& condition) {
    if (is_empty(condition)) return;
    declare_fes(out);
    declare_gml(out);
    if (needs_unr(condition)) declare_unr(out);
}

}  // namespace

std::string encode(Request const& request) {
    Writer out;
    out.start(operation_names()[request.operation.index()]).constant("xmlns", message_namespace);
    std::visit(
        [&]<class Op>(Op const& operation) {
            if constexpr (HasRois<Op>) declare_rois(out);
            if constexpr (std::is_same_v<Op, Execute>) declare_xsi(out);
            if constexpr (HasCondition<Op>) declare_for(out, operation.condition);
            write_attributes(out, operation);
            out.attribute_unless_empty("request_id", request.request_id);
            write(out, operation);
            if constexpr (HasCondition<Op>) {
                if (!is_empty(operation.condition)) {
                    out.start("condition");
                    write_condition(out, operation.condition);
                    out.end();
                }
            }
            out.end();
        },
        request.operation);
    return std::move(out).written();
}

}  // namespace rois::xml
