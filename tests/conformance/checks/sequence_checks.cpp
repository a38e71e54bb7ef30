// Sequential and parallel command units (7.4.3.1, tables 10 to 15; figures 10 and 15; decisions 13 to 15).
#include <algorithm>
#include <chrono>

#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

using kit::branch;
using kit::command_list;
using kit::concurrent;
using kit::one_after_another;
using kit::pause;
using kit::side_by_side;
using kit::unit;

constexpr int a_moment = 80;          // ms
constexpr int time_to_release = 500;  // ms, before the next command's turn

// Two components whose parameters can be set at once, and names for four commands.
class Cast {
public:
    explicit Cast(Stage& stage) : guest{stage}, pair_{stage.two_common()} {
        guest.take(*pair_.first);
        guest.take(*pair_.second);
    }

    Command good(std::size_t number, std::optional<int> delay = {}) const {
        return command(number % 2 == 0 ? *pair_.first : *pair_.second, "stop", names[number], delay);
    }
    Command failing(std::size_t number) const { return command(*pair_.first, "resume", names[number]); }

    // Plays the units until this command completes, and requires this history: "0 OK", "2 ABORT".
    void play(kit::Xml const& units, std::size_t last, std::vector<std::string> const& expected) {
        ok(guest.execute(units));
        guest.status_of(names[last]);
        std::vector<std::string> heard;
        for (auto const& one : guest.history()) {
            auto const found = std::ranges::find(names, one.text("command_id"));
            if (found != names.end()) heard.push_back(std::to_string(found - names.begin()) + " " + one.text("status"));
        }
        require(heard == expected, "expected are " + list(expected) + ", completed are " + list(heard));
    }

    Guest guest;
    std::vector<std::string> names{unique_name(), unique_name(), unique_name(), unique_name()};

private:
    std::pair<Component const*, Component const*> pair_;
};

void commands_run_one_after_the_other(Stage& stage) {
    Cast cast{stage};
    cast.play(unit(cast.good(0, a_moment)) + unit(cast.good(1)) + unit(cast.good(2)), 2, {"0 OK", "1 OK", "2 OK"});
}

void branches_run_side_by_side(Stage& stage) {
    Cast cast{stage};
    cast.play(concurrent(branch({cast.good(0, a_moment), cast.good(1)}) + branch({cast.good(2)})), 1, {"2 OK", "0 OK", "1 OK"});
}

void what_follows_waits_for_all_branches(Stage& stage) {
    Cast cast{stage};
    cast.play(concurrent(branch({cast.good(0, a_moment)}) + branch({cast.good(1)})) + unit(cast.good(2)), 2,
              {"1 OK", "0 OK", "2 OK"});
}

void each_of_a_flat_list_is_a_branch(Stage& stage) {
    Cast cast{stage};
    cast.play(concurrent(command_list(cast.good(0, a_moment)) + command_list(cast.good(1))), 0, {"1 OK", "0 OK"});
}

void units_nest_freely(Stage& stage) {
    Cast cast{stage};
    cast.play(side_by_side(
                  one_after_another(pause(a_moment) + unit(cast.good(0)) + side_by_side(unit(cast.good(1)) + pause(a_moment))) +
                  unit(cast.good(2))) +
                  unit(cast.good(3)),
              3, {"2 OK", "0 OK", "1 OK", "3 OK"});
}

void a_unit_without_a_type_only_delays(Stage& stage) {
    Cast cast{stage};
    cast.play(side_by_side(one_after_another(pause(a_moment) + unit(cast.good(0))) + unit(cast.good(1))), 0, {"1 OK", "0 OK"});
}

void a_delay_is_in_milliseconds_from_the_turn(Stage& stage) {
    Cast cast{stage};
    auto const begin = std::chrono::steady_clock::now();
    cast.play(unit(cast.good(0, a_moment)) + unit(cast.good(1, a_moment)), 1, {"0 OK", "1 OK"});
    auto const took = std::chrono::steady_clock::now() - begin;
    require(took >= std::chrono::milliseconds{2 * a_moment},
            "two delays of " + std::to_string(a_moment) + " ms were over too soon");
}

void a_delay_is_not_negative(Stage& stage) {
    Cast cast{stage};
    refused(cast.guest.execute(unit(cast.good(0, -1))), "BAD_PARAMETER");
    refused(cast.guest.execute(pause(-1)), "BAD_PARAMETER");
}

void a_failure_ends_its_sequence(Stage& stage) {
    Cast cast{stage};
    cast.play(unit(cast.good(0)) + unit(cast.failing(1)) + unit(cast.good(2)) + unit(cast.good(3)), 3,
              {"0 OK", "1 ERROR", "2 ABORT", "3 ABORT"});
}

void other_branches_run_on_and_the_unit_fails(Stage& stage) {
    Cast cast{stage};
    cast.play(concurrent(branch({cast.failing(0), cast.good(1)}) + branch({cast.good(2, a_moment)})) + unit(cast.good(3)), 3,
              {"0 ERROR", "1 ABORT", "2 OK", "3 ABORT"});
}

void a_binding_lost_on_the_way_aborts_the_rest(Stage& stage) {
    auto const& released = *stage.two_common().second;
    Cast cast{stage};
    ok(cast.guest.execute(unit(cast.good(0, time_to_release)) + unit(cast.good(1)) + unit(cast.good(2))));
    ok(cast.guest.release(released.ref));
    same("the status of the first command", "OK", cast.guest.status_of(cast.names[0]));
    same("the status of the command for the released component", "ABORT", cast.guest.status_of(cast.names[1]));
    same("the status of what followed", "ABORT", cast.guest.status_of(cast.names[2]));
}

}  // namespace

Clause sequence_clause() {
    return {"7.4.3.1 Command message: command units",
            {{"commands_run_one_after_the_other", "figure 10; table 15", commands_run_one_after_the_other},
             {"branches_run_side_by_side", "table 14; decision 14", branches_run_side_by_side},
             {"what_follows_waits_for_all_branches", "table 14; decision 14", what_follows_waits_for_all_branches},
             {"each_of_a_flat_list_is_a_branch", "XML PSM; decision 14", each_of_a_flat_list_is_a_branch},
             {"units_nest_freely", "figure 15; tables 13 to 15; decision 14", units_nest_freely},
             {"a_unit_without_a_type_only_delays", "table 11; decision 14", a_unit_without_a_type_only_delays},
             {"a_delay_is_in_milliseconds_from_the_turn", "table 11; decision 15", a_delay_is_in_milliseconds_from_the_turn},
             {"a_delay_is_not_negative", "table 11; decision 15", a_delay_is_not_negative},
             {"a_failure_ends_its_sequence", "table 8; decision 13", a_failure_ends_its_sequence},
             {"other_branches_run_on_and_the_unit_fails", "table 14; decision 13", other_branches_run_on_and_the_unit_fails},
             {"a_binding_lost_on_the_way_aborts_the_rest", "figure 11; decision 13", a_binding_lost_on_the_way_aborts_the_rest}}};
}

}  // namespace rois::conformance
