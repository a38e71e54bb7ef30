#include "model/difference.hpp"

#include "model/subject.hpp"

namespace rois::model {

namespace {

std::string in_words(int session, std::vector<std::string> const& notifications) {
    std::string text = "application " + std::to_string(session) + " receives";
    for (auto const& one : notifications) text += " [" + one + "]";
    return notifications.empty() ? text + " nothing" : text;
}

// Returns the difference that the last step shows, if any.
std::optional<Difference> compare(Step const& step, Reference& reference, Subject& subject) {
    auto const expected = reference.take(step), found = subject.take(step);
    if (expected != found) return Difference{{}, expected, found};
    for (int i = 0; i < session_count; ++i) {
        auto const due = reference.received(i), notifications = subject.received(i);
        if (due != notifications)
            return Difference{{},
                              in_words(i, due.value_or(std::vector<std::string>{})),
                              in_words(i, notifications.value_or(std::vector<std::string>{}))};
    }
    return {};
}

// All plans with one part of a sequence removed.
std::vector<Plan> smaller(Plan const& plan) {
    std::vector<Plan> all;
    for (std::size_t u = 0; u < plan.size(); ++u) {
        if (plan.size() > 1) {
            all.push_back(plan);
            all.back().erase(all.back().begin() + static_cast<std::ptrdiff_t>(u));
        }
        for (std::size_t b = 0; b < plan[u].size(); ++b) {
            if (plan[u].size() > 1) all.push_back(plan), all.back()[u] = {{plan[u][b].front()}};
            for (std::size_t c = 0; plan[u][b].size() > 1 && c < plan[u][b].size(); ++c) {
                all.push_back(plan);
                auto& branch = all.back()[u][b];
                branch.erase(branch.begin() + static_cast<std::ptrdiff_t>(c));
            }
            for (std::size_t c = 0; c < plan[u][b].size(); ++c)
                if (plan[u][b][c].delay > 0) all.push_back(plan), all.back()[u][b][c].delay = 0;
        }
    }
    return all;
}

// Removes stretches of this length where the difference remains.
bool leave_out(Difference& known, std::size_t length, Flaw flaw) {
    bool is_shorter = false;
    for (std::size_t begin = 0; begin + length <= known.steps.size();) {
        auto steps = known.steps;
        steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(begin),
                    steps.begin() + static_cast<std::ptrdiff_t>(begin + length));
        if (auto still = difference(steps, flaw)) {
            known = std::move(*still);
            is_shorter = true;
        } else {
            ++begin;
        }
    }
    return is_shorter;
}

bool simplify_a_plan(Difference& known, Flaw flaw) {
    for (std::size_t i = 0; i < known.steps.size(); ++i)
        for (auto const& plan : smaller(known.steps[i].plan)) {
            auto steps = known.steps;
            steps[i].plan = plan;
            if (auto still = difference(steps, flaw)) {
                known = std::move(*still);
                return true;
            }
        }
    return false;
}

}  // namespace

std::string Difference::in_words() const {
    return "after\n" + in_lines(steps) + "expected: " + expected + "\nfound:    " + found;
}

std::optional<Difference> difference(Steps const& steps, Flaw flaw) {
    Reference reference{flaw};
    Subject subject;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        auto found = compare(steps[i], reference, subject);
        if (!found) continue;
        found->steps.assign(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(i + 1));
        return found;
    }
    return {};
}

Difference shrunk(Difference known, Flaw flaw) {
    for (bool is_shorter = true; is_shorter;) {
        is_shorter = false;
        for (auto length = known.steps.size() / 2; length > 0; length /= 2)
            is_shorter = leave_out(known, length, flaw) || is_shorter;
        while (simplify_a_plan(known, flaw)) is_shorter = true;
    }
    return known;
}

}  // namespace rois::model
