// The basic components (7.6) and the two streaming components of RoIS 2.0. Each function that makes one is defined in the source
// file of its name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "basic/base/robot_component.hpp"

namespace rois::basic {

std::unique_ptr<LocalComponent> system_information(Context);
std::unique_ptr<LocalComponent> person_detection(Context);
std::unique_ptr<LocalComponent> person_localization(Context);
std::unique_ptr<LocalComponent> person_identification(Context);
std::unique_ptr<LocalComponent> face_detection(Context);
std::unique_ptr<LocalComponent> face_localization(Context);
std::unique_ptr<LocalComponent> sound_detection(Context);
std::unique_ptr<LocalComponent> sound_localization(Context);
std::unique_ptr<LocalComponent> speech_recognition(Context);
std::unique_ptr<LocalComponent> gesture_recognition(Context);
std::unique_ptr<LocalComponent> speech_synthesis(Context);
std::unique_ptr<LocalComponent> reaction(Context);
std::unique_ptr<LocalComponent> navigation(Context);
std::unique_ptr<LocalComponent> follow(Context);
std::unique_ptr<LocalComponent> move(Context);
std::unique_ptr<LocalComponent> audio_streaming(Context);
std::unique_ptr<LocalComponent> video_streaming(Context);

struct BasicComponent {
    std::string_view ref;       // its name in table 31: "navigation"
    std::string_view urn_name;  // the last part of its profile's URN
    std::unique_ptr<LocalComponent> (*make)(Context);
    bool acts = false;  // needs a body that is not fixed
};

// Returns all basic components, in the order of the specification.
std::span<BasicComponent const> basic_components();

// Whether this is the name of a basic component, the streaming ones included.
bool is_basic(std::string_view name);

// Whether a media server is available for streaming.
enum class Streams : std::uint8_t { none, served };

// Returns the available basic components. The streaming ones need a media server.
std::span<BasicComponent const> basic_components(Streams);

// Returns the URN of the component's profile.
inline std::string urn_of(BasicComponent const& basic) { return "urn:x-rois:def:component:OMG::" + std::string{basic.urn_name}; }

}  // namespace rois::basic
