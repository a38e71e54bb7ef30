// Encodes conditions as in ISO 19143 and the published examples: the inverse of decoding_condition.cpp.
#include <algorithm>
#include <stdexcept>

#include "xml/codec/encoding.hpp"

namespace rois::xml {

namespace {

[[noreturn]] void cannot(std::string const& what) { throw std::invalid_argument{what + " cannot be written as XML"}; }

// --- Expressions ---

enum class Around { nothing, literal };  // geometries and times need a Literal, except as operands of space and time

void write_expression(Writer&, Expression const&, Around);

void write_corner(Writer& out, std::string_view element, std::array<double, 3> const& corner, std::size_t dimensions) {
    out.element(element, numbers_text(std::span{corner}.first(dimensions)));
}

void write_time(Writer& out, Period const& period) {
    if (period.begin == period.end) {
        out.start("gml:TimeInstant").element("gml:timePosition", to_text(period.begin)).end();
        return;
    }
    out.start("gml:TimePeriod").element("gml:beginPosition", to_text(period.begin));
    out.element("gml:endPosition", to_text(period.end)).end();
}

void write_box(Writer& out, Geometry const& box) {
    bool const point = box.low == box.high;
    out.start(point ? "gml:Point" : "gml:Envelope").attribute_unless_empty("srsName", box.crs);
    if (point) {
        write_corner(out, "gml:pos", box.low, box.dimensions);
    } else {
        write_corner(out, "gml:lowerCorner", box.low, box.dimensions);
        write_corner(out, "gml:upperCorner", box.high, box.dimensions);
    }
    out.end();
}

void write_points(Writer& out, Geometry::Points const& points) {
    std::vector<double> numbers;
    for (auto const& point : points) numbers.insert(numbers.end(), point.begin(), point.end());
    out.element(points.size() == 1 ? "gml:pos" : "gml:posList", numbers_text(numbers));
}

void write_geometry(Writer& out, Geometry const& geometry) {
    static constexpr std::array<std::string_view, 4> names{"", "gml:LineString", "gml:CircleByCenterPoint", "gml:Polygon"};
    if (geometry.shape == Geometry::Shape::box) return write_box(out, geometry);
    out.start(names.at(static_cast<std::size_t>(geometry.shape))).attribute_unless_empty("srsName", geometry.crs);
    for (auto const& path : geometry.paths) {
        bool const border = geometry.shape == Geometry::Shape::polygon;
        if (border) out.start(&path == geometry.paths.data() ? "gml:exterior" : "gml:interior").start("gml:LinearRing");
        write_points(out, path);
        if (border) out.end().end();
    }
    if (geometry.shape == Geometry::Shape::circle)
        out.start("gml:radius").attribute("uom", "mm").text(number_text(geometry.radius)).end();
    out.end();
}

class ExpressionWriter {
public:
    ExpressionWriter(Writer& out, Around around) : out_{out}, around_{around} {}

    void operator()(ValueReference const& reference) const { out_.element("fes:ValueReference", reference.path); }
    void operator()(Literal const& literal) const { out_.element("fes:Literal", literal.text); }
    void operator()(Geometry const& geometry) const {
        begin();
        write_geometry(out_, geometry);
        end();
    }
    void operator()(Period const& period) const {
        begin();
        write_time(out_, period);
        end();
    }
    void operator()(Function const& function) const {
        out_.start("fes:Function").attribute("name", function.name);
        for (auto const& argument : function.arguments) write_expression(out_, argument, Around::literal);
        out_.end();
    }
    void operator()(NotUnderstood const&) const { cannot("an unsupported expression"); }

private:
    void begin() const {
        if (around_ == Around::literal) out_.start("fes:Literal");
    }
    void end() const {
        if (around_ == Around::literal) out_.end();
    }

