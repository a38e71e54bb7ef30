// The 15 basic components (7.6, tables 34 to 46 and Move) and the two streaming components (version 2.0), with the names of the
// specification and types with units. Their parameters are in parameters.hpp. A result that is missing in an event is zero or
// empty.
//
// All classes are handles like Component, with the same rules for threads (component.hpp); the structs are plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rois/component.hpp"
#include "rois/parameters.hpp"
#include "rois/units.hpp"

namespace rois {

// --- System Information (table 34) ---

// A person or object, and its pose.
struct Sighting {
    Identifier ref{};
    Pose pose{};
};

struct RobotPosition {
    Utc timestamp{};
    std::vector<Sighting> robots{};
};

struct EngineStatus {
    ComponentStatus status = ComponentStatus::uninitialized;
    std::optional<Utc> operable_time{};
};

class SystemInformation : public Component {
public:
    static constexpr std::string_view component_type = "SystemInformation";
    explicit SystemInformation(Component component) : Component{std::move(component)} {}

    Task<RobotPosition> robot_position() const;
    Task<EngineStatus> engine_status() const;
};

// --- Detection of people, faces and sounds (tables 35, 38, 40) ---

struct PersonDetected {
    static constexpr std::string_view name = "person_detected";
    static PersonDetected from(ReceiveEvent const&);
    Utc timestamp{};
    std::int32_t number = 0;
};

struct FaceDetected {
    static constexpr std::string_view name = "face_detected";
    static FaceDetected from(ReceiveEvent const&);
    Utc timestamp{};
    std::int32_t number = 0;
};

struct SoundDetected {
    static constexpr std::string_view name = "sound_detected";
    static SoundDetected from(ReceiveEvent const&);
    Utc timestamp{};
    std::int32_t number = 0;
};

class PersonDetection : public Component {
public:
    static constexpr std::string_view component_type = "PersonDetection";
    explicit PersonDetection(Component component) : Component{std::move(component)} {}
    auto person_detected(QueryExpression condition = {}) const { return events<PersonDetected>(std::move(condition)); }
};

class FaceDetection : public Component {
public:
    static constexpr std::string_view component_type = "FaceDetection";
    explicit FaceDetection(Component component) : Component{std::move(component)} {}
    auto face_detected(QueryExpression condition = {}) const { return events<FaceDetected>(std::move(condition)); }
};

class SoundDetection : public Component {
public:
    static constexpr std::string_view component_type = "SoundDetection";
    explicit SoundDetection(Component component) : Component{std::move(component)} {}
    auto sound_detected(QueryExpression condition = {}) const { return events<SoundDetected>(std::move(condition)); }
};

// --- Localization of people, faces and sounds (tables 36, 39, 41) ---

struct PersonLocalized {
    static constexpr std::string_view name = "person_localized";
    static PersonLocalized from(ReceiveEvent const&);
    Utc timestamp{};
    std::vector<Sighting> people{};
};

struct FaceLocalized {
    static constexpr std::string_view name = "face_localized";
    static FaceLocalized from(ReceiveEvent const&);
    Utc timestamp{};
    std::vector<Sighting> faces{};
};

struct SoundLocalized {
    static constexpr std::string_view name = "sound_localized";
    static SoundLocalized from(ReceiveEvent const&);
    Utc timestamp{};
    std::vector<Sighting> sounds{};
};

class Localization : public Component {
public:
    explicit Localization(Component component) : Component{std::move(component)} {}
    Task<Completion> set(LocalizationParameters const&) const;
    Task<LocalizationParameters> parameters() const;
};

class PersonLocalization : public Localization {
public:
    static constexpr std::string_view component_type = "PersonLocalization";
    using Localization::Localization;
    auto person_localized(QueryExpression condition = {}) const { return events<PersonLocalized>(std::move(condition)); }
};

class FaceLocalization : public Localization {
public:
    static constexpr std::string_view component_type = "FaceLocalization";
    using Localization::Localization;
    auto face_localized(QueryExpression condition = {}) const { return events<FaceLocalized>(std::move(condition)); }
};

class SoundLocalization : public Localization {
public:
    static constexpr std::string_view component_type = "SoundLocalization";
    using Localization::Localization;
    auto sound_localized(QueryExpression condition = {}) const { return events<SoundLocalized>(std::move(condition)); }
};

// --- Person Identification (table 37) ---

struct PersonIdentified {
    static constexpr std::string_view name = "person_identified";
    static PersonIdentified from(ReceiveEvent const&);
    Utc timestamp{};
    std::vector<Identifier> people{};
};

class PersonIdentification : public Component {
public:
    static constexpr std::string_view component_type = "PersonIdentification";
    explicit PersonIdentification(Component component) : Component{std::move(component)} {}
    auto person_identified(QueryExpression condition = {}) const { return events<PersonIdentified>(std::move(condition)); }
};

// --- Speech Recognition (table 42) ---

struct SpeechRecognized {
    static constexpr std::string_view name = "speech_recognized";
    static SpeechRecognized from(ReceiveEvent const&);
    Utc timestamp{};
    std::vector<std::string> recognized_text{};  // the most likely text first
};

struct SpeechInputStarted {
    static constexpr std::string_view name = "speech_input_started";
    static SpeechInputStarted from(ReceiveEvent const&);
    Utc timestamp{};
};

struct SpeechInputFinished {
    static constexpr std::string_view name = "speech_input_finished";
    static SpeechInputFinished from(ReceiveEvent const&);
    Utc timestamp{};
};

class SpeechRecognition : public Component {
public:
    static constexpr std::string_view component_type = "SpeechRecognition";
    explicit SpeechRecognition(Component component) : Component{std::move(component)} {}
    auto speech_recognized(QueryExpression condition = {}) const { return events<SpeechRecognized>(std::move(condition)); }
    auto speech_input_started(QueryExpression condition = {}) const { return events<SpeechInputStarted>(std::move(condition)); }
    auto speech_input_finished(QueryExpression condition = {}) const { return events<SpeechInputFinished>(std::move(condition)); }
    Task<Completion> set(SpeechRecognitionParameters const&) const;
    Task<SpeechRecognitionParameters> parameters() const;
};

// --- Gesture Recognition (table 43) ---

struct GestureRecognized {
    static constexpr std::string_view name = "gesture_recognized";
    static GestureRecognized from(ReceiveEvent const&);
    Utc timestamp{};
    std::vector<Identifier> gestures{};  // the most likely gesture first
};

class GestureRecognition : public Component {
public:
    static constexpr std::string_view component_type = "GestureRecognition";
    explicit GestureRecognition(Component component) : Component{std::move(component)} {}
    auto gesture_recognized(QueryExpression condition = {}) const { return events<GestureRecognized>(std::move(condition)); }
    Task<std::vector<Identifier>> recognizable_gestures() const;
};

// --- Speech Synthesis (table 44) ---

class SpeechSynthesis : public Component {
public:
    static constexpr std::string_view component_type = "SpeechSynthesis";
    explicit SpeechSynthesis(Component component) : Component{std::move(component)} {}
    // Returns when the text has been spoken.
    Task<Completion> say(std::string speech_text) const;
    Task<Completion> say(Speech const&) const;
    Task<Completion> set(Speech const&) const;
    Task<Speech> parameters() const;
};

// --- Reaction (table 45) ---

class Reaction : public Component {
public:
    static constexpr std::string_view component_type = "Reaction";
    explicit Reaction(Component component) : Component{std::move(component)} {}
    // Returns when the reaction has been performed. The code is one of `available_reactions` (annex D: "9" is a bow).
    Task<Completion> react(std::string reaction_ref) const;
    Task<std::vector<Identifier>> available_reactions() const;
};

// --- Navigation (table 46) ---

struct ReachedTarget {
    static constexpr std::string_view name = "reached_target";
    static ReachedTarget from(ReceiveEvent const&);
    std::string target{};  // as in target_position: a pose as text, or the name of a place
    bool is_final_target = false;
};

class Navigation : public Component {
public:
    static constexpr std::string_view component_type = "Navigation";
    explicit Navigation(Component component) : Component{std::move(component)} {}
    // Returns when the robot has reached the target; TIMEOUT if the time limit passed first.
    Task<Completion> go_to(Target, std::optional<Milliseconds> time_limit = {}) const;
    Task<Completion> go(NavigationParameters const&) const;
    auto reached_target(QueryExpression condition = {}) const { return events<ReachedTarget>(std::move(condition)); }
    Task<Completion> set(NavigationParameters const&) const;
    Task<NavigationParameters> parameters() const;
};

// --- Follow (7.6.14) ---

class Follow : public Component {
public:
    static constexpr std::string_view component_type = "Follow";
    explicit Follow(Component component) : Component{std::move(component)} {}
    // `follow` returns when the robot is stopped (OK) or the time limit has passed (TIMEOUT); `begin_following` returns when the
    // command is accepted.
    Task<Completion> follow(FollowParameters const&) const;
    Task<Command> begin_following(FollowParameters const&) const;
    Task<Completion> set(FollowParameters const&) const;
    Task<FollowParameters> parameters() const;
};

// --- Move (7.6.15) ---

class Move : public Component {
public:
    static constexpr std::string_view component_type = "Move";
    explicit Move(Component component) : Component{std::move(component)} {}
    // Returns when the motion has ended.
    Task<Completion> move(Line, std::optional<Milliseconds> time = {}) const;
    Task<Completion> move(Curve, std::optional<Milliseconds> time = {}) const;
    Task<Completion> set(MoveParameters const&) const;
    Task<MoveParameters> parameters() const;
};

// --- Audio Streaming, Video Streaming (RoIS 2.0; docs/streaming.md) ---

struct StreamOffer {
    std::string stream_id{};
    std::string encoding_parameters{};
    std::string transport_parameters{};
};

struct StreamStatusNotified {
    static constexpr std::string_view name = "notify_stream_status";
    static StreamStatusNotified from(ReceiveEvent const&);
    std::string stream_id{};
    Utc timestamp{};
    StreamStatus status = StreamStatus::not_running;
};

class Streaming : public Component {
public:
    explicit Streaming(Component component) : Component{std::move(component)} {}
    // Throws Error if the command does not complete with OK.
    Task<StreamOffer> connect_stream() const;
    Task<Completion> disconnect_stream(std::string stream_id) const;
    Task<Completion> suspend_stream(std::string stream_id) const;
    Task<Completion> resume_stream(std::string stream_id) const;
    Task<StreamStatus> get_stream_status() const;  // of the latest stream
    auto notify_stream_status(QueryExpression condition = {}) const { return events<StreamStatusNotified>(std::move(condition)); }
    Task<Completion> set(StreamParameters const&) const;
    Task<StreamParameters> parameters() const;
};

class AudioStreaming : public Streaming {
public:
    static constexpr std::string_view component_type = "AudioStreaming";
    using Streaming::Streaming;
};

class VideoStreaming : public Streaming {
public:
    static constexpr std::string_view component_type = "VideoStreaming";
    using Streaming::Streaming;
};

}  // namespace rois
