#include "simulation/steered_visitor.hpp"

#include <algorithm>
#include <utility>

namespace rois::simulation {
namespace {

constexpr Seconds patience = 30;  // with those who are in the way
constexpr Metres at_exit = 0.5;

void drop(std::shared_ptr<Deed> const& deed) { deed->state = Deed::State::dropped; }

// Begins the next when nothing of the kind is going on, and tells of the one that has ended.
template <class Turns, class Begin>
void take_turns(Turns& turns, bool busy, Begin begin) {
    if (turns.empty() || busy) return;
    if (turns.front().begun) {
        turns.front().deed->state = Deed::State::done;
        turns.pop_front();
    }
    if (turns.empty()) return;
    turns.front().begun = true;
    begin(turns.front().what);
}

}  // namespace

SteeredVisitor::~SteeredVisitor() {
    auto const fail = [](auto const& open) { open.deed->fail("they have left"); };
    if (going_) fail(*going_);
    std::ranges::for_each(words_, fail);
    std::ranges::for_each(gestures_, fail);
}

SharedDeed SteeredVisitor::obey(Order order) {
    auto deed = std::make_shared<Deed>();
    std::visit([&](auto const& what) { begin(what, deed); }, order);
    return deed;
}

void SteeredVisitor::begin(Way const& way, OpenDeed deed) {
    set_out({.stops = {way.stops.begin(), way.stops.end()}, .deed = std::move(deed)});
}
void SteeredVisitor::begin(Leave const&, OpenDeed deed) { set_out({.stops = {}, .deed = std::move(deed)}); }
void SteeredVisitor::begin(Say const& words, OpenDeed deed) { words_.push_back({words, std::move(deed)}); }
void SteeredVisitor::begin(Gesture const& gesture, OpenDeed deed) { gestures_.push_back({gesture, std::move(deed)}); }

void SteeredVisitor::set_out(Going going) {
    stand({});
    if (going_) drop(going_->deed);
    going_ = std::move(going);
}

void SteeredVisitor::stand_still() {
    auto const drop_open = [](auto const& open) { drop(open.deed); };
    stand({});
    if (going_) drop(going_->deed);
    going_.reset();
    std::ranges::for_each(words_, drop_open);
    words_.clear();
    std::ranges::for_each(gestures_, drop_open);
    gestures_.clear();
}

void SteeredVisitor::play(Company& company) {
    take_turns(words_, person().speaking.has_value(),
               [&](Say const& words) { say(words.text, words.language.empty() ? role().language : words.language, company); });
    take_turns(gestures_, person().gesturing.has_value(), [&](Gesture const& gesture) { make_gesture(gesture.id, company); });
    if (going_) go_on(company);
}

void SteeredVisitor::go_on(Company& company) {
    bool const leaves = going_->stops.empty();
    auto const target = leaves ? Target{company.plan.exit().pose.position, {}} : going_->stops.front();
    if (leaves && distance(person().pose.position, target.position) < at_exit) return arrive();
    switch (go({target.position}, company)) {
        case Walker::Step::walking:
            return;
        case Walker::Step::waiting:
            going_->held_up += company.dt;
            if (going_->held_up >= patience) give_up("somebody is in the way");
            return;
        case Walker::Step::no_way:
            return give_up("there is no way there");
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
    going_->deed->state = Deed::State::done;
    going_.reset();
}

void SteeredVisitor::give_up(std::string why) {
    stand({});
    going_->deed->fail(std::move(why));
    going_.reset();
}

}  // namespace rois::simulation
