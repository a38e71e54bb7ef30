#include "engine/component.hpp"

#include <stdexcept>

namespace rois {

void Component::reconcile(ParameterList&, ParameterList const&) const {}

void Component::parameters_changed(ParameterList const&, Instant) {}

void Component::perform(CommandHandle, std::string_view command_type, ParameterList const&, Instant) {
    throw std::logic_error("the component's profile has the command '" + std::string{command_type} +
                           "', but the component does not implement it");
}

std::vector<Results> Component::query(std::string_view, Instant) { return {}; }

}  // namespace rois
