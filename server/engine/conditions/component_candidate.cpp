#include "engine/conditions/component_candidate.hpp"

#include "engine/conditions/effort.hpp"
#include "engine/conditions/referred.hpp"
#include "engine/frames/perspective.hpp"
#include "engine/frames/space.hpp"
#include "engine/registry.hpp"

namespace rois {

using To = Reference::To;
using Part = Reference::Part;

// "Open" values are not known yet. The results of a component are open until it sends an event or answers a query. In
// Perspective::Of::ever its status, binding, position and parameters are open, too. Parameters and results that are not in the
// component's profile are never open: they are absent.
bool ComponentCandidate::is_open(Reference const& reference) const {
    if (perspective_.of() == Perspective::Of::present)
        return reference.to == To::located || (reference.to == To::result && has(reference));
    switch (reference.to) {
        case To::status:
        case To::bound:
        case To::location:
        case To::located:
            return true;
        case To::parameter:
        case To::result:
            return has(reference);
        default:
            return false;
    }
}

std::optional<Texts> ComponentCandidate::texts(Reference const& reference) const {
    if (is_open(reference)) return {};
    return reference.to == To::parameter ? texts_in(parameter(reference.name), reference)
                                         : at_its_place(own_texts(reference), reference);
}

// For all references except parameters.
Texts ComponentCandidate::own_texts(Reference const& reference) const {
    switch (reference.to) {
        case To::component_ref:
            return identifier_texts(reference.part);
        case To::component_type:
            return {component_.entry().type};
        case To::engine:
            return {component_.entry().engine};
        case To::robot_id:
            if (component_.is_logical()) return {component_.entry().engine};  // it stands for several robots
            return {location() ? location()->ref : component_.entry().engine};
        case To::status:
            return {std::string{to_text(component_.status_for(perspective_.asker()))}};
        case To::bound:
            return {component_.bound_to != nullptr ? "true" : "false"};
        case To::location:
            return location_texts(reference.part);
        case To::parameter:
        case To::result:
        case To::located:
            break;
    }
    return {};
}

std::optional<Positions> ComponentCandidate::positions(Reference const& reference) const {
    if (is_open(reference)) return {};
    if (reference.to == To::parameter) return positions_in(parameter(reference.name), reference);
    if (reference.to != To::location || !location()) return Positions{};
    return at_its_place(Positions{point(*location())}, reference);
}

bool ComponentCandidate::has(Reference const& reference) const {
    switch (reference.to) {
        case To::parameter:
            return component_.has_parameter(reference.name);
        case To::result:
            return component_.has_result(reference.name);
        case To::located:
            return false;
        case To::location:
            return perspective_.of() == Perspective::Of::ever || location().has_value();
        default:
            return true;
    }
}

std::string_view ComponentCandidate::rid() const { return component_.entry().ref; }

std::vector<Candidate const*> ComponentCandidate::robot() const { return perspective_.robot(component_.entry().engine); }

std::optional<GroupVerdict>* ComponentCandidate::verdict(void const* group) const {
    return &perspective_.verdicts_[{group, component_.entry().engine}];
}

Holder ComponentCandidate::holder() const {
    if (component_.bound_to == nullptr) return Holder::nobody;
    return component_.bound_to == perspective_.asker() ? Holder::asker : Holder::another_session;
}

Texts ComponentCandidate::identifier_texts(Part part) const {
    auto const& ref = component_.ref();
    auto const& text = part == Part::authority      ? ref.authority
                       : part == Part::codebook_ref ? ref.codebook_ref
                       : part == Part::version      ? ref.version
                                                    : ref.code;
    return text.empty() ? Texts{} : Texts{text};
}

// The text form of a position is the names of the places that contain it, of those that the asker may name.
Texts ComponentCandidate::location_texts(Part part) const {
    if (!location()) return {};
    if (part == Part::ref) return {location()->ref};
    if (part == Part::crs) return {location()->crs};
    Effort::spend(40 * perspective_.named_places().all.size());
    Texts names;
    auto const here = point(*location());
    auto const is_within = [](Geometry const& a, Geometry const& b) { return holds(SpatialRelation::within, a, b); };
    auto const& frames = perspective_.places().frames;
    for (auto const& place : perspective_.named_places().all)
        if (in_one_frame(frames, here, place.area, is_within).value_or(false)) names.push_back(place.name);
    return names;
}

Parameter const* ComponentCandidate::parameter(std::string_view name) const {
    if (auto const* stored = find(component_.parameters_for(perspective_.asker()), name)) return stored;
    if (!component_.has_parameter(name)) return nullptr;
    if (!all_parameters_) {
        all_parameters_ = component_.all_parameters(perspective_.asker()).value_or(ParameterList{});
        Effort::spend(100 * all_parameters_->size());
    }
    return find(*all_parameters_, name);
}

std::optional<Located> const& ComponentCandidate::location() const { return component_.location(); }

}  // namespace rois
