#include "engine/conditions/filter_compiler.hpp"

#include <algorithm>

#include "engine/conditions/referred.hpp"
#include "engine/frames/shapes.hpp"
#include "engine/frames/space.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

std::string names_of(Places const& places) {
    auto const names = first_listed(places.all, [](auto const& place) { return quoted(place.name); });
    return names.empty() ? "(none)" : names;
}

// Returns "1,2" for "1 2".
std::string with_commas(std::string_view text) {
    std::string commas;
    for (; !text.empty(); text = trimmed(text)) {
        auto const word = text.substr(0, text.find_first_of(" \t\r\n"));
        commas.append(commas.empty() ? "" : ",").append(word);
        text.remove_prefix(word.size());
    }
    return commas;
}

// The total length of a predicate's texts, without those of nested predicates.
struct TextBytes {
    std::size_t operator()(PropertyComparison const& p) const { return of(p.left) + of(p.right); }
    std::size_t operator()(PropertyIsLike const& p) const { return of(p.left) + of(p.right); }
    std::size_t operator()(PropertyIsNull const& p) const { return of(p.value); }
    std::size_t operator()(PropertyIsNil const& p) const { return of(p.value); }
    std::size_t operator()(PropertyIsBetween const& p) const { return of(p.value) + of(p.lower) + of(p.upper); }
    std::size_t operator()(SpatialComparison const& p) const { return of(p.operands); }
    std::size_t operator()(DistanceComparison const& p) const { return of(p.operands); }
    std::size_t operator()(TemporalComparison const& p) const { return of(p.operands); }
    std::size_t operator()(ResourceId const& p) const { return p.rid.size(); }
    std::size_t operator()(ComponentGroup const& p) const { return of(p.types) + of(p.aliases); }
    std::size_t operator()(auto const&) const { return 0; }

    static std::size_t of(Expression const& expression) {
        if (auto const* reference = std::get_if<ValueReference>(&expression.value)) return reference->path.size();
        if (auto const* literal = std::get_if<Literal>(&expression.value)) return literal->text.size();
        if (auto const* function = std::get_if<Function>(&expression.value)) return of(function->arguments);
        auto const* geometry = std::get_if<Geometry>(&expression.value);
        if (geometry == nullptr) return 0;
        auto bytes = geometry->crs.size();
        for (auto const& path : geometry->paths) bytes += path.size() * sizeof(Geometry::Point);
        return bytes;
    }
    static std::size_t of(std::string const& text) { return text.size(); }
    template <class Item>
    static std::size_t of(std::vector<Item> const& items) {
        std::size_t bytes = 0;
        for (auto const& item : items) bytes += of(item);
        return bytes;
    }
};

bool may_be_a_position(Reference const& reference) {
    if (reference.part != Reference::Part::value) return false;
    switch (reference.to) {
        case Reference::To::location:
        case Reference::To::located:
            return true;
        case Reference::To::parameter:
        case Reference::To::result:
            return reference.kind == ValueKind::any;
        default:
            return false;
    }
}

}  // namespace

void spend_for(Geometry const& a, Geometry const& b) {
    constexpr std::size_t steps_of_a_pair = 400;
    auto const points = [](Geometry const& of) {
        std::size_t sum = 1;
        for (auto const& path : of.paths) sum += path.size();
        return sum;
    };
    Effort::spend(20 + points(a) * points(b) / 4);
    Effort::spend(steps_of_a_pair * meeting_edges(a, b));
}

std::optional<Positions> SpatialOperand::of(Candidate const& candidate) const {
    if (auto const* known = std::get_if<Geometry>(&where_)) return Positions{*known};
    return candidate.positions(std::get<Reference>(where_));
}

std::string SpatialOperand::canonical() const {
    return std::visit([](auto const& where) { return rois::canonical(where); }, where_);
}

std::optional<std::vector<double>> Distance::of(Candidate const& candidate) const {
    auto const one = from.of(candidate), other = to.of(candidate);
    if (!one || !other) return {};
    std::vector<double> nearest;
    if (make_too_many_pairs(*one, *other)) return nearest;
    auto const apart = [](Geometry const& a, Geometry const& b) {
        spend_for(a, b);
        return rois::distance(a, b);
    };
    for (auto const& a : *one)
        for (auto const& b : *other)
            if (auto const length = in_one_frame(*frames, a, b, apart))
                nearest = {nearest.empty() ? *length : std::min(nearest.front(), *length)};
    return nearest;
}

std::string Distance::canonical() const {
    auto const one = from.canonical(), other = to.canonical();
    return "distance(" + std::min(one, other) + "," + std::max(one, other) + ")";
}

PredicatePtr FilterCompiler::compile(Condition const& condition) {
    count(1);
    if (problem_) return nullptr;
    text_bytes_ += std::visit(TextBytes{}, condition.predicate);
    return std::visit(*this, condition.predicate);
}

