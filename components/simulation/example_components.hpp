// Makers of the components that are examples of user-defined ones (Annex C), and of the stand-in. For adapters.cpp.
#pragma once

#include <memory>

#include "simulation/robot_component.hpp"
#include "xml/schemas.hpp"

namespace rois::simulation {

// The grammars that it is given are validated against the schemas.
std::unique_ptr<Component> srgs_speech_recognition(Fitting, std::shared_ptr<xml::Schemas const>);
std::unique_ptr<Component> person_gender_identification(Fitting);
std::unique_ptr<Component> person_age_recognition(Fitting);

// Navigation of a wheelchair, with its brakes and its state.
std::unique_ptr<Component> wheelchair_robot(Fitting);

// Does nothing, and says it as the profile has it: commands complete at once and queries are answered, both with the default
// values of their results. `whole` has the messages of the sub components.
std::unique_ptr<Component> stand_in(Fitting, ComponentProfile whole);

}  // namespace rois::simulation
