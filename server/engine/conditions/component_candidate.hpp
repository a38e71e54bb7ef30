// A component as a candidate for conditions.
#pragma once

#include <optional>

#include "engine/conditions/candidate.hpp"

namespace rois {

class Perspective;
class RegisteredComponent;

// Reads values from the component when a condition needs them, and each value only once.
class ComponentCandidate final : public Candidate {
public:
    ComponentCandidate(RegisteredComponent const& component, Perspective& perspective)
        : component_{component}, perspective_{perspective} {}

    std::optional<Texts> texts(Reference const&) const override;
    std::optional<Positions> positions(Reference const&) const override;
    bool has(Reference const&) const override;
    std::string_view rid() const override;
    std::vector<Candidate const*> robot() const override;
    std::optional<GroupVerdict>* verdict(void const* group) const override;
    Holder holder() const override;

private:
    bool is_open(Reference const&) const;
    Texts own_texts(Reference const&) const;
    Texts identifier_texts(Reference::Part) const;
    Texts location_texts(Reference::Part) const;
    Parameter const* parameter(std::string_view name) const;
    std::optional<Located> const& location() const;

    RegisteredComponent const& component_;
    Perspective& perspective_;
    mutable std::optional<ParameterList> all_parameters_;
};

}  // namespace rois
