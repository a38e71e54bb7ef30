// What can happen in the model's world: three service applications, three components, and time.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace rois::model {

inline constexpr int session_count = 3;
// `navigation` and `speech` act until they are told to end; `detection` becomes active; there is no `nobody`.
inline constexpr std::array<std::string_view, 4> refs{"navigation", "speech", "detection", "nobody"};
inline constexpr int detection = 2, nobody = 3;

// One command of a sequence.
struct Order {
    std::string_view type;  // start, stop, suspend, resume, dance
    int component = 0;      // of refs
    char name = 'a';        // its command_id
    int delay = 0;          // in ticks
};
using Orders = std::vector<Order>;  // one after the other
using Unit = std::vector<Orders>;   // side by side; a single command is one branch of one
using Plan = std::vector<Unit>;

enum class Kind : std::uint8_t {
    connect,
    disconnect,
    bind,
    release,
    get_parameter,
    set_parameter,
    query_parameters,  // the query get_parameter
    execute,
    get_command_result,
    component_status,
    subscribe,
    unsubscribe,
    finish,  // the component's action comes to its end: OK, or ERROR when `number` is odd
    fire,    // detection tells its event
    pass     // time goes by: `number` ticks
};

struct Step {
    Kind kind = Kind::pass;
    int session = 0;
    int component = 0;
    int number = 0;  // of set_parameter: the value, or bad when it is negative
    char name = 'a';
    Plan plan{};
};
using Steps = std::vector<Step>;

std::ostream& operator<<(std::ostream&, Step const&);
std::string in_lines(Steps const&);

Step random_step(std::mt19937_64&);
Steps random_steps(std::uint64_t seed, std::size_t count);

}  // namespace rois::model
