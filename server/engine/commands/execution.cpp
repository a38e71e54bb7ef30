#include "engine/commands/execution.hpp"

#include <utility>

namespace rois {

Execution::Execution(CommandUnitSequence const& sequence, MakeCommand const& make) {
    add(Kind::sequence, 0, {});
    add_units(sequence.command_unit_list, 0, make);
}

std::size_t Execution::add(Kind kind, std::size_t parent, std::optional<std::int64_t> delay) {
    auto const index = nodes_.size();
    auto& node = nodes_.emplace_back();
    node.kind = kind;
    node.parent = parent;
    node.delay = std::chrono::milliseconds{delay.value_or(0)};
    if (index != 0) nodes_[parent].children.push_back(index);
    return index;
}

void Execution::add_units(std::vector<CommandUnit> const& units, std::size_t parent, MakeCommand const& make) {
    for (auto const& unit : units) add_unit(unit, parent, make);
}

void Execution::add_unit(CommandUnit const& unit, std::size_t parent, MakeCommand const& make) {
    struct Adder {
        Execution& self;
        CommandUnit const& unit;
        std::size_t parent;
        MakeCommand const& make;

        void operator()(DelayOnly const&) { self.add(Kind::delay, parent, unit.delay_time); }
        void operator()(CommandMessage const& message) {
            auto const node = self.add(Kind::command, parent, unit.delay_time);
            auto command = make(message);
            command->node = node;
            self.commands_.push_back(command);
            self.nodes_[node].command = std::move(command);
        }
        void operator()(ConcurrentCommands const& concurrent) {
            auto const node = self.add(Kind::parallel, parent, unit.delay_time);
            for (auto const& branch : concurrent.branches)
                self.add_units(branch.command_list, self.add(Kind::sequence, node, {}), make);
        }
        void operator()(SequentialCommandUnit const& sequential) {
            self.add_units(sequential.command_unit_list, self.add(Kind::sequence, parent, unit.delay_time), make);
        }
        void operator()(ParallelCommandUnit const& parallel) {
            self.add_units(parallel.command_unit_list, self.add(Kind::parallel, parent, unit.delay_time), make);
        }
    };
    std::visit(Adder{*this, unit, parent, make}, unit.unit);
}

std::vector<Execution::Turn> Execution::begin(std::size_t node) {
    has_begun_ = true;
    std::vector<Turn> turns;
    auto const& unit = nodes_[node];
    if (unit.ended) return turns;
    switch (unit.kind) {
        case Kind::command:
            break;
        case Kind::delay:
            end(node, true, turns);
            break;
        case Kind::sequence:
            turns.push_back(turn(unit.children.front()));
            break;
        case Kind::parallel:
            for (auto const child : unit.children) turns.push_back(turn(child));
            break;
    }
    return turns;
}

std::vector<Execution::Turn> Execution::command_ended(std::size_t node, CompletedStatus status) {
    std::vector<Turn> turns;
    if (!nodes_[node].ended) end(node, status == CompletedStatus::ok, turns);
    return turns;
}

// Ends a unit, and each enclosing unit that is over as a consequence.
void Execution::end(std::size_t node, bool ok, std::vector<Turn>& turns) {
    while (true) {
        nodes_[node].ended = true;
        if (node == 0) return;
        auto const parent = nodes_[node].parent;
        auto& around = nodes_[parent];
        auto const ended = ++around.ended_children;
        if (!ok) around.failed = true;
        if (around.kind == Kind::sequence && !ok) {
            abort_from(parent, ended);
        } else if (ended < around.children.size()) {
            if (around.kind == Kind::sequence) turns.push_back(turn(around.children[ended]));
            return;
        }
        ok = !around.failed;
        node = parent;
    }
}

void Execution::abort_from(std::size_t sequence, std::size_t child) {
    for (; child < nodes_[sequence].children.size(); ++child) abort(nodes_[sequence].children[child]);
}

void Execution::abort(std::size_t node) {
    auto& unit = nodes_[node];
    if (unit.ended) return;
    unit.ended = true;
    if (unit.command) aborted_.push_back(unit.command);
    for (auto const child : unit.children) abort(child);
}

}  // namespace rois
