// The spatial operators (ISO 19143, Spatial Filter) over points and boxes.
#include <algorithm>
#include <array>

#include "engine/filter_compiler.hpp"
#include "engine/space.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

using Pair = std::pair<Whereabouts, Whereabouts>;

enum class Relation : std::uint8_t { within, intersects, disjoint, near, beyond };

bool holds(Relation relation, Geometry const& a, Geometry const& b, double mm) {
    switch (relation) {
        case Relation::within:
            return is_within(a, b);
        case Relation::intersects:
        case Relation::disjoint:
            return intersect(a, b);
        case Relation::near:
        case Relation::beyond:
            break;
    }
    return distance(a, b) <= mm;
}

// Of several positions, one must meet Within, Intersects and DWithin; Disjoint and Beyond are their contrary: all must meet them.
// Positions that have no frame in common meet nothing.
class Spatial final : public Predicate {
public:
    Spatial(Relation relation, Pair operands, double mm, Frames const& frames)
        : relation_{relation}, operands_{std::move(operands)}, mm_{mm}, frames_{frames} {}

    Match match(Candidate const& candidate) const override {
        auto const left = operands_.first.of(candidate), right = operands_.second.of(candidate);
        if ((left && left->empty()) || (right && right->empty())) return Match::no;
        if (!left || !right) return Match::maybe;
        if (make_too_many_pairs(*left, *right)) return Match::no;
        bool comparable = false, met = false;
        auto const is_met = [&](Geometry const& a, Geometry const& b) { return holds(relation_, a, b, mm_); };
        for (auto const& a : *left) {
            for (auto const& b : *right) {
                auto const found = in_one_frame(frames_, a, b, is_met);
                comparable = comparable || found;
                met = met || found.value_or(false);
            }
        }
        bool const contrary = relation_ == Relation::disjoint || relation_ == Relation::beyond;
        return comparable && met != contrary ? Match::yes : Match::no;
    }

    std::string canonical() const override {
        static constexpr std::array<std::string_view, 5> names{"within", "intersects", "disjoint", "near", "beyond"};
        auto one = operands_.first.canonical(), other = operands_.second.canonical();
        if (relation_ != Relation::within && other < one) std::swap(one, other);
        bool const by_distance = relation_ == Relation::near || relation_ == Relation::beyond;
        return std::string{names.at(static_cast<std::size_t>(relation_))} + "(" + one + "," + other +
               (by_distance ? "," + rois::canonical(mm_) : "") + ")";
    }

private:
    Relation relation_;
    Pair operands_;
    double mm_;
    Frames const& frames_;
};

struct Unit {
    std::string_view name;
    double mm;
};
constexpr std::array<Unit, 12> units{{{"mm", 1},
                                      {"cm", 10},
                                      {"m", 1'000},
                                      {"km", 1'000'000},
                                      {"millimetre", 1},
                                      {"centimetre", 10},
                                      {"metre", 1'000},
                                      {"kilometre", 1'000'000},
                                      {"millimeter", 1},
                                      {"centimeter", 10},
                                      {"meter", 1'000},
                                      {"kilometer", 1'000'000}}};

// Both operands, or the one that is there with the candidate's own position before it; nothing when refused.
std::optional<Pair> pair_of(FilterCompiler& compiler, std::vector<Expression> const& operands) {
    auto const own = compiler.vocabulary().own_position();
    if (operands.size() < 2 && own.empty())
        return compiler.refuse("the condition has a spatial operator with one operand, which means nothing here");
    auto const reference = Expression{ValueReference{std::string{own}}};
    return compiler.related(operands.size() < 2 ? reference : operands.front(), operands.back());
}

}  // namespace

// What is told is within what is known, in whichever order the two stand.
PredicatePtr FilterCompiler::operator()(SpatialComparison const& comparison) {
    auto pair = pair_of(*this, comparison.operands);
    if (!pair) return nullptr;
    if (comparison.relation == SpatialRelation::within && pair->first.known() != nullptr && pair->second.known() == nullptr)
        std::swap(pair->first, pair->second);
    static constexpr std::array<Relation, 3> relations{Relation::within, Relation::intersects, Relation::disjoint};
    return std::make_unique<Spatial>(relations.at(static_cast<std::size_t>(comparison.relation)), std::move(*pair), 0,
                                     vocabulary_.places->frames);
}

PredicatePtr FilterCompiler::operator()(DistanceComparison const& comparison) {
    auto const unit = std::ranges::find(units, trimmed(comparison.uom), &Unit::name);
    if (unit == units.end()) {
        refuse("the condition has the unit " + quoted(comparison.uom) + ", which is not known here; known are mm, cm, m, km");
        return nullptr;
    }
    if (!(comparison.distance >= 0)) {
        refuse("the condition has a distance that is no number from 0 on");
        return nullptr;
    }
    auto pair = pair_of(*this, comparison.operands);
    if (!pair) return nullptr;
    auto const relation = comparison.relation == DistanceRelation::beyond ? Relation::beyond : Relation::near;
    return std::make_unique<Spatial>(relation, std::move(*pair), comparison.distance * unit->mm, vocabulary_.places->frames);
}

}  // namespace rois
