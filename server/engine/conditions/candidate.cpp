#include "engine/conditions/candidate.hpp"

#include "engine/conditions/referred.hpp"

namespace rois {

std::optional<Texts> MessageCandidate::texts(Reference const& reference) const {
    return speaks_of_results(reference) ? texts_in(results_, reference) : component().texts(reference);
}

std::optional<Positions> MessageCandidate::positions(Reference const& reference) const {
    return speaks_of_results(reference) ? positions_in(results_, reference) : component().positions(reference);
}

bool MessageCandidate::has(Reference const& reference) const {
    return speaks_of_results(reference) ? is_in(results_, reference) : component().has(reference);
}

std::optional<Texts> ResultsCandidate::texts(Reference const& reference) const { return texts_in(results_, reference); }

std::optional<Positions> ResultsCandidate::positions(Reference const& reference) const {
    return positions_in(results_, reference);
}

bool ResultsCandidate::has(Reference const& reference) const { return is_in(results_, reference); }

}  // namespace rois
