#include "model/step.hpp"

#include <sstream>

namespace rois::model {

namespace {

// Unlike the distributions of the standard library, this gives the same numbers on every machine.
int below(std::mt19937_64& random, int bound) { return static_cast<int>(random() % static_cast<std::uint64_t>(bound)); }

int any_component(std::mt19937_64& random) { return below(random, 20) == 0 ? nobody : below(random, 3); }

// Mostly for the component `home`, so that many orders are allowed.
Order random_order(std::mt19937_64& random, int home) {
    static constexpr std::array<std::string_view, 10> types{"start", "start", "start",   "start",  "stop",
                                                            "stop",  "stop",  "suspend", "resume", "dance"};
    auto const type = types[static_cast<std::size_t>(below(random, below(random, 10) == 0 ? 10 : 9))];
    auto const component = below(random, 5) == 0 ? any_component(random) : home;
    auto const name = static_cast<char>('a' + below(random, 12));
    return {type, component, name, below(random, 3) == 0 ? 1 + below(random, 3) : 0};
}

Orders random_orders(std::mt19937_64& random, int home) {
    Orders orders;
    for (int i = below(random, 3); i >= 0; --i) orders.push_back(random_order(random, home));
    return orders;
}

Plan random_plan(std::mt19937_64& random) {
    Plan plan;
    auto const home = below(random, 3);
    for (int i = below(random, 3); i >= 0; --i) {
        if (below(random, 4) == 0) {
            plan.push_back({random_orders(random, home), random_orders(random, home)});
        } else {
            plan.push_back({{random_order(random, home)}});
        }
    }
    return plan;
}

std::ostream& operator<<(std::ostream& out, Orders const& orders) {
    for (std::size_t i = 0; i < orders.size(); ++i) {
        auto const& order = orders[i];
        if (order.delay > 0) out << "after " << order.delay << " ";
        out << order.name << ":" << order.type << " " << refs[static_cast<std::size_t>(order.component)]
            << (i + 1 < orders.size() ? ", " : "");
    }
    return out;
}

std::ostream& operator<<(std::ostream& out, Plan const& plan) {
    for (auto const& unit : plan) {
        if (unit.size() == 1) {
            out << " (" << unit.front() << ")";
        } else {
            out << " (" << unit[0] << " | " << unit[1] << ")";
        }
    }
    return out;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, Step const& step) {
    static constexpr std::array<std::string_view, 15> names{"connect",
                                                            "disconnect",
                                                            "bind",
                                                            "release",
                                                            "get_parameter",
                                                            "set_parameter",
                                                            "query get_parameter",
                                                            "execute",
                                                            "get_command_result",
                                                            "component_status",
                                                            "subscribe",
                                                            "unsubscribe",
                                                            "finish",
                                                            "fire",
                                                            "pass"};
    auto const name = names[static_cast<std::size_t>(step.kind)];
    auto const ref = refs[static_cast<std::size_t>(step.component)];
    switch (step.kind) {
        case Kind::pass:
            return out << "pass " << step.number;
        case Kind::fire:
            return out << "detection fires";
        case Kind::finish:
            return out << ref << " finishes with " << (step.number % 2 == 0 ? "OK" : "ERROR");
        default:
            break;
    }
    out << "application " << step.session << ": " << name;
    switch (step.kind) {
        case Kind::bind:
        case Kind::release:
        case Kind::get_parameter:
        case Kind::query_parameters:
        case Kind::component_status:
            return out << " " << ref;
        case Kind::set_parameter:
            return out << " " << ref << " " << (step.number < 0 ? "bad" : std::to_string(step.number));
        case Kind::execute:
            return out << step.plan;
        case Kind::get_command_result:
            return out << " " << step.name;
        default:
            return out;
    }
}

std::string in_lines(Steps const& steps) {
    std::ostringstream text;
    for (auto const& step : steps) text << "  " << step << "\n";
    return text.str();
}

Step random_step(std::mt19937_64& random) {
    static constexpr std::array<Kind, 31> kinds{Kind::connect,
                                                Kind::connect,
                                                Kind::disconnect,
                                                Kind::bind,
                                                Kind::bind,
                                                Kind::bind,
                                                Kind::release,
                                                Kind::get_parameter,
                                                Kind::set_parameter,
                                                Kind::set_parameter,
                                                Kind::query_parameters,
                                                Kind::execute,
                                                Kind::execute,
                                                Kind::execute,
                                                Kind::execute,
                                                Kind::execute,
                                                Kind::execute,
                                                Kind::execute,
                                                Kind::execute,
                                                Kind::get_command_result,
                                                Kind::get_command_result,
                                                Kind::component_status,
                                                Kind::subscribe,
                                                Kind::unsubscribe,
                                                Kind::finish,
                                                Kind::finish,
                                                Kind::finish,
                                                Kind::fire,
                                                Kind::pass,
                                                Kind::pass,
                                                Kind::pass};
    Step step;
    step.kind = kinds[static_cast<std::size_t>(below(random, kinds.size()))];
    step.session = below(random, 10) < 6 ? 0 : below(random, session_count);
    // Ends are rare, so that there is something to end.
    if (step.kind == Kind::disconnect && below(random, 5) != 0) step.kind = Kind::bind;
    if (step.kind == Kind::release && below(random, 3) != 0) step.kind = Kind::execute;
    step.component = any_component(random);
    step.number = below(random, 8) - 1;
    step.name = static_cast<char>('a' + below(random, 12));
    if (step.kind == Kind::execute) step.plan = random_plan(random);
    if (step.kind == Kind::pass) step.number = 1 + below(random, 3);
    if (step.kind == Kind::finish && step.component >= detection) step.component = 0;
    if (step.kind == Kind::set_parameter && step.component == detection) step.component = 1;
    return step;
}

Steps random_steps(std::uint64_t seed, std::size_t count) {
    std::mt19937_64 random{seed};
    Steps steps;
    steps.reserve(count);
    for (std::size_t i = 0; i < count; ++i) steps.push_back(random_step(random));
    return steps;
}

}  // namespace rois::model
