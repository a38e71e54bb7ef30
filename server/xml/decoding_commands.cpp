#include "types/texts.hpp"
#include "xml/decoding.hpp"
#include "xml/tree.hpp"

namespace rois::xml {

namespace {

CommandUnit decode_unit(pugi::xml_node);

CommandMessage decode_command(pugi::xml_node node) {
    return {decode_identifier(child(node, "component_ref")), attribute_text(node, "command_type"),
            CommandId{attribute_text(node, "command_id")}, decode_parameters(child(node, "arguments"))};
}

// The command messages of a branch: their element says their type, with or without xsi:type.
CommandUnit decode_command_unit(pugi::xml_node node) {
    CommandUnit unit{{}, decode_command(node)};
    if (auto const delay = attribute(node, "delay_time")) unit.delay_time = decode_integer(delay.value());
    return unit;
}

ConcurrentCommands decode_concurrent(pugi::xml_node node) {
    ConcurrentCommands concurrent;
    for (auto const part : node.children()) {
        if (local_name(part) == "command_list") {
            concurrent.form = ConcurrentCommands::Form::command_list;
            concurrent.branches.emplace_back().command_list.push_back(decode_command_unit(part));
        } else if (local_name(part) == "branch_list") {
            auto& branch = concurrent.branches.emplace_back();
            for (auto const command : part.children()) {
                if (local_name(command) == "command_list") branch.command_list.push_back(decode_command_unit(command));
            }
        }
    }
    return concurrent;
}

std::vector<CommandUnit> decode_units(pugi::xml_node parent) {
    std::vector<CommandUnit> units;
    for (auto const node : parent.children()) {
        if (local_name(node) == "command_unit_list") units.push_back(decode_unit(node));
    }
    return units;
}

CommandUnit decode_unit(pugi::xml_node node) {
    CommandUnit unit;
    if (auto const delay = attribute(node, "delay_time")) unit.delay_time = decode_integer(delay.value());
    auto const type = xsi_type(node);
    auto const name = type ? type->local_name : std::string_view{};
    if (name == "CommandMessageType") {
        unit.unit = decode_command(node);
    } else if (name == "ConcurrentCommandsType") {
        unit.unit = decode_concurrent(node);
    } else if (name == "SequentialCommandUnitType") {
        unit.unit = SequentialCommandUnit{decode_units(node)};
    } else if (name == "ParallelCommandUnitType") {
        unit.unit = ParallelCommandUnit{decode_units(node)};
    }
    return unit;
}

}  // namespace

CommandUnitSequence decode_sequence(pugi::xml_node command_unit_sequence) { return {decode_units(command_unit_sequence)}; }

}  // namespace rois::xml
