// Makers of the basic components (7.6), each defined in the file of its name. For robot_components.cpp.
#pragma once

#include <memory>

#include "simulation/robot_component.hpp"

namespace rois::simulation {

std::unique_ptr<Component> system_information(Fitting);
std::unique_ptr<Component> person_detection(Fitting);
std::unique_ptr<Component> person_localization(Fitting);
std::unique_ptr<Component> person_identification(Fitting);
std::unique_ptr<Component> face_detection(Fitting);
std::unique_ptr<Component> face_localization(Fitting);
std::unique_ptr<Component> sound_detection(Fitting);
std::unique_ptr<Component> sound_localization(Fitting);
std::unique_ptr<Component> speech_recognition(Fitting);
std::unique_ptr<Component> gesture_recognition(Fitting);
std::unique_ptr<Component> speech_synthesis(Fitting);
std::unique_ptr<Component> reaction(Fitting);
std::unique_ptr<Component> navigation(Fitting);
std::unique_ptr<Component> follow(Fitting);
std::unique_ptr<Component> move(Fitting);

}  // namespace rois::simulation
