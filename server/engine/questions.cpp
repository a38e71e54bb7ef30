#include "engine/questions.hpp"

#include <utility>

#include "engine/registry.hpp"

namespace rois {

struct Questions::Round {
    Steady due;
    Then then;
    Answers answers;
    std::size_t unanswered = 0;
};

std::shared_ptr<Questions::Round> Questions::begin(Steady due, Then then) {
    return std::make_shared<Round>(Round{due, std::move(then), {}});
}

Ticket Questions::add(std::shared_ptr<Round> const& round, RegisteredComponent& component, char const* what) {
    auto const ticket = fresh_ticket();
    open_.emplace(last_, Open{round, round->answers.size(), component.shared_from_this(), what});
    round->answers.emplace_back();
    ++round->unanswered;
    return ticket;
}

Ticket Questions::ask(RegisteredComponent& component, Steady due, char const* what,
                      std::function<void(std::optional<ComponentAnswer>&, Instant now)> then) {
    auto const round = begin(due, [then = std::move(then)](Answers& answers, Instant now) { then(answers.front(), now); });
    return add(round, component, what);
}

void Questions::end_if_empty(std::shared_ptr<Round> const& round, Instant now) {
    if (round->unanswered == 0) finish(*round, now);
}

bool Questions::answered(Ticket ticket, ComponentAnswer&& answer, Instant now) {
    auto const node = open_.extract(static_cast<std::uint64_t>(ticket));
    if (!node) return false;
    auto const& [round, place, component, what] = node.mapped();
    round->answers[place] = std::move(answer);
    if (--round->unanswered == 0) finish(*round, now);
    return true;
}

void Questions::finish(Round& round, Instant now) { std::exchange(round.then, {})(round.answers, now); }

void Questions::expire(Instant now) {
    std::vector<std::shared_ptr<Round>> over;
    std::erase_if(open_, [&](auto const& entry) {
        auto const& open = entry.second;
        if (now.steady < open.round->due) return false;
        open.component->report_silence(open.what);
        if (open.round->unanswered > 0) over.push_back(open.round);
        open.round->unanswered = 0;
        return true;
    });
    for (auto const& round : over) finish(*round, now);
}

void Questions::fail_all(RegisteredComponent const& component, Instant now) {
    std::vector<std::uint64_t> tickets;
    for (auto const& [ticket, open] : open_)
        if (open.component.get() == &component) tickets.push_back(ticket);
    for (auto const ticket : tickets) answered(Ticket{ticket}, Failed{"the component was removed"}, now);
}

}  // namespace rois
