// The basic components (7.6, and the two of RoIS 2.0) and their makers, each defined in the file of its name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

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
std::unique_ptr<Component> audio_streaming(Fitting);
std::unique_ptr<Component> video_streaming(Fitting);

struct BasicComponent {
    std::string_view ref;       // as in table 31
    std::string_view urn_name;  // the last part of its profile's URN
    std::unique_ptr<Component> (*make)(Fitting);
};

// All of them, in the order of the specification.
std::span<BasicComponent const> basic_components();

// Whether there are media, through which components stream.
enum class Streams : std::uint8_t { none, served };

// Those that can be made: without streams none that stream.
std::span<BasicComponent const> basic_components(Streams);
inline Streams streams(std::shared_ptr<media::Media> const& media) { return media ? Streams::served : Streams::none; }

// Of its profile.
inline std::string urn_of(BasicComponent const& basic) { return "urn:x-rois:def:component:OMG::" + std::string{basic.urn_name}; }

}  // namespace rois::simulation
