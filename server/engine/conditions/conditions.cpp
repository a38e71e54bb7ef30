// How operations use their conditions (decisions 4, 18, 19).
#include <algorithm>
#include <utility>

#include "engine/commands/preference.hpp"
#include "engine/conditions/filter.hpp"
#include "engine/core.hpp"

namespace rois {

bool Engine::Core::may_ever_match(Filter const& filter, ComponentsInOrder possible, Session const& asker) const {
    auto ever = perspective(&asker, Perspective::Of::ever);
    while (auto const* component = possible.next())
        if (filter.match(ever.candidate(*component)) != Match::no) return true;
    return false;
}

namespace {

// Sorts `components` in the order of the selection. The sort is stable.
void sort(std::vector<RegisteredComponent*>& components, Selection const& selection, Perspective& looked_at) {
    std::vector<Candidate const*> candidates;
    candidates.reserve(components.size());
    for (auto const* component : components) candidates.push_back(&looked_at.candidate(*component));
    std::vector<RegisteredComponent*> sorted;
    sorted.reserve(components.size());
    for (auto const place : selection.order(candidates)) sorted.push_back(components[place]);
    components = std::move(sorted);
}

}  // namespace

std::vector<RegisteredComponent*> Engine::Core::select(Selection const& selection, Session const& asker) const {
    auto present = perspective(&asker, Perspective::Of::present);
    auto const does_not_match = [&](auto const* component) {
        return selection.match(present.candidate(*component)) != Match::yes;
    };
    auto found = registry_.possible(selection.filter().demand(), seen_by(asker, selection.filter())).rest();
    std::erase_if(found, does_not_match);
    if (present.knows_groups()) {
        auto preferred = found;
        Preference const preference{asker};
        preference.order(preferred);
        if (selection.sorts()) {
            sort(preferred, selection, present);
            preference.bring_forward(preferred);
        }
        present.keep_one_robot(preferred);
        std::erase_if(found, does_not_match);
    }
    if (selection.sorts()) sort(found, selection, present);
    return found;
}

Engine::Core::ToBind Engine::Core::select_to_bind(Selection const& selection, Session const& asker) const {
    auto present = perspective(&asker, Perspective::Of::present);
    Preference const preference{asker};
    auto possible = registry_.possible(selection.filter().demand(), commanded_by(asker, selection.filter())).rest();
    preference.order(possible);
    ToBind to_bind;
    auto& found = to_bind.components;
    for (auto* component : possible) {
        if (selection.match(present.candidate(*component)) != Match::yes) continue;
        found.push_back(component);
        bool const will_do = component->is_free() && !component->is_being_halted() && !component->confirms_binding();
        if (will_do && !selection.sorts() && !present.knows_groups()) break;
    }
    if (selection.sorts()) {
        sort(found, selection, present);
        preference.bring_forward(found);
    }
    if (!present.knows_groups()) return to_bind;
    present.keep_one_robot(found);
    if (auto const held = present.drop_held_robots()) to_bind.held_of_group = registry_.find(*held);
    std::erase_if(found, [&](auto const* component) { return selection.match(present.candidate(*component)) != Match::yes; });
    std::ranges::stable_partition(found, [&](auto const* component) { return present.is_lacked(*component); });
    return to_bind;
}

std::vector<std::string> Engine::Core::members_in_order(RegisteredComponent const& logical, Selection const& selection,
                                                        Session const& asker) const {
    std::vector<std::string> refs;
    if (!logical.is_logical() || !selection.sorts()) return refs;
    auto present = perspective(&asker, Perspective::Of::present);
    std::vector<RegisteredComponent*> members;
    for (auto const& ref : logical.members())
        if (auto* member = registry_.find(ref)) members.push_back(member);
    sort(members, selection, present);
    for (auto const* member : members) refs.push_back(member->ref().code);
    return refs;
}

std::optional<std::string> Engine::Core::choose(Results& results, QueryExpression const& condition, Declarations const& known,
                                                std::string_view id, Session const& asker) const {
    Vocabulary const vocabulary{
        .places = &places_, .seen_places = &places_seen_by(asker.rights.get()), .parameters = nullptr, .results = &known};
    auto filter = Filter::compile(condition, vocabulary);
    if (auto* problem = std::get_if<std::string>(&filter)) return std::move(*problem);
    keep_matching(results, std::get<Filter>(filter), id);
    return {};
}

}  // namespace rois
