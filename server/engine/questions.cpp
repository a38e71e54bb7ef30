#include "engine/questions.hpp"

#include <algorithm>
#include <utility>

#include "engine/registry.hpp"

namespace rois {

namespace {

class Collected final : public Questions::Round {
public:
    Collected(std::size_t questions, Questions::Then then) : then_{std::move(then)}, answers_(questions) {}

private:
    void take(std::size_t place, std::optional<ComponentAnswer>&& answer) override { answers_[place] = std::move(answer); }
    void end(Instant now) override { std::exchange(then_, {})(answers_, now); }

    Questions::Then then_;
    Questions::Answers answers_;
};

}  // namespace

std::shared_ptr<Questions::Round> Questions::begin(Steady due, std::size_t questions, Then then) {
    auto round = std::make_shared<Collected>(questions, std::move(then));
    begin(*round, due);
    return round;
}

Ticket Questions::add(std::shared_ptr<Round> round, std::size_t place, RegisteredComponent& component, char const* what) {
    auto const ticket = fresh_ticket();
    auto& asked = *round;
    open_.push_back({ticket, std::move(round), place, component.shared_from_this(), what});
    ++asked.unanswered_;
    return ticket;
}

Ticket Questions::ask(RegisteredComponent& component, Steady due, char const* what,
                      std::function<void(std::optional<ComponentAnswer>&, Instant now)> then) {
    auto const round = begin(due, 1, [then = std::move(then)](Answers& answers, Instant now) { then(answers.front(), now); });
    return add(round, 0, component, what);
}

bool Questions::answered(Ticket ticket, ComponentAnswer&& answer, Instant now) {
    auto const found = std::ranges::lower_bound(open_, ticket, {}, &Open::ticket);
    if (found == open_.end() || found->ticket != ticket) return false;
    auto const open = std::move(*found);
    open_.erase(found);
    open.round->take(open.place, std::move(answer));
    if (--open.round->unanswered_ == 0) open.round->end(now);
    return true;
}

bool Questions::is_open(Ticket ticket) const { return std::ranges::binary_search(open_, ticket, {}, &Open::ticket); }

void Questions::expire(Instant now) {
    std::vector<std::shared_ptr<Round>> over;
    std::erase_if(open_, [&](Open const& open) {
        auto const& round = open.round;
        if (now.steady < round->due_) return false;
        open.component->report_silence(open.what);
        round->take(open.place, {});
        if (--round->unanswered_ == 0) over.push_back(round);
        return true;
    });
    for (auto const& round : over) round->end(now);
}

void Questions::fail_all(RegisteredComponent const& component, Instant now) {
    std::vector<Ticket> tickets;
    for (auto const& open : open_)
        if (open.component.get() == &component) tickets.push_back(open.ticket);
    for (auto const ticket : tickets) answered(ticket, Failed{"the component was removed"}, now);
}

}  // namespace rois
