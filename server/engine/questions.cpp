#include "engine/questions.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/attempts.hpp"
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
    Attempts attempts;
    end(open, std::move(answer), now, attempts);
    attempts.rethrow();
    return true;
}

// A round ends even if it fails to take an answer.
void Questions::end(Open const& question, std::optional<ComponentAnswer>&& answer, Instant now, Attempts& attempts) {
    auto& round = *question.round;
    attempts([&] { round.take(question.place, std::move(answer)); });
    if (--round.unanswered_ == 0) attempts([&] { round.end(now); });
}

bool Questions::is_open(Ticket ticket) const { return std::ranges::binary_search(open_, ticket, {}, &Open::ticket); }

void Questions::expire(Instant now) {
    auto const is_in_time = [&](Open const& open) { return now.steady < open.round->due_; };
    std::vector<Open> over;
    over.reserve(open_.size() - static_cast<std::size_t>(std::ranges::count_if(open_, is_in_time)));  // nothing has changed yet
    auto const late = std::ranges::stable_partition(open_, is_in_time);
    std::ranges::move(late, std::back_inserter(over));
    open_.erase(late.begin(), late.end());
    Attempts attempts;
    for (auto const& question : over) {
        attempts([&] { question.component->report_silence(question.what, now.steady); });
        end(question, {}, now, attempts);
    }
    attempts.rethrow();
}

void Questions::fail_all(RegisteredComponent const& component, Instant now) {
    std::vector<Ticket> tickets;
    for (auto const& open : open_)
        if (open.component.get() == &component) tickets.push_back(open.ticket);
    for (auto const ticket : tickets) answered(ticket, Failed{"the component was removed"}, now);
}

}  // namespace rois
