// One accepted command unit sequence while it runs: a tree of sequential and parallel units (decisions 13 to 15).
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/commands/command.hpp"
#include "engine/commands/deadlines.hpp"
#include "types/command_units.hpp"

namespace rois {

// Decides which unit may begin next. The executor runs the commands.
class Execution {
public:
    // Makes the command of a message. Called in document order.
    using MakeCommand = std::function<std::shared_ptr<Command>(CommandMessage const&)>;

    Execution(CommandUnitSequence const&, MakeCommand const&);

    // A unit that may begin now. The caller begins them in order.
    struct Turn {
        std::size_t node;
        std::chrono::milliseconds delay;  // before the unit begins; the caller then calls `begin`
    };

    // Begins the unit at this node (0: the whole sequence). The unit must not be a command: the caller runs commands itself.
    std::vector<Turn> begin(std::size_t node);

    // Records that the command at this node has ended. Returns the next turns; `take_aborted` has the commands that cannot run
    // any more.
    std::vector<Turn> command_ended(std::size_t node, CompletedStatus);

    // The command of this node; null if the node is another kind of unit.
    std::shared_ptr<Command> const& command_at(std::size_t node) const { return nodes_[node].command; }

    // Returns the commands to complete with ABORT because their sequence failed, in document order. Returns each one once.
    std::vector<std::shared_ptr<Command>> take_aborted() { return std::exchange(aborted_, {}); }

    // All commands, in document order.
    std::vector<std::shared_ptr<Command>> const& commands() const { return commands_; }

    bool has_begun() const { return has_begun_; }  // else its commands may wait for the journal, and be refused

    std::vector<Deadlines::Ticket> delays;  // set by the executor: the deadlines of the delays that are not over

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

    bool has_begun_ = false;
    std::vector<Node> nodes_;  // nodes_[0] is the whole sequence
    std::vector<std::shared_ptr<Command>> commands_;
    std::vector<std::shared_ptr<Command>> aborted_;
};

}  // namespace rois
