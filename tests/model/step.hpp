// The steps in the model's world: three service applications, three components, and time.
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
// `navigation` and `speech` act until a step ends it; `detection` becomes active; `nobody` does not exist.
inline constexpr std::array<std::string_view, 4> refs{"navigation", "speech", "detection", "nobody"};
inline constexpr int detection = 2, nobody = 3;

// One command of a sequence.
struct Order {
    std::string_view type;  // start, stop, suspend, resume, dance
    int component = 0;      // index in refs
    char name = 'a';        // its command_id
    int delay = 0;          // in ticks
};
using Orders = std::vector<Order>;  // in sequence
using Unit = std::vector<Orders>;   // in parallel; a single command is one branch with one order
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
    finish,  // the component's action ends: OK, or ERROR if `number` is odd
    fire,    // detection reports its event
    pass     // time passes: `number` ticks
};

struct Step {
    Kind kind = Kind::pass;
    int session = 0;
    int component = 0;
    int number = 0;  // of set_parameter: the value; invalid if negative
    char name = 'a';
    Plan plan{};
};
using Steps = std::vector<Step>;

std::ostream& operator<<(std::ostream&, Step const&);
std::string in_lines(Steps const&);

Step random_step(std::mt19937_64&);
Steps random_steps(std::uint64_t seed, std::size_t count);

}  // namespace rois::model
