// Sequential and parallel command units (7.4.3.1, tables 10 to 15; figures 10 and 15; decisions 13 to 15).
#include <algorithm>
#include <chrono>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::branch;
using kit::command_list;
using kit::concurrent;
using kit::parallel_unit;
using kit::pause;
using kit::sequential_unit;
using kit::unit;

constexpr int a_moment = 80;          // ms
constexpr int time_to_release = 500;  // ms, delay of the command that runs during release

// Two bound components, and ids for four commands. The commands complete at once.
class FourCommands {
public:
    explicit FourCommands(Context& context) : client{context}, pair_{context.two_common_components()} {
        client.bind_or_skip(*pair_.first);
        client.bind_or_skip(*pair_.second);
    }

    Command good(std::size_t number, std::optional<int> delay = {}) const {
        return command(number % 2 == 0 ? *pair_.first : *pair_.second, "stop", names[number], delay);
    }
    Command failing(std::size_t number) const { return command(*pair_.first, "resume", names[number]); }

    // Executes the units, waits for the command with index `last`, and requires these completions: index and status, "2 ABORT".
    void run(kit::Xml const& units, std::size_t last, std::vector<std::string> const& expected) {
        require_ok(client.execute(units));
        client.status_of(names[last]);
        std::vector<std::string> received;
        for (auto const& one : client.history()) {
            auto const found = std::ranges::find(names, one.text("command_id"));
            if (found != names.end()) received.push_back(std::to_string(found - names.begin()) + " " + one.text("status"));
        }
        require(received == expected, "expected the completions " + list(expected) + ", got " + list(received));
    }

    Client client;
    std::vector<std::string> names{unique_name(), unique_name(), unique_name(), unique_name()};

private:
    std::pair<Component const*, Component const*> pair_;
};

void commands_of_a_sequence_run_in_order(Context& context) {
    FourCommands commands{context};
    commands.run(unit(commands.good(0, a_moment)) + unit(commands.good(1)) + unit(commands.good(2)), 2, {"0 OK", "1 OK", "2 OK"});
}

void branches_run_in_parallel(Context& context) {
    FourCommands commands{context};
    commands.run(concurrent(branch({commands.good(0, a_moment), commands.good(1)}) + branch({commands.good(2)})), 1,
                 {"2 OK", "0 OK", "1 OK"});
}

void the_next_unit_waits_for_all_branches(Context& context) {
    FourCommands commands{context};
    commands.run(concurrent(branch({commands.good(0, a_moment)}) + branch({commands.good(1)})) + unit(commands.good(2)), 2,
                 {"1 OK", "0 OK", "2 OK"});
}

void each_command_of_a_flat_list_is_a_branch(Context& context) {
    FourCommands commands{context};
    commands.run(concurrent(command_list(commands.good(0, a_moment)) + command_list(commands.good(1))), 0, {"1 OK", "0 OK"});
}

void sequential_and_parallel_units_can_be_nested(Context& context) {
    FourCommands commands{context};
    commands.run(parallel_unit(sequential_unit(pause(a_moment) + unit(commands.good(0)) +
                                               parallel_unit(unit(commands.good(1)) + pause(a_moment))) +
                               unit(commands.good(2))) +
                     unit(commands.good(3)),
                 3, {"2 OK", "0 OK", "1 OK", "3 OK"});
}

void a_unit_without_a_type_only_delays(Context& context) {
    FourCommands commands{context};
    commands.run(parallel_unit(sequential_unit(pause(a_moment) + unit(commands.good(0))) + unit(commands.good(1))), 0,
                 {"1 OK", "0 OK"});
}

void delays_are_in_milliseconds_and_add_up(Context& context) {
    FourCommands commands{context};
    auto const begin = std::chrono::steady_clock::now();
    commands.run(unit(commands.good(0, a_moment)) + unit(commands.good(1, a_moment)), 1, {"0 OK", "1 OK"});
    auto const took = std::chrono::steady_clock::now() - begin;
    require(took >= std::chrono::milliseconds{2 * a_moment}, "expected two delays of " + std::to_string(a_moment) +
                                                                 " ms to take at least " + std::to_string(2 * a_moment) + " ms");
}

void a_negative_delay_is_refused(Context& context) {
    FourCommands commands{context};
    require_refusal(commands.client.execute(unit(commands.good(0, -1))), "BAD_PARAMETER");
    require_refusal(commands.client.execute(pause(-1)), "BAD_PARAMETER");
}

void a_failed_command_aborts_the_rest_of_its_sequence(Context& context) {
    FourCommands commands{context};
    commands.run(unit(commands.good(0)) + unit(commands.failing(1)) + unit(commands.good(2)) + unit(commands.good(3)), 3,
                 {"0 OK", "1 ERROR", "2 ABORT", "3 ABORT"});
}

void a_failed_branch_fails_the_unit_but_not_other_branches(Context& context) {
    FourCommands commands{context};
    commands.run(concurrent(branch({commands.failing(0), commands.good(1)}) + branch({commands.good(2, a_moment)})) +
                     unit(commands.good(3)),
                 3, {"0 ERROR", "1 ABORT", "2 OK", "3 ABORT"});
}

void release_aborts_the_rest_of_a_sequence(Context& context) {
    auto const& released = *context.two_common_components().second;
    FourCommands commands{context};
    require_ok(
        commands.client.execute(unit(commands.good(0, time_to_release)) + unit(commands.good(1)) + unit(commands.good(2))));
    require_ok(commands.client.release(released.ref));
    require_equal("the status of the first command", "OK", commands.client.status_of(commands.names[0]));
    require_equal("the status of the command for the released component", "ABORT", commands.client.status_of(commands.names[1]));
    require_equal("the status of the next command", "ABORT", commands.client.status_of(commands.names[2]));
}

}  // namespace

Clause sequence_clause() {
    return {"7.4.3.1 Command message: command units",
            {{"commands_of_a_sequence_run_in_order", "figure 10; table 15", commands_of_a_sequence_run_in_order},
             {"branches_run_in_parallel", "table 14; decision 14", branches_run_in_parallel},
             {"the_next_unit_waits_for_all_branches", "table 14; decision 14", the_next_unit_waits_for_all_branches},
             {"each_command_of_a_flat_list_is_a_branch", "XML PSM; decision 14", each_command_of_a_flat_list_is_a_branch},
             {"sequential_and_parallel_units_can_be_nested", "figure 15; tables 13 to 15; decision 14",
              sequential_and_parallel_units_can_be_nested},
             {"a_unit_without_a_type_only_delays", "table 11; decision 14", a_unit_without_a_type_only_delays},
             {"delays_are_in_milliseconds_and_add_up", "table 11; decision 15", delays_are_in_milliseconds_and_add_up},
             {"a_negative_delay_is_refused", "table 11; decision 15", a_negative_delay_is_refused},
             {"a_failed_command_aborts_the_rest_of_its_sequence", "table 8; decision 13",
              a_failed_command_aborts_the_rest_of_its_sequence},
             {"a_failed_branch_fails_the_unit_but_not_other_branches", "table 14; decision 13",
              a_failed_branch_fails_the_unit_but_not_other_branches},
             {"release_aborts_the_rest_of_a_sequence", "figure 11; decision 13", release_aborts_the_rest_of_a_sequence}}};
}

}  // namespace rois::conformance
