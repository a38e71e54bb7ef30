#include "engine/conditions/vocabulary.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/commands/parameters.hpp"
#include "engine/conditions/value_path.hpp"
#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

using To = Reference::To;
using Part = Reference::Part;

struct Word {
    std::string_view name;
    To to;
    ValueKind kind;
};

// The properties of components. The last two are alternative names, which the published examples use.
constexpr std::array<Word, 9> words{{{"component_ref", To::component_ref, ValueKind::text},
                                     {"component_type", To::component_type, ValueKind::name},
                                     {"name", To::component_ref, ValueKind::text},
                                     {"engine", To::engine, ValueKind::text},
                                     {"status", To::status, ValueKind::text},
                                     {"bound", To::bound, ValueKind::boolean},
                                     {"location", To::location, ValueKind::text},
                                     {"Identifier", To::component_ref, ValueKind::text},
                                     {"RobotId", To::robot_id, ValueKind::text}}};

struct PartWord {
    std::string_view name;
    Part part;
};
constexpr std::array<PartWord, 8> identifier_parts{{{"code", Part::code},
                                                    {"authority", Part::authority},
                                                    {"codebook_ref", Part::codebook_ref},
                                                    {"version", Part::version},
                                                    {"name", Part::name},
                                                    {"data_type_ref", Part::data_type_ref},
                                                    {"ref", Part::ref},
                                                    {"crs", Part::crs}}};

bool has_part(To to, Part part) {
    switch (to) {
        case To::component_ref:
            return part == Part::code || part == Part::authority || part == Part::codebook_ref || part == Part::version;
        case To::parameter:
        case To::result:
            return part == Part::name || part == Part::data_type_ref || part == Part::codebook_ref;
        case To::location:
        case To::located:
            return part == Part::ref || part == Part::crs;
        default:
            return false;
    }
}

ValueKind kind_of(DataType const& type) {
    switch (type.base) {
        case BaseType::integer:
        case BaseType::real:
            return ValueKind::number;
        case BaseType::boolean:
            return ValueKind::boolean;
        case BaseType::date_time:
            return ValueKind::time;
        case BaseType::identifier:
        case BaseType::component_status:
        case BaseType::stream_status:
            return ValueKind::text;
        case BaseType::string:
        case BaseType::date:
        case BaseType::time:
        case BaseType::other:
            break;
    }
    return ValueKind::any;
}

bool is(std::string_view step, std::string_view one, std::string_view other) {
    return equal_ignoring_case(step, one) || equal_ignoring_case(step, other);
}
bool is_property(std::string_view step) { return is(step, "Property", "Parameter"); }
bool is_result(std::string_view step) { return is(step, "Result", "Results"); }

std::optional<Reference> declared(Declarations const* declarations, To to, std::string_view name) {
    auto const* found = declarations == nullptr ? nullptr : declarations->find(name);
    if (found == nullptr) return {};
    return Reference{.to = to, .name = lower_case(found->name), .entity = {}, .kind = found->kind, .items = found->items};
}

// The name in `[@name='volume']`; nullopt if the step has no such predicate.
std::optional<std::string_view> name_in(PathStep const& step) {
    if (step.predicates.size() != 1 || !equal_ignoring_case(step.predicates.front().attribute, "name")) return {};
    return step.predicates.front().text;
}

// Adds `[2]` and `[@ref='person-3']` to the reference. Returns false for other predicates.
bool restrict(Reference& reference, std::size_t position, std::span<PathStep::Predicate const> predicates) {
    reference.position = position;
    for (auto const& predicate : predicates) {
        bool const by_entity = equal_ignoring_case(predicate.attribute, "ref");
        bool const by_name = equal_ignoring_case(predicate.attribute, "of") && reference.to == To::located;
        if (by_entity && (reference.to == To::located || reference.to == To::result)) {
            reference.entity = predicate.text;
        } else if (by_name) {
            reference.name = lower_case(predicate.text);
        } else {
            return false;
        }
    }
    return true;
}

}  // namespace

std::string folded_name(std::string_view text) { return folded_case(trimmed(text)); }

std::string canonical(Reference const& reference) {
    auto const sized = [](std::string const& text) { return std::to_string(text.size()) + ":" + text; };
    return "R" + std::to_string(static_cast<int>(reference.to)) + "," + sized(reference.name) + "," + sized(reference.entity) +
           "," + std::to_string(reference.position) + "," + std::to_string(static_cast<int>(reference.part)) +
           (reference.alias == Reference::no_alias ? "" : "," + std::to_string(reference.alias));
}

void Declarations::add(ParameterProfile const& profile) {
    auto const type = DataType::of(profile.data_type_ref);
    auto const kind = kind_of(type);
    bool const packed = type.list && (kind == ValueKind::number || kind == ValueKind::boolean);
    auto const [place, added] = by_name_.try_emplace(
        lower_case(profile.name), Declared{profile.name, kind, packed ? Reference::Items::packed : Reference::Items::one_each});
    if (added) return;
    if (place->second.kind != kind) place->second.kind = ValueKind::any;
    if (packed) place->second.items = Reference::Items::packed;
}

