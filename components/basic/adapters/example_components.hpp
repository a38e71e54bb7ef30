// Makes the example components (Annex C) and stand-ins.
#pragma once

#include <memory>

#include "basic/base/robot_component.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::basic {

// Validates grammars against the schemas.
std::unique_ptr<LocalComponent> srgs_speech_recognition(Context, std::shared_ptr<xml::Schemas const>);
std::unique_ptr<LocalComponent> person_gender_identification(Context);
std::unique_ptr<LocalComponent> person_age_recognition(Context);

// Navigation of a wheelchair, with brakes and state.
std::unique_ptr<LocalComponent> wheelchair_robot(Context);

// A component without behaviour. Commands complete at once and queries are answered, both with the default values in the profile.
// `whole` includes the messages of the sub components.
std::unique_ptr<LocalComponent> stand_in(Context, ComponentProfile whole);

}  // namespace rois::basic
