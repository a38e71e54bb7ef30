#include "types/text/texts.hpp"
#include "xml/codec/decoding.hpp"

namespace rois::xml {

namespace {

using Node = MessageTree::Node;

CommandUnit decode_unit(Node);

CommandMessage decode_command(Node node) {
    return {decode_identifier(node.child("component_ref")), node.attribute_text("command_type"),
            CommandId{node.attribute_text("command_id")}, decode_parameters(node.child("arguments"))};
}

// Decodes a command message of a branch: its element implies its type, so xsi:type is optional.
CommandUnit decode_command_unit(Node node) {
    CommandUnit unit{{}, decode_command(node)};
    if (auto const delay = node.attribute("delay_time")) unit.delay_time = decode_integer(*delay);
    return unit;
}

ConcurrentCommands decode_concurrent(Node node) {
    ConcurrentCommands concurrent;
    for (auto const part : node.children()) {
        if (part.name() == "command_list") {
            concurrent.form = ConcurrentCommands::Form::command_list;
            concurrent.branches.emplace_back().command_list.push_back(decode_command_unit(part));
        } else if (part.name() == "branch_list") {
            auto& branch = concurrent.branches.emplace_back();
            for (auto const command : part.children()) {
                if (command.name() == "command_list") branch.command_list.push_back(decode_command_unit(command));
            }
        }
    }
    return concurrent;
}

std::vector<CommandUnit> decode_units(Node parent) {
    std::vector<CommandUnit> units;
    for (auto const node : parent.children()) {
        if (node.name() == "command_unit_list") units.push_back(decode_unit(node));
    }
    return units;
}

CommandUnit decode_unit(Node node) {
    CommandUnit unit;
    if (auto const delay = node.attribute("delay_time")) unit.delay_time = decode_integer(*delay);
    auto const type = node.type();
    if (type == "CommandMessageType") {
        unit.unit = decode_command(node);
    } else if (type == "ConcurrentCommandsType") {
        unit.unit = decode_concurrent(node);
    } else if (type == "SequentialCommandUnitType") {
        unit.unit = SequentialCommandUnit{decode_units(node)};
    } else if (type == "ParallelCommandUnitType") {
        unit.unit = ParallelCommandUnit{decode_units(node)};
    }
    return unit;
}

}  // namespace

CommandUnitSequence decode_sequence(Node command_unit_sequence) { return {decode_units(command_unit_sequence)}; }

}  // namespace rois::xml
