// The fixture of the tests with components that answer later.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/slow_component.hpp"

namespace rois {

inline ReturnCode code_of(TestedOperation const& asked) {
    return std::visit([](Outcome const& outcome) { return outcome.return_code; }, std::get<Reply>(asked.said.value()));
}

inline std::string reason_of(TestedOperation const& asked) {
    return std::visit([](Outcome const& outcome) { return outcome.reason; }, std::get<Reply>(asked.said.value()));
}

inline ComponentChange leaving(std::string ref) {
    return {{std::move(ref)}, {}, {.profiles = {common}, .frames = {}, .places = {}}};
}

inline Part confirming(Part part) {
    part.confirms_binding = true;
    return part;
}

inline Part moving(Part part) {
    part.moves = true;
    return part;
}

struct Asynchronous : testing::Test {
    World world{speech};

    SlowComponent& add(Part const& part) {
        auto component = std::make_unique<SlowComponent>(part);
        auto& slow = *component;
        world.engine->add(std::move(component));
        return slow;
    }

    using Asking = std::shared_ptr<TestedOperation>;
    static Asking begin(Application& desk, Operation const& operation, World& in) {
        return in.begin_to_say(desk.session, operation);
    }
    Asking query(Application& desk, QueryExpression condition = {}) {
        return begin(desk, Query{"route", std::move(condition)}, world);
    }
    template <class... Units>
    Asking execute(Application& desk, Units... units) {
        return begin(desk, Execute{{std::vector<CommandUnit>{std::move(units)...}}}, world);
    }
    // Handles what a component has reported.
    void work() {
        world.engine->and_work([] {}, world.now);
    }
};

}  // namespace rois