Declarations::Declared const* Declarations::find(std::string_view name) const {
    auto found = by_name_.find(lower_case(name));
    if (found == by_name_.end()) found = by_name_.find(lower_case(engine_spelling(name)));
    return found == by_name_.end() ? nullptr : &found->second;
}

namespace {

std::optional<Reference> word(Vocabulary const& vocabulary, std::string_view name) {
    if (vocabulary.parameters == nullptr) return {};
    auto const found = std::ranges::find_if(words, [&](Word const& known) { return equal_ignoring_case(known.name, name); });
    if (found == words.end()) return {};
    return Reference{.to = found->to, .name = {}, .entity = {}, .kind = found->kind};
}

// Resolves one step ("volume"), or two steps of which the first is the kind ("Parameter/volume").
std::optional<Reference> named(Vocabulary const& vocabulary, std::span<PathStep const> steps) {
    auto const& first = steps.front();
    auto const& last = steps.back();
    bool const property = is_property(first.name), result = is_result(first.name);
    auto const name = name_in(first);
    if (steps.size() > 2 || (steps.size() == 2 && ((!property && !result) || name || first.position != 0))) return {};
    if (steps.size() == 1 && !((property || result) && name)) {
        if (vocabulary.results != nullptr && equal_ignoring_case(first.name, "located"))
            return Reference{.to = To::located, .name = {}, .entity = {}};
        if (auto found = word(vocabulary, first.name)) return found;
        auto from_results = declared(vocabulary.results, To::result, first.name);
        auto set = declared(vocabulary.parameters, To::parameter, first.name);
        return from_results && (!set || vocabulary.first == Vocabulary::First::results) ? from_results : set;
    }
    auto const looked_for = steps.size() == 2 ? last.name : *name;
    if (result) return declared(vocabulary.results, To::result, looked_for);
    if (auto found = declared(vocabulary.parameters, To::parameter, looked_for)) return found;
    return word(vocabulary, looked_for);
}

}  // namespace

std::variant<Reference, std::string> Vocabulary::resolve(std::string_view written, std::span<std::string const> aliases) const {
    // Most references are a single word.
    if (auto found = word(*this, trimmed(written))) return std::move(*found);
    auto const path = ValuePath::parse(written);
    if (!path)
        return "the condition refers to " + quoted(written) +
               ", which is not in the minimum XPath: steps divided by '/', '@' before an attribute, [n] or [@name='text'] after "
               "a step";
    std::span<PathStep const> steps{path->steps};
    auto const alias = std::ranges::find(aliases, steps.front().name);
    bool const aliased = steps.size() > 1 && alias != aliases.end();
    if (aliased) steps = steps.subspan(1);
    auto reference = named(*this, steps);
    if (!reference) return "the condition refers to " + quoted(written) + ", which is not known here; expected one of " + known();
    if (aliased) reference->alias = static_cast<std::size_t>(alias - aliases.begin());
    bool const by_name =
        steps.size() == 1 && (reference->to == To::parameter || reference->to == To::result) && name_in(steps.front());
    auto const& last = steps.back();
    auto const predicates = by_name ? std::span<PathStep::Predicate const>{} : std::span{last.predicates};
    if (!restrict(*reference, last.position, predicates))
        return "the condition refers to " + quoted(written) + ", whose predicate is not supported";
    if (path->attribute.empty()) return std::move(*reference);
    auto const part = std::ranges::find_if(
        identifier_parts, [&](PartWord const& known) { return equal_ignoring_case(known.name, path->attribute); });
    if (part == identifier_parts.end() || !has_part(reference->to, part->part))
        return "the condition refers to " + quoted(written) + ", whose attribute is unknown";
    reference->part = part->part;
    reference->kind = part->part == Part::data_type_ref || part->part == Part::codebook_ref ? ValueKind::name : ValueKind::text;
    reference->items = Reference::Items::one_each;
    return std::move(*reference);
}

std::string_view Vocabulary::own_position() const {
    if (results != nullptr && (parameters == nullptr || first == First::results)) return "located";
    return parameters != nullptr ? "location" : "";
}

std::string_view Vocabulary::own_time() const {
    for (std::string_view const name : {"timestamp", "time"})
        if (results != nullptr && results->find(name) != nullptr) return name;
    return "";
}

std::string Vocabulary::known() const {
    std::string all;
    auto const add = [&](std::string_view name) { all += (all.empty() ? "" : ", ") + std::string{name}; };
    if (parameters != nullptr)
        for (auto const& known : words) add(known.name);
    if (results != nullptr) {
        for (auto const& [name, known] : *results) add(known.name);
        add("located");
    }
    if (parameters != nullptr)
        for (auto const& [name, known] : *parameters) add("Property/" + known.name);
    return all;
}

}  // namespace rois
