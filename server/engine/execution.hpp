// The shape of one accepted command unit sequence while it runs: units in sequence and in parallel (decisions 13 to 15).
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/command.hpp"
#include "engine/deadlines.hpp"
#include "types/command_units.hpp"

namespace rois {

// A tree of units. It decides whose turn it is; running a command is the executor's.
class Execution {
public:
    // Makes the command of a message, in document order.
    using MakeCommand = std::function<std::shared_ptr<Command>(CommandMessage const&)>;

    Execution(CommandUnitSequence const&, MakeCommand const&);

    // What may go on now; the caller acts on each of them, in order.
    struct Turn {
        std::size_t node;
        std::chrono::milliseconds delay;  // before the unit begins: call `begin` then
    };

    // Begins the unit at this node (0: the whole sequence), which must be no command: those the caller runs.
    std::vector<Turn> begin(std::size_t node);

    // The command at this node has ended. What cannot run any more is in `take_aborted`.
    std::vector<Turn> command_ended(std::size_t node, CompletedStatus);

    // The command of this node; null when it is another unit.
    std::shared_ptr<Command> const& command_at(std::size_t node) const { return nodes_[node].command; }

    // Commands that shall complete with ABORT since their sequence has failed, in document order; each is given once.
    std::vector<std::shared_ptr<Command>> take_aborted() { return std::exchange(aborted_, {}); }

    // All commands, in document order.
    std::vector<std::shared_ptr<Command>> const& commands() const { return commands_; }

    std::vector<Deadlines::Ticket> delays;  // set by the executor: deadlines of the delays that are not over

private:
    enum class Kind : std::uint8_t { sequence, parallel, command, delay };

    struct Node {
        Kind kind = Kind::sequence;
        std::size_t parent = 0;
        std::chrono::milliseconds delay{0};
        std::vector<std::size_t> children;
        std::shared_ptr<Command> command;
        std::size_t ended_children = 0;
        bool failed = false;
        bool ended = false;
    };

    std::size_t add(Kind, std::size_t parent, std::optional<std::int64_t> delay);
    void add_unit(CommandUnit const&, std::size_t parent, MakeCommand const&);
    void add_units(std::vector<CommandUnit> const&, std::size_t parent, MakeCommand const&);
    void end(std::size_t node, bool ok, std::vector<Turn>&);
    void abort_from(std::size_t sequence, std::size_t child);
    void abort(std::size_t node);
    Turn turn(std::size_t node) const { return {node, nodes_[node].delay}; }

    std::vector<Node> nodes_;  // nodes_[0] is the whole sequence
    std::vector<std::shared_ptr<Command>> commands_;
    std::vector<std::shared_ptr<Command>> aborted_;
};

}  // namespace rois
