// The sort keys of SortBy (ISO 19143, Sorting).
#include <cmath>

#include "engine/conditions/filter_compiler.hpp"
#include "types/text/texts.hpp"

namespace rois {

// If there are several values, uses the first.
std::optional<SortKey::Value> SortKey::value(Candidate const& candidate) const {
    Effort::spend(60);
    if (auto const* distance = std::get_if<Distance>(&by_)) {
        auto const length = distance->of(candidate);
        if (!length || length->empty()) return {};
        return Value{.number = length->front(), .text = {}};
    }
    auto const& reference = std::get<Reference>(by_);
    auto texts = candidate.texts(reference);
    if (!texts || texts->empty()) return {};
    if (reference.kind == ValueKind::text || reference.kind == ValueKind::name)
        return Value{.number = {}, .text = texts->front()};
    auto const number = to_double(texts->front());
    return Value{.number = number && !std::isnan(*number) ? number : std::nullopt, .text = texts->front()};
}

// Numbers come before texts. A missing value comes last, in descending order, too.
int SortKey::compare(std::optional<Value> const& a, std::optional<Value> const& b) const {
    if (!a || !b) return static_cast<int>(!a) - static_cast<int>(!b);
    int const sign = order_ == SortOrder::descending ? -1 : 1;
    if (a->number && b->number)
        return sign * (static_cast<int>(*a->number > *b->number) - static_cast<int>(*a->number < *b->number));
    if (a->number || b->number) return a->number ? -1 : 1;
    auto const order = a->text.compare(b->text);
    return sign * (static_cast<int>(order > 0) - static_cast<int>(order < 0));
}

}  // namespace rois