void FilterCompiler::count(std::size_t predicates, std::string const& explanation) {
    predicates_ += predicates;
    if (predicates_ > most_predicates)
        refuse("the condition has more than " + std::to_string(most_predicates) + " predicates" + explanation);
}

std::optional<Reference> FilterCompiler::resolve(std::string_view path) {
    auto resolved = vocabulary_.resolve(path, aliases_);
    if (auto* problem = std::get_if<std::string>(&resolved)) return refuse(std::move(*problem));
    auto& reference = std::get<Reference>(resolved);
    using To = Reference::To;
    depends_on_asker_ = depends_on_asker_ || reference.to == To::status || reference.to == To::parameter;
    names_units_ = names_units_ || reference.to == To::engine || reference.to == To::robot_id;
    if (speaks_of_results(reference)) results_.push_back(reference);
    return std::move(reference);
}

std::optional<SpatialOperand> FilterCompiler::spatial_operand(Expression const& expression) {
    auto const& places = vocabulary_.places_to_name();
    if (auto const* not_understood = std::get_if<NotUnderstood>(&expression.value)) return refuse(not_understood->reason);
    if (auto const* geometry = std::get_if<Geometry>(&expression.value)) {
        auto const& frames = places.frames;
        Geometry here = *geometry;
        auto counted = std::max<std::size_t>(here.paths.size(), 1) - 1;
        for (auto const& path : here.paths) counted += path.size() / points_of_a_predicate;
        count(counted,
              "; " + std::to_string(points_of_a_predicate) + " points of a line or polygon count as one, as does a hole");
        if (problem_) return {};
        if (here.shape != Geometry::Shape::box) {
            spend_for(here, here);
            if (auto const problem = why_invalid(here)) return refuse("the condition has a " + *problem);
        }
        if (here.crs.empty()) here.crs = frames.own();
        if (!frames.own().empty() && !frames.know(here.crs))
            return refuse("the condition has the frame " + quoted(here.crs, 200) + ", which is not known here; expected one of " +
                          first_listed(frames.names()));
        if (auto moved = vocabulary_.places->frames.moved(here, frames.own())) return std::move(*moved);
        return here;
    }
    if (auto const* reference = std::get_if<ValueReference>(&expression.value)) {
        auto resolved = resolve(reference->path);
        if (!resolved) return {};
        if (!may_be_a_position(*resolved))
            return refuse("the condition uses " + quoted(reference->path) + " as a position, but it is not one");
        return std::move(*resolved);
    }
    auto const* literal = std::get_if<Literal>(&expression.value);
    if (literal == nullptr) return refuse("an operand of a spatial operator in the condition is not a position");
    auto const text = trimmed(literal->text);
    if (auto const* place = places.find(text)) return place->area;
    if (auto read = point(text, places.frames.own())) return std::move(*read);
    if (point(with_commas(text), {}))
        return refuse("the condition has the position " + quoted(text) + ", which has no commas; write 'x, y' or 'x, y, th'");
    return refuse("the condition has the place " + quoted(text) + ", which is not known here; expected one of " +
                  names_of(places));
}

std::optional<Distance> FilterCompiler::distance(Function const& function) {
    if (!equal_ignoring_case(function.name, "distance"))
        return refuse("the condition has the function " + quoted(function.name) + ", which is not known here; known is distance");
    if (function.arguments.size() != 2) return refuse("the function distance in the condition needs two arguments");
    auto both = related(function.arguments[0], function.arguments[1]);
    if (!both) return {};
    return Distance{std::move(both->first), std::move(both->second), &vocabulary_.places->frames};
}

// Two boxes must be in the same frame: a box of one frame is not a box in a turned frame.
std::optional<std::pair<SpatialOperand, SpatialOperand>> FilterCompiler::related(Expression const& one, Expression const& other) {
    auto first = spatial_operand(one);
    auto second = first ? spatial_operand(other) : std::nullopt;
    if (!second) return {};
    auto const nothing = [](auto const&...) { return true; };
    auto const *a = first->known(), *b = second->known();
    if (a != nullptr && b != nullptr && !in_one_frame(vocabulary_.places->frames, *a, *b, nothing))
        return refuse("the condition relates a geometry in the frame " + quoted(a->crs, 200) + " to one in " +
                      quoted(b->crs, 200) + ": use one frame for both");
    return std::pair{std::move(*first), std::move(*second)};
}

std::nullopt_t FilterCompiler::refuse(std::string reason) {
    if (!problem_) problem_ = std::move(reason);
    return std::nullopt;
}

PredicatePtr FilterCompiler::operator()(NotUnderstood const& what) {
    refuse(what.reason);
    return nullptr;
}

}  // namespace rois
