// A person who does what they are told, instead of playing a role.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "simulation/steering.hpp"
#include "simulation/visitor.hpp"

namespace rois::simulation {

// Minds robots as others do, but waits for none. Goes, speaks and gestures at the same time; a new way takes the place of the one
// before, words and gestures wait for those before them. What is open when they are gone has failed.
class SteeredVisitor final : public Visitor {
public:
    using Visitor::Visitor;
    ~SteeredVisitor() override;

    SharedDeed obey(Order);
    void stand_still();  // all is dropped; words and a gesture that have begun go on

private:
    using OpenDeed = std::shared_ptr<Deed>;
    struct Going {
        std::deque<Target> stops;  // none: they leave
        OpenDeed deed;
        Seconds held_up = 0;
    };
    template <class What>
    struct Turn {
        What what;
        OpenDeed deed;
        bool begun = false;
    };

    void begin(Way const&, OpenDeed);
    void begin(Say const&, OpenDeed);
    void begin(Gesture const&, OpenDeed);
    void begin(Leave const&, OpenDeed);
    void set_out(Going);

    void play(Company&) override;
    void go_on(Company&);
    void arrive();
    void give_up(std::string why);

    std::optional<Going> going_;
    std::deque<Turn<Say>> words_;
    std::deque<Turn<Gesture>> gestures_;
};

}  // namespace rois::simulation
