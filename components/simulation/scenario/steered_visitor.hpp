// A visitor who follows orders instead of a scenario.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "simulation/scenario/steering.hpp"
#include "simulation/scenario/visitor.hpp"

namespace rois::simulation {

// Answers robots like other visitors, but does not wait for them. Walks, speaks and gestures at the same time. A new way replaces
// the previous one; speech and gestures are queued. Orders that are open when the visitor leaves fail.
class SteeredVisitor final : public Visitor {
public:
    using Visitor::Visitor;
    ~SteeredVisitor() override;

    SharedOrderStatus obey(Order);
    void stand_still();  // drops all orders; speech and gestures in progress continue

private:
    using OpenOrder = std::shared_ptr<OrderStatus>;
    struct Going {
        std::deque<Target> stops;  // empty: leaves the hall
        OpenOrder status;
        Seconds held_up = 0;
    };
    template <class What>
    struct Turn {
        What what;
        OpenOrder status;
        bool begun = false;
    };

    void begin(Way const&, OpenOrder);
    void begin(Say const&, OpenOrder);
    void begin(Gesture const&, OpenOrder);
    void begin(Leave const&, OpenOrder);
    void set_out(Going);

    void play(VisitorSurroundings&) override;
    void go_on(VisitorSurroundings&);
    void arrive();
    void give_up(std::string reason);

    std::optional<Going> going_;
    std::deque<Turn<Say>> words_;
    std::deque<Turn<Gesture>> gestures_;
};

}  // namespace rois::simulation
