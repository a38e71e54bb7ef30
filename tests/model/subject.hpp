// The engine with scripted components and a simulated clock, driven by the same steps as the reference.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/world.hpp"
#include "model/step.hpp"

namespace rois::model {

class Subject {
public:
    Subject();

    // Returns the answer to the step, in the reference's form.
    std::string take(Step const&);
    // Returns the notifications of the application since the last call, or nullopt if it has no session.
    std::optional<std::vector<std::string>> received(int session);

private:
    struct Seat {
        std::optional<Application> application;  // the last one with this number
        bool is_connected = false;
        SubscribeId subscription{"none"};
    };

    std::variant<Reply, Refusal> say(Seat const&, Operation const&);
    std::string answer(Seat&, Operation const&);
    std::string read_parameter(Seat&, int component);
    std::string query_parameters(Seat&, int component);
    std::string result_of(Seat&, char name);
    std::string status_of(Seat&, int component);

    World world_;
    std::array<Seat, session_count> seats_;
};

}  // namespace rois::model
