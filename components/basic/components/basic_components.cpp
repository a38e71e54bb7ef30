#include "basic/components/basic_components.hpp"

#include <algorithm>
#include <array>

namespace rois::basic {

std::span<BasicComponent const> basic_components() {
    static constexpr std::array<BasicComponent, 17> all{{{"system_information", "SystemInformation", system_information},
                                                         {"person_detection", "PersonDetection", person_detection},
                                                         {"person_localization", "PersonLocalization", person_localization},
                                                         {"person_identification", "PersonIdentification", person_identification},
                                                         {"face_detection", "FaceDetection", face_detection},
                                                         {"face_localization", "FaceLocalization", face_localization},
                                                         {"sound_detection", "SoundDetection", sound_detection},
                                                         {"sound_localization", "SoundLocalization", sound_localization},
                                                         {"speech_recognition", "SpeechRecognition", speech_recognition},
                                                         {"gesture_recognition", "GestureRecognition", gesture_recognition},
                                                         {"speech_synthesis", "SpeechSynthesis", speech_synthesis, true},
                                                         {"reaction", "Reaction", reaction, true},
                                                         {"navigation", "Navigation", navigation, true},
                                                         {"follow", "Follow", follow, true},
                                                         {"move", "Move", move, true},
                                                         {"audio_streaming", "AudioStreaming", audio_streaming},
                                                         {"video_streaming", "VideoStreaming", video_streaming}}};
    return all;
}

bool is_basic(std::string_view name) {
    return std::ranges::find(basic_components(), name, &BasicComponent::ref) != basic_components().end();
}

std::span<BasicComponent const> basic_components(Streams streams) {
    constexpr std::size_t that_stream = 2;  // the last two of the list
    auto const all = basic_components();
    return streams == Streams::served ? all : all.first(all.size() - that_stream);
}

}  // namespace rois::basic