    Writer& out_;
    Around around_;
};

void write_expression(Writer& out, Expression const& expression, Around around) {
    std::visit(ExpressionWriter{out, around}, expression.value);
}

// --- Predicates ---

constexpr std::string_view name_of(Comparator comparator) {
    constexpr std::array<std::string_view, 6> names{"fes:PropertyIsEqualTo",           "fes:PropertyIsNotEqualTo",
                                                    "fes:PropertyIsLessThan",          "fes:PropertyIsGreaterThan",
                                                    "fes:PropertyIsLessThanOrEqualTo", "fes:PropertyIsGreaterThanOrEqualTo"};
    return names.at(static_cast<std::size_t>(comparator));
}

constexpr std::string_view name_of(SpatialRelation relation) {
    constexpr std::array<std::string_view, 8> names{"fes:Within",  "fes:Intersects", "fes:Disjoint", "fes:Equals",
                                                    "fes:Touches", "fes:Overlaps",   "fes:Crosses",  "fes:Contains"};
    return names.at(static_cast<std::size_t>(relation));
}

constexpr std::string_view name_of(DistanceRelation relation) {
    return relation == DistanceRelation::d_within ? "fes:DWithin" : "fes:Beyond";
}

constexpr std::string_view name_of(TemporalRelation relation) {
    constexpr std::array<std::string_view, 14> names{
        "fes:After",   "fes:Before", "fes:During", "fes:TEquals", "fes:Begins",    "fes:BegunBy",      "fes:TContains",
        "fes:EndedBy", "fes:Ends",   "fes:Meets",  "fes:MetBy",   "fes:TOverlaps", "fes:OverlappedBy", "fes:AnyInteracts"};
    return names.at(static_cast<std::size_t>(relation));
}

void write_predicate(Writer&, Condition const&);

class PredicateWriter {
public:
    explicit PredicateWriter(Writer& out) : out_{out} {}

    void operator()(PropertyComparison const& comparison) const {
        out_.start(name_of(comparison.comparator));
        write_match_case(comparison.match_case);
        if (comparison.match_action == MatchAction::all) out_.attribute("matchAction", "All");
        if (comparison.match_action == MatchAction::one) out_.attribute("matchAction", "One");
        write_two(comparison.left, comparison.right);
    }
    void operator()(PropertyIsLike const& like) const {
        out_.start("fes:PropertyIsLike").attribute("wildCard", like.wild_card).attribute("singleChar", like.single_char);
        out_.attribute("escapeChar", like.escape_char);
        write_match_case(like.match_case);
        write_two(like.left, like.right);
    }
    void operator()(PropertyIsNull const& null) const {
        out_.start("fes:PropertyIsNull");
        write_one(null.value);
        out_.end();
    }
    void operator()(PropertyIsNil const& nil) const {
        out_.start("fes:PropertyIsNil").attribute_unless_empty("nilReason", nil.nil_reason);
        write_one(nil.value);
        out_.end();
    }
    void operator()(PropertyIsBetween const& between) const {
        out_.start("fes:PropertyIsBetween");
        write_one(between.value);
        write_boundary("fes:LowerBoundary", between.lower);
        write_boundary("fes:UpperBoundary", between.upper);
        out_.end();
    }
    void operator()(SpatialComparison const& comparison) const {
        write_operands(name_of(comparison.relation), comparison.operands);
    }
    void operator()(TemporalComparison const& comparison) const {
        write_operands(name_of(comparison.relation), comparison.operands);
    }
    void operator()(DistanceComparison const& comparison) const {
        out_.start(name_of(comparison.relation));
        for (auto const& operand : comparison.operands) write_expression(out_, operand, Around::nothing);
        out_.start("fes:Distance").attribute("uom", comparison.uom).text(number_text(comparison.distance)).end();
        out_.end();
    }
    void operator()(ResourceId const& id) const { out_.start("fes:ResourceId").attribute("rid", id.rid).end(); }
    void operator()(And const& all) const { write_all("fes:And", all.operands); }
    void operator()(Or const& any) const { write_all("fes:Or", any.operands); }
    void operator()(Not const& none) const {
        if (none.operand.size() != 1) cannot("a Not without one operand");
        out_.start("fes:Not");
        write_predicate(out_, none.operand.front());
        out_.end();
    }
    void operator()(ComponentGroup const&) const { cannot("a group of components inside other predicates"); }
    void operator()(NotUnderstood const&) const { cannot("an unsupported condition"); }

private:
    void write_match_case(bool match_case) const {
        if (!match_case) out_.attribute("matchCase", "false");
    }
    void write_one(Expression const& expression) const { write_expression(out_, expression, Around::literal); }
    void write_two(Expression const& left, Expression const& right) const {
        write_one(left);
        write_one(right);
        out_.end();
    }
    void write_boundary(std::string_view element, Expression const& boundary) const {
        out_.start(element);
        write_one(boundary);
        out_.end();
    }
    void write_operands(std::string_view element, std::vector<Expression> const& operands) const {
        out_.start(element);
        for (auto const& operand : operands) write_expression(out_, operand, Around::nothing);
        out_.end();
    }
    // A single operand is written without And or Or: the standard requires at least two.
    void write_all(std::string_view element, std::vector<Condition> const& operands) const {
        if (operands.empty()) cannot("an And or Or without operands");
        if (operands.size() == 1) {
            write_predicate(out_, operands.front());
            return;
        }
        out_.start(element);
        for (auto const& operand : operands) write_predicate(out_, operand);
        out_.end();
    }

