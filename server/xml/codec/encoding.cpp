#include "xml/codec/encoding.hpp"

#include "xml/codec/names.hpp"

namespace rois::xml {

namespace {

void write_parameter(Writer& out, std::string_view element, Parameter const& parameter) {
    out.start(element).attribute("rois:name", parameter.name);
    write_identifier(out, "rois:data_type_ref", parameter.data_type_ref);
    for (auto const& value : parameter.values) out.element("rois:value", value);
    out.end();
}

void write_certainty(Writer&, std::monostate) {}

void write_certainty(Writer& out, Located::Reliability const& reliability) {
    out.element("reliability", number_text(reliability.probability));
}

void write_certainty(Writer& out, Located::Covariance const& covariance) {
    out.element("covariance", numbers_text(covariance.rows));
}

void write_located(Writer& out, Located const& located) {
    out.start("located").attribute("of", located.of).attribute("ref", located.ref).attribute("crs", located.crs);
    out.element("position", numbers_text(located.position));
    if (!located.orientation.empty()) out.element("orientation", numbers_text(located.orientation));
    std::visit([&](auto const& certainty) { write_certainty(out, certainty); }, located.certainty);
    out.end();
}

// --- Command sequences ---

void write_command(Writer& out, CommandMessage const& command) {
    out.attribute("rois:command_type", command.command_type).attribute("rois:command_id", command.command_id.text);
    write_identifier(out, "rois:component_ref", command.component_ref);
    if (!command.arguments.empty()) write_parameters(out, "rois:arguments", "rois:parameter", command.arguments);
}

void write_unit(Writer& out, std::string_view element, CommandUnit const& unit);

void write_units(Writer& out, std::vector<CommandUnit> const& units) {
    for (auto const& unit : units) write_unit(out, "rois:command_unit_list", unit);
}

void write_branch(Writer& out, Branch const& branch) {
    for (auto const& command : branch.command_list) write_unit(out, "rois:command_list", command);
}

// Writes the attribute xsi:type, then the delay, then the content of the type.
class UnitWriter {
public:
    UnitWriter(Writer& out, std::optional<std::int64_t> delay) : out_{out}, delay_{delay} {}

    void operator()(DelayOnly) const { write_delay(); }
    void operator()(CommandMessage const& command) const {
        begin("rois:CommandMessageType");
        write_command(out_, command);
    }
    void operator()(ConcurrentCommands const& concurrent) const {
        begin("rois:ConcurrentCommandsType");
        bool const flat = concurrent.form == ConcurrentCommands::Form::command_list;
        for (auto const& branch : concurrent.branches) {
            if (!flat) out_.start("rois:branch_list");
            write_branch(out_, branch);
            if (!flat) out_.end();
        }
    }
    void operator()(SequentialCommandUnit const& sequential) const {
        begin("rois:SequentialCommandUnitType");
        write_units(out_, sequential.command_unit_list);
    }
    void operator()(ParallelCommandUnit const& parallel) const {
        begin("rois:ParallelCommandUnitType");
        write_units(out_, parallel.command_unit_list);
    }

private:
    void begin(std::string_view type) const {
        out_.attribute("xsi:type", type);
        write_delay();
    }
    void write_delay() const {
        if (delay_) out_.attribute("rois:delay_time", std::string_view{std::to_string(*delay_)});
    }

    Writer& out_;
    std::optional<std::int64_t> delay_;
};

void write_unit(Writer& out, std::string_view element, CommandUnit const& unit) {
    out.start(element);
    std::visit(UnitWriter{out, unit.delay_time}, unit.unit);
    out.end();
}

}  // namespace

void declare_rois(Writer& out) { out.constant("xmlns:rois", rois_namespace); }

void declare_xsi(Writer& out) { out.constant("xmlns:xsi", xsi_namespace); }

void declare_gml(Writer& out) { out.constant("xmlns:gml", gml_namespace); }

void declare_fes(Writer& out) { out.constant("xmlns:fes", fes_namespace); }

void declare_unr(Writer& out) { out.constant("xmlns:unr", unr_namespace); }

std::string numbers_text(std::span<double const> numbers) {
    std::string text;
    for (auto const number : numbers) {
        if (!text.empty()) text += ' ';
        text += number_text(number);
    }
    return text;
}

void write_identifier(Writer& out, std::string_view element, Identifier const& id) {
    out.start(element).attribute_unless_empty("rois:authority", id.authority).attribute("rois:code", id.code);
    out.attribute_unless_empty("rois:codebook_ref", id.codebook_ref).attribute_unless_empty("rois:version", id.version).end();
}

void write_parameters(Writer& out, std::string_view list, std::string_view element, ParameterList const& parameters) {
    out.start(list);
    for (auto const& parameter : parameters) write_parameter(out, element, parameter);
    out.end();
}

void write_results(Writer& out, Results const& results) {
    out.start("results");
    for (auto const& parameter : results.parameters) write_parameter(out, "result", parameter);
    for (auto const& located : results.located) write_located(out, located);
    out.end();
}

void write_sequence(Writer& out, CommandUnitSequence const& sequence) {
    out.start("rois:CommandUnitSequence");
    write_units(out, sequence.command_unit_list);
    out.end();
}

}  // namespace rois::xml
