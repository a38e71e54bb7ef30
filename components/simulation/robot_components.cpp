#include "simulation/robot_components.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "simulation/basic_components.hpp"
#include "simulation/component_refs.hpp"
#include "simulation/faulty_component.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
namespace {

struct Basic {
    std::string_view ref;
    std::string_view urn_name;
    std::unique_ptr<Component> (*make)(Fitting);
};

constexpr std::array<Basic, 15> basics{{{"system_information", "SystemInformation", system_information},
                                        {"person_detection", "PersonDetection", person_detection},
                                        {"person_localization", "PersonLocalization", person_localization},
                                        {"person_identification", "PersonIdentification", person_identification},
                                        {"face_detection", "FaceDetection", face_detection},
                                        {"face_localization", "FaceLocalization", face_localization},
                                        {"sound_detection", "SoundDetection", sound_detection},
                                        {"sound_localization", "SoundLocalization", sound_localization},
                                        {"speech_recognition", "SpeechRecognition", speech_recognition},
                                        {"gesture_recognition", "GestureRecognition", gesture_recognition},
                                        {"speech_synthesis", "SpeechSynthesis", speech_synthesis},
                                        {"reaction", "Reaction", reaction},
                                        {"navigation", "Navigation", navigation},
                                        {"follow", "Follow", follow},
                                        {"move", "Move", move}}};

using SharedProfile = std::shared_ptr<ComponentProfile const>;

SharedProfile profile_of(Basic const& basic, std::vector<ComponentProfile> const& profiles) {
    std::string const urn = "urn:x-rois:def:component:OMG::" + std::string{basic.urn_name};
    auto const found = std::ranges::find_if(
        profiles, [&](ComponentProfile const& p) { return equal_ignoring_case(trimmed(p.object.identifier), urn); });
    if (found == profiles.end()) throw std::runtime_error("the component profile " + urn + " is missing");
    return std::make_shared<ComponentProfile const>(*found);
}

Fitting fitting(std::shared_ptr<Simulation> const& simulation, Robot const& robot, Basic const& basic, SharedProfile profile) {
    bool const first = robot.id == simulation->hall().robots().front().id;
    std::string const engine = first ? "" : robot.name;
    Identifier const identifier{.code = component_ref(basic.ref, engine),
                                .authority = profile->object.code_space,
                                .codebook_ref = profile->object.identifier,
                                .version = {}};
    return {.simulation = simulation, .robot = robot.id, .description = {identifier, engine, std::move(profile)}};
}

}  // namespace

std::vector<std::unique_ptr<Component>> robot_components(std::shared_ptr<Simulation> const& simulation,
                                                         std::vector<ComponentProfile> const& profiles) {
    std::array<SharedProfile, basics.size()> found;
    std::ranges::transform(basics, found.begin(), [&](Basic const& basic) { return profile_of(basic, profiles); });
    std::vector<std::unique_ptr<Component>> components;
    for (Robot const& robot : simulation->hall().robots())
        for (std::size_t i = 0; i < basics.size(); ++i)
            components.push_back(with_faults(basics[i].make(fitting(simulation, robot, basics[i], found[i])), simulation));
    return components;
}

}  // namespace rois::simulation
