#include "simulation/component_refs.hpp"

#include <array>

namespace rois::simulation {

namespace {

constexpr std::array<std::string_view, 15> components{"system_information",
                                                      "person_detection",
                                                      "person_localization",
                                                      "person_identification",
                                                      "face_detection",
                                                      "face_localization",
                                                      "sound_detection",
                                                      "sound_localization",
                                                      "speech_recognition",
                                                      "gesture_recognition",
                                                      "speech_synthesis",
                                                      "reaction",
                                                      "navigation",
                                                      "follow",
                                                      "move"};

}  // namespace

std::string component_ref(std::string_view component, std::string_view engine) {
    return engine.empty() ? std::string{component} : std::string{engine} + "." + std::string{component};
}

std::vector<std::string> component_refs(FloorPlan const& plan) {
    std::vector<std::string> refs;
    for (auto const& robot : plan.robots) {
        bool const first = &robot == &plan.robots.front();
        for (auto const component : components) refs.push_back(component_ref(component, first ? "" : robot.name));
    }
    return refs;
}

}  // namespace rois::simulation