    Writer& out_;
};

void write_predicate(Writer& out, Condition const& condition) { std::visit(PredicateWriter{out}, condition.predicate); }

// --- The published examples' wrapper ---

// Returns the type of a ComponentCondition, which decoding puts first in `all` as a group of one type. Null if there is none.
ComponentGroup const* type_of_component(And const& all) {
    auto const* const group = all.operands.empty() ? nullptr : std::get_if<ComponentGroup>(&all.operands.front().predicate);
    bool const alone =
        group != nullptr && group->types.size() == 1 && group->aliases.empty() && group->filter.empty() && group->members.empty();
    return alone ? group : nullptr;
}

void write_component(Writer& out, And const& all) {
    auto const* const type = type_of_component(all);
    out.start("unr:ComponentCondition");
    if (type != nullptr) out.attribute("type", type->types.front());
    And rest{{all.operands.begin() + (type != nullptr ? 1 : 0), all.operands.end()}};
    if (!rest.operands.empty()) {
        out.start("fes:Filter");
        write_predicate(out, {std::move(rest)});
        out.end();
    }
    out.end();
}

And as_component(Condition const& condition) {
    auto const* const all = std::get_if<And>(&condition.predicate);
    return all != nullptr ? *all : And{{condition}};
}

std::string joined(std::vector<std::string> const& words) {
    std::string text;
    for (auto const& word : words) (text += text.empty() ? "" : " ") += word;
    return text;
}

void write_group(Writer& out, ComponentGroup const& group) {
    out.start("unr:ComponentGroupCondition");
    if (!group.types.empty()) out.attribute("types", joined(group.types));
    if (!group.aliases.empty()) out.attribute("aliases", joined(group.aliases));
    for (auto const& filter : group.filter) {
        out.start("fes:Filter");
        write_predicate(out, filter);
        out.end();
    }
    for (auto const& member : group.members) write_component(out, as_component(member));
    out.end();
}

bool holds_group(Condition const& condition) {
    auto const any_of = [](auto const& operands) { return std::ranges::any_of(operands, holds_group); };
    if (auto const* const all = std::get_if<And>(&condition.predicate)) return any_of(all->operands);
    if (auto const* const any = std::get_if<Or>(&condition.predicate)) return any_of(any->operands);
    if (auto const* const none = std::get_if<Not>(&condition.predicate)) return any_of(none->operand);
    return std::holds_alternative<ComponentGroup>(condition.predicate);
}

// The schema requires groups first. The operands are alternatives, so their order has no meaning.
void write_search(Writer& out, Condition const& condition) {
    auto const* const any = std::get_if<Or>(&condition.predicate);
    std::vector<Condition> const wanted = any != nullptr ? any->operands : std::vector<Condition>{condition};
    out.start("unr:SearchCondition");
    for (auto const& each : wanted)
        if (auto const* const group = std::get_if<ComponentGroup>(&each.predicate)) write_group(out, *group);
    for (auto const& each : wanted)
        if (!std::holds_alternative<ComponentGroup>(each.predicate)) write_component(out, as_component(each));
    out.end();
}

void write_order(Writer& out, std::vector<SortProperty> const& properties) {
    out.start("fes:SortBy");
    for (auto const& property : properties) {
        out.start("fes:SortProperty");
        write_expression(out, property.by, Around::literal);
        if (property.order == SortOrder::descending) out.element("fes:SortOrder", "DESC");
        out.end();
    }
    out.end();
}

}  // namespace

bool is_empty(QueryExpression const& condition) { return !condition.filter && condition.sort_by.empty(); }

bool needs_unr(QueryExpression const& condition) { return condition.filter && holds_group(*condition.filter); }

void write_condition(Writer& out, QueryExpression const& condition) {
    if (needs_unr(condition)) {
        write_search(out, *condition.filter);
    } else if (condition.filter) {
        out.start("fes:Filter");
        write_predicate(out, *condition.filter);
        out.end();
    }
    if (!condition.sort_by.empty()) write_order(out, condition.sort_by);
}

}  // namespace rois::xml
