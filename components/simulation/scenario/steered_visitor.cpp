#include "simulation/scenario/steered_visitor.hpp"

#include <algorithm>
#include <utility>

namespace rois::simulation {
namespace {

constexpr Seconds patience = 30;  // maximum wait for a blocked way
constexpr Metres at_exit = 0.5;

void drop(std::shared_ptr<OrderStatus> const& status) { status->state = OrderStatus::State::dropped; }

// Marks an ended order as done, and begins the next one. Does nothing while `busy`.
template <class Turns, class Begin>
void take_turns(Turns& turns, bool busy, Begin begin) {
    if (turns.empty() || busy) return;
    if (turns.front().begun) {
        turns.front().status->state = OrderStatus::State::done;
        turns.pop_front();
    }
    if (turns.empty()) return;
    turns.front().begun = true;
    begin(turns.front().what);
}

}  // namespace

SteeredVisitor::~SteeredVisitor() {
    auto const fail = [](auto const& open) { open.status->fail("the visitor has left the hall"); };
    if (going_) fail(*going_);
    std::ranges::for_each(words_, fail);
    std::ranges::for_each(gestures_, fail);
}

SharedOrderStatus SteeredVisitor::obey(Order order) {
    auto status = std::make_shared<OrderStatus>();
    std::visit([&](auto const& what) { begin(what, status); }, order);
    return status;
}

void SteeredVisitor::begin(Way const& way, OpenOrder status) {
    set_out({.stops = {way.stops.begin(), way.stops.end()}, .status = std::move(status)});
}
void SteeredVisitor::begin(Leave const&, OpenOrder status) { set_out({.stops = {}, .status = std::move(status)}); }
void SteeredVisitor::begin(Say const& words, OpenOrder status) { words_.push_back({words, std::move(status)}); }
void SteeredVisitor::begin(Gesture const& gesture, OpenOrder status) { gestures_.push_back({gesture, std::move(status)}); }

void SteeredVisitor::set_out(Going going) {
    stand({});
    if (going_) drop(going_->status);
    going_ = std::move(going);
}

void SteeredVisitor::stand_still() {
    auto const drop_open = [](auto const& open) { drop(open.status); };
    stand({});
    if (going_) drop(going_->status);
    going_.reset();
    std::ranges::for_each(words_, drop_open);
    words_.clear();
    std::ranges::for_each(gestures_, drop_open);
    gestures_.clear();
}

void SteeredVisitor::play(VisitorSurroundings& around) {
    take_turns(words_, person().speaking.has_value(),
               [&](Say const& words) { say(words.text, words.language.empty() ? role().language : words.language, around); });
    take_turns(gestures_, person().gesturing.has_value(), [&](Gesture const& gesture) { make_gesture(gesture.id, around); });
    if (going_) go_on(around);
}

void SteeredVisitor::go_on(VisitorSurroundings& around) {
    bool const leaves = going_->stops.empty();
    auto const target = leaves ? Target{around.plan.exit().pose.position, {}} : going_->stops.front();
    if (leaves && distance(person().pose.position, target.position) < at_exit) return arrive();
    switch (go({target.position}, around)) {
        case Walker::Step::walking:
            return;
        case Walker::Step::waiting:
            going_->held_up += around.dt;
            if (going_->held_up >= patience) give_up("a person or robot is in the way");
            return;
        case Walker::Step::no_way:
            return give_up("no way leads there");
        case Walker::Step::arrived:
            return arrive();
    }
}

void SteeredVisitor::arrive() {
    if (going_->stops.empty()) {
        go_out();
    } else {
        stand(going_->stops.front().heading);
        going_->stops.pop_front();
        if (!going_->stops.empty()) return;
    }
    going_->status->state = OrderStatus::State::done;
    going_.reset();
}

void SteeredVisitor::give_up(std::string reason) {
    stand({});
    going_->status->fail(std::move(reason));
    going_.reset();
}

}  // namespace rois::simulation
