#include "choosing/fusion/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "choosing/fusion/assignment.hpp"

namespace rois::choosing {
namespace {

// Persons with fewer common measurements are not merged.
constexpr int least_samples = 3;

bool is_ripe(Contact const& contact, Matching const& matching, Steady when) {
    return contact.close_since && contact.samples >= least_samples && when - *contact.close_since >= matching.decides_after;
}

std::size_t index_of(std::vector<std::uint64_t>& ids, std::uint64_t id) {
    auto const found = std::ranges::find(ids, id);
    if (found == ids.end()) ids.push_back(id);
    return static_cast<std::size_t>(std::ranges::find(ids, id) - ids.begin());
}

}  // namespace

void Contacts::update(Persons const& persons, Matching const& matching, Steady when) {
    ++round_;
    std::vector<Person const*> sensed;
    for (auto const& [id, person] : persons)
        if (person.is_sensed()) sensed.push_back(&person);
    // Sorted along x, so that only neighbours are compared.
    std::ranges::sort(sensed, {}, [](Person const* p) { return p->now.position.mean.x(); });
    for (std::size_t i = 0; i < sensed.size(); ++i) {
        double const limit = sensed[i]->now.position.mean.x() + matching.never_beyond;
        for (std::size_t j = i + 1; j < sensed.size() && sensed[j]->now.position.mean.x() <= limit; ++j)
            update(*sensed[i], *sensed[j], matching, when);
    }
    std::erase_if(all_, [&](auto const& entry) { return entry.second.round != round_; });
}

void Contacts::update(Person const& a, Person const& b, Matching const& matching, Steady when) {
    double const distance = gap(matching, a.now, b.now);
    if (distance > matching.apart_beyond || share_a_unit(a, b)) return;
    Contact& contact = all_[{std::min(a.id, b.id), std::max(a.id, b.id)}];
    contact.round = round_;
    // Persons who pass each other are near for a moment, but walk differently.
    double const of_speed = deviations_apart(a.now.velocity, b.now.velocity);
    if (distance > matching.same_within || of_speed > matching.same_speed_within) {
        contact.close_since.reset();
        return;
    }
    if (!contact.close_since) {
        contact.close_since = when;
        contact.squares = 0;
        contact.samples = 0;
    }
    contact.squares += distance * distance + of_speed * of_speed;
    ++contact.samples;
}

bool Contacts::has(std::uint64_t person) const {
    return std::ranges::any_of(all_, [&](auto const& c) { return c.first.first == person || c.first.second == person; });
}

void Contacts::erase(std::uint64_t person) {
    std::erase_if(all_, [&](auto const& c) { return c.first.first == person || c.first.second == person; });
}

std::vector<Contacts::Key> Contacts::decided(Persons const& persons, Matching const& matching, int units, Steady when) const {
    if (std::ranges::none_of(all_, [&](auto const& c) { return is_ripe(c.second, matching, when); })) return {};
    std::vector<Key> decided;
    std::set<std::uint64_t> taken;
    for (int unit = 0; unit < units; ++unit) {
        for (auto const& pair : decided_for(unit, taken, persons, matching, when)) {
            decided.push_back(pair);
            taken.insert({pair.first, pair.second});
        }
    }
    return decided;
}

std::vector<Contacts::Key> Contacts::decided_for(int unit, std::set<std::uint64_t> const& taken, Persons const& persons,
                                                 Matching const& matching, Steady when) const {
    struct Pair {
        std::size_t row;
        std::size_t column;
        Contact const* contact;
    };
    std::vector<std::uint64_t> rows;     // persons whom the unit senses
    std::vector<std::uint64_t> columns;  // persons whom it does not sense
    std::vector<Pair> pairs;
    for (auto const& [key, contact] : all_) {
        auto const [first, second] = key;
        bool const sensed = persons.at(first).is_sensed_by(unit);
        if (sensed == persons.at(second).is_sensed_by(unit) || !contact.close_since) continue;
        if (taken.contains(first) || taken.contains(second)) continue;
        pairs.push_back({index_of(rows, sensed ? first : second), index_of(columns, sensed ? second : first), &contact});
    }
    // Contacts that are not ripe compete, too: a person waits for the better partner.
    Costs costs{rows.size(), columns.size()};
    double const worst = 4 * matching.same_within * matching.same_within;
    for (auto const& [row, column, contact] : pairs) costs.at(row, column) = contact->cost() - worst;
    auto const chosen = best_pairs(costs);
    std::vector<Key> decided;
    for (auto const& [row, column, contact] : pairs)
        if (chosen[row] == column && is_ripe(*contact, matching, when)) decided.emplace_back(rows[row], columns[column]);
    return decided;
}

}  // namespace rois::choosing
