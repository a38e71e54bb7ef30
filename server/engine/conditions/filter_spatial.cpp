// Spatial operators (ISO 19143, Spatial Filter).
#include <array>
#include <variant>

#include "engine/conditions/filter_compiler.hpp"
#include "engine/frames/space.hpp"
#include "types/condition.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

using Pair = std::pair<SpatialOperand, SpatialOperand>;

// A distance of at most this many mm.
struct Near {
    double mm;
};
using Relation = std::variant<SpatialRelation, Near>;

bool is_met(Relation const& relation, Geometry const& a, Geometry const& b) {
    if (auto const* near = std::get_if<Near>(&relation)) return distance(a, b) <= near->mm;
    return holds(std::get<SpatialRelation>(relation), a, b);
}

std::string name_of(Relation const& relation) {
    static constexpr std::array<std::string_view, 8> names{"within",  "intersects", "intersects", "equals",
                                                           "touches", "overlaps",   "crosses",    "contains"};
    if (auto const* near = std::get_if<Near>(&relation)) return "near " + canonical(near->mm);
    return std::string{names.at(static_cast<std::size_t>(std::get<SpatialRelation>(relation)))};
}

// Matches if one of several positions meets the relation; if denied, matches if none does (Disjoint denies Intersects, Beyond
// denies DWithin). Positions without a common frame never match.
class Spatial final : public Predicate {
public:
    enum class Sense : std::uint8_t { affirmed, denied };

    Spatial(Relation relation, Sense sense, Pair operands, Frames const& frames)
        : relation_{relation}, sense_{sense}, operands_{std::move(operands)}, frames_{frames} {}

    Match match(Candidate const& candidate) const override {
        auto const left = operands_.first.of(candidate), right = operands_.second.of(candidate);
        if ((left && left->empty()) || (right && right->empty())) return Match::no;
        if (!left || !right) return Match::maybe;
        if (make_too_many_pairs(*left, *right)) return Match::no;
        bool comparable = false, met = false;
        auto const meets = [&](Geometry const& a, Geometry const& b) {
            spend_for(a, b);
            return is_met(relation_, a, b);
        };
        for (auto const& a : *left) {
            for (auto const& b : *right) {
                auto const found = in_one_frame(frames_, a, b, meets);
                comparable = comparable || found;
                met = met || found.value_or(false);
            }
        }
        return comparable && met != (sense_ == Sense::denied) ? Match::yes : Match::no;
    }

    std::string canonical() const override {
        auto one = operands_.first.canonical(), other = operands_.second.canonical();
        bool const directed = relation_.index() == 0 && std::get<SpatialRelation>(relation_) == SpatialRelation::within;
        if (!directed && other < one) std::swap(one, other);
        return (sense_ == Sense::denied ? "never " : "") + name_of(relation_) + "(" + one + "," + other + ")";
    }

private:
    Relation relation_;
    Sense sense_;
    Pair operands_;
    Frames const& frames_;
};

// Both operands; a single operand is compared with the candidate's own position. Returns nullopt if they are invalid.
std::optional<Pair> pair_of(FilterCompiler& compiler, std::vector<Expression> const& operands) {
    auto const own = compiler.vocabulary().own_position();
    if (operands.size() < 2 && own.empty())
        return compiler.refuse("the condition has a spatial operator with one operand: expected two");
    auto const reference = Expression{ValueReference{std::string{own}}};
    return compiler.related(operands.size() < 2 ? reference : operands.front(), operands.back());
}

}  // namespace

// For Within, the candidate's position must be within the condition's geometry, in either order of the operands.
PredicatePtr FilterCompiler::operator()(SpatialComparison const& comparison) {
    auto pair = pair_of(*this, comparison.operands);
    if (!pair) return nullptr;
    auto relation = comparison.relation;
    auto sense = Spatial::Sense::affirmed;
    if (relation == SpatialRelation::within && pair->first.known() != nullptr && pair->second.known() == nullptr)
        std::swap(pair->first, pair->second);
    if (relation == SpatialRelation::contains) {
        relation = SpatialRelation::within;
        std::swap(pair->first, pair->second);
    }
    if (relation == SpatialRelation::disjoint) {
        relation = SpatialRelation::intersects;
        sense = Spatial::Sense::denied;
    }
    return std::make_unique<Spatial>(relation, sense, std::move(*pair), vocabulary_.places->frames);
}

PredicatePtr FilterCompiler::operator()(DistanceComparison const& comparison) {
    auto const unit = millimetres_in(comparison.uom);
    if (!unit) {
        refuse("the condition has the unit " + quoted(comparison.uom) +
               ", which is not known here; expected one of mm, cm, m, km");
        return nullptr;
    }
    if (!(comparison.distance >= 0)) {
        refuse("the condition has a distance that is not a number of at least 0");
        return nullptr;
    }
    auto pair = pair_of(*this, comparison.operands);
    if (!pair) return nullptr;
    auto const sense = comparison.relation == DistanceRelation::beyond ? Spatial::Sense::denied : Spatial::Sense::affirmed;
    return std::make_unique<Spatial>(Near{comparison.distance * *unit}, sense, std::move(*pair), vocabulary_.places->frames);
}

}  // namespace rois
