#include "engine/conditions/referred.hpp"

#include <utility>

#include "engine/conditions/effort.hpp"
#include "engine/frames/space.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

using Part = Reference::Part;

// Returns null if the values are too long.
Parameter const* if_not_too_long(Parameter const* parameter) {
    if (parameter == nullptr) return nullptr;
    std::size_t length = 0;
    for (auto const& value : parameter->values) length += value.size();
    Effort::spend(10 * (1 + parameter->values.size()) + length);
    return length <= longest_value ? parameter : nullptr;
}

bool is_meant(Located const& located, Reference const& reference) {
    bool const of = reference.name.empty() || equal_ignoring_case(located.of, reference.name);
    return of && (reference.entity.empty() || located.ref == reference.entity);
}

std::vector<Located const*> located_in(Results const& results, Reference const& reference) {
    Effort::spend(10 * (1 + results.located.size()));
    std::vector<Located const*> meant;
    for (auto const& located : results.located)
        if (is_meant(located, reference)) meant.push_back(&located);
    return meant;
}

// The values of one entity: those with the indexes at which it is located.
Texts texts_of_entity(Texts const& items, Results const& results, Reference const& reference) {
    Texts meant;
    std::size_t at = 0;
    for (auto const& located : results.located) {
        if (!equal_ignoring_case(located.of, reference.name)) continue;
        if (located.ref == reference.entity && at < items.size()) meant.push_back(items[at]);
        ++at;
    }
    return meant;
}

Texts texts_of(std::vector<Located const*> const& all, Reference const& reference) {
    Texts texts;
    for (auto const* located : all) texts.push_back(reference.part == Part::crs ? located->crs : located->ref);
    return texts;
}

}  // namespace

Texts items_of(Parameter const& parameter, Reference::Items kept) {
    if (kept == Reference::Items::one_each) return parameter.values;
    Texts items;
    for (auto const& value : parameter.values) {
        for (auto rest = trimmed(value); !rest.empty();) {
            auto const item = rest.substr(0, rest.find_first_of(" \t\r\n"));
            items.emplace_back(item);
            rest = trimmed(rest.substr(item.size()));
        }
    }
    return items;
}

bool speaks_of_results(Reference const& reference) {
    return reference.to == Reference::To::result || reference.to == Reference::To::located;
}

Texts texts_in(Parameter const* parameter, Reference const& reference) {
    if (parameter == nullptr) return {};
    switch (reference.part) {
        case Part::name:
            return {parameter->name};
        case Part::data_type_ref:
            return {parameter->data_type_ref.code};
        case Part::codebook_ref:
            return {parameter->data_type_ref.codebook_ref};
        default:
            break;
    }
    parameter = if_not_too_long(parameter);
    return parameter == nullptr ? Texts{} : at_its_place(items_of(*parameter, reference.items), reference);
}

Positions positions_in(Parameter const* parameter, Reference const& reference) {
    Positions positions;
    parameter = if_not_too_long(parameter);
    if (parameter == nullptr) return positions;
    for (auto const& value : parameter->values)
        if (auto read = point(value, parameter->data_type_ref.codebook_ref)) positions.push_back(std::move(*read));
    return at_its_place(std::move(positions), reference);
}

Texts texts_in(Results const& results, Reference const& reference) {
    if (reference.to == Reference::To::located)
        return at_its_place(texts_of(located_in(results, reference), reference), reference);
    auto const* parameter = if_not_too_long(find(results.parameters, reference.name));
    if (parameter == nullptr || reference.entity.empty()) return texts_in(parameter, reference);
    return at_its_place(texts_of_entity(items_of(*parameter, reference.items), results, reference), reference);
}

// Prefers the structured form to the text form.
Positions positions_in(Results const& results, Reference const& reference) {
    auto const meant = located_in(results, reference);
    if (meant.empty() && reference.to == Reference::To::result && reference.entity.empty())
        return positions_in(find(results.parameters, reference.name), reference);
    Positions positions;
    for (auto const* located : meant) positions.push_back(point(*located));
    return at_its_place(std::move(positions), reference);
}

bool is_in(Results const& results, Reference const& reference) {
    if (reference.to == Reference::To::located) return !results.located.empty();
    return find(results.parameters, reference.name) != nullptr;
}

}  // namespace rois
