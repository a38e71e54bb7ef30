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

std::unique_ptr<Component> system_information(Context);
std::unique_ptr<Component> person_detection(Context);
std::unique_ptr<Component> person_localization(Context);
std::unique_ptr<Component> person_identification(Context);
std::unique_ptr<Component> face_detection(Context);
std::unique_ptr<Component> face_localization(Context);
std::unique_ptr<Component> sound_detection(Context);
std::unique_ptr<Component> sound_localization(Context);
std::unique_ptr<Component> speech_recognition(Context);
std::unique_ptr<Component> gesture_recognition(Context);
std::unique_ptr<Component> speech_synthesis(Context);
std::unique_ptr<Component> reaction(Context);
std::unique_ptr<Component> navigation(Context);
std::unique_ptr<Component> follow(Context);
std::unique_ptr<Component> move(Context);
std::unique_ptr<Component> audio_streaming(Context);
std::unique_ptr<Component> video_streaming(Context);

struct BasicComponent {
    std::string_view ref;       // its name in table 31: "navigation"
    std::string_view urn_name;  // the last part of its profile's URN
    std::unique_ptr<Component> (*make)(Context);
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
