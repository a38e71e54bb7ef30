#include "rois/components.hpp"

#include <cmath>

#include "reading.hpp"

namespace rois {

using client::Arguments;
using client::Reading;
using client::results_of;

namespace {

template <class Detected>
Detected detected(ReceiveEvent const& event) {
    Reading const read{results_of(event)};
    return {read.time("timestamp").value_or(Utc{}), read.integer("number").value_or(0)};
}

template <class Localized>
Localized localized(ReceiveEvent const& event, std::string_view refs) {
    Reading const read{results_of(event)};
    return {read.time("timestamp").value_or(Utc{}), read.sightings(refs, "position_data")};
}

std::int64_t rounded(double number) { return std::llround(number); }

std::optional<std::int64_t> rounded(std::optional<millimetres> length) {
    return length ? std::optional{rounded(length->value)} : std::nullopt;
}

std::optional<millimetres> length_of(std::optional<int> number) {
    return number ? std::optional{millimetres{static_cast<double>(*number)}} : std::nullopt;
}

// Gets the parameters of a component and converts them.
template <class Parameters>
Task<Parameters> read_parameters(Component component, Parameters (*made)(Reading const&)) {
    auto const list = co_await component.get_parameter();
    co_return made(Reading{list});
}

Task<std::vector<Identifier>> read_identifiers(Component component, std::string_view name) {
    auto const list = co_await component.get_parameter();
    co_return Reading{list}.identifiers(name);
}

}  // namespace

// --- System Information ---

namespace {

Task<RobotPosition> robot_position_of(Component component) {
    auto const results = co_await component.query("robot_position");
    Reading const read{results};
    RobotPosition position{read.time("timestamp").value_or(Utc{}), read.sightings("robot_ref", "position_data")};
    co_return position;
}

Task<EngineStatus> engine_status_of(Component component) {
    auto const results = co_await component.query("engine_status");
    Reading const read{results};
    auto const status = to_code<ComponentStatus>(read.text("status").value_or(""));
    EngineStatus engine_status{status.value_or(ComponentStatus::uninitialized), read.time("operable_time")};
    co_return engine_status;
}

}  // namespace

Task<RobotPosition> SystemInformation::robot_position() const { return robot_position_of(*this); }

Task<EngineStatus> SystemInformation::engine_status() const { return engine_status_of(*this); }

// --- Detection, localization, identification ---

PersonDetected PersonDetected::from(ReceiveEvent const& event) { return detected<PersonDetected>(event); }
FaceDetected FaceDetected::from(ReceiveEvent const& event) { return detected<FaceDetected>(event); }
SoundDetected SoundDetected::from(ReceiveEvent const& event) { return detected<SoundDetected>(event); }

PersonLocalized PersonLocalized::from(ReceiveEvent const& event) { return localized<PersonLocalized>(event, "person_ref"); }
FaceLocalized FaceLocalized::from(ReceiveEvent const& event) { return localized<FaceLocalized>(event, "face_ref"); }
SoundLocalized SoundLocalized::from(ReceiveEvent const& event) { return localized<SoundLocalized>(event, "sound_ref"); }

Task<Completion> Localization::set(LocalizationParameters const& parameters) const {
    return set_parameter(Arguments{}
                             .integer("detection_threshold", rounded(parameters.detection_threshold))
                             .milliseconds("minimum_interval", parameters.minimum_interval)
                             .list());
}

Task<LocalizationParameters> Localization::parameters() const {
    return read_parameters<LocalizationParameters>(*this, [](Reading const& read) {
        LocalizationParameters parameters;
        parameters.detection_threshold = length_of(read.integer("detection_threshold"));
        parameters.minimum_interval = read.milliseconds("minimum_interval");
        return parameters;
    });
}

PersonIdentified PersonIdentified::from(ReceiveEvent const& event) {
    Reading const read{results_of(event)};
    return {read.time("timestamp").value_or(Utc{}), read.identifiers("person_ref")};
}

// --- Speech and gestures ---

SpeechRecognized SpeechRecognized::from(ReceiveEvent const& event) {
    Reading const read{results_of(event)};
    return {read.time("timestamp").value_or(Utc{}), read.texts("recognized_text")};
}

SpeechInputStarted SpeechInputStarted::from(ReceiveEvent const& event) {
    return {Reading{results_of(event)}.time("timestamp").value_or(Utc{})};
}

SpeechInputFinished SpeechInputFinished::from(ReceiveEvent const& event) {
    return {Reading{results_of(event)}.time("timestamp").value_or(Utc{})};
}

Task<Completion> SpeechRecognition::set(SpeechRecognitionParameters const& parameters) const {
    return set_parameter(Arguments{}
                             .texts("languages", parameters.languages)
                             .text("grammar", parameters.grammar)
                             .text("rule", parameters.rule)
                             .list());
}

Task<SpeechRecognitionParameters> SpeechRecognition::parameters() const {
    return read_parameters<SpeechRecognitionParameters>(*this, [](Reading const& read) {
        SpeechRecognitionParameters parameters;
        parameters.languages = read.texts("languages");
        parameters.grammar = read.text("grammar");
        parameters.rule = read.text("rule");
        parameters.recognizable_languages = read.texts("recognizable_languages");
        return parameters;
    });
}

GestureRecognized GestureRecognized::from(ReceiveEvent const& event) {
    Reading const read{results_of(event)};
    return {read.time("timestamp").value_or(Utc{}), read.identifiers("gesture_ref")};
}

Task<std::vector<Identifier>> GestureRecognition::recognizable_gestures() const {
    return read_identifiers(*this, "recognizable_gestures");
}

namespace {

ParameterList arguments_of(Speech const& speech) {
    std::optional<std::int64_t> volume;
    if (speech.volume) volume = *speech.volume;
    return Arguments{}
        .text("speech_text", speech.speech_text)
        .text("SSML_text", speech.SSML_text)
        .integer("volume", volume)
        .text("language", speech.language)
        .text("character", speech.character)
        .list();
}

}  // namespace

Task<Completion> SpeechSynthesis::say(std::string speech_text) const {
    return start(Arguments{}.text("speech_text", std::move(speech_text)).list());
}

Task<Completion> SpeechSynthesis::say(Speech const& speech) const { return start(arguments_of(speech)); }

Task<Completion> SpeechSynthesis::set(Speech const& speech) const { return set_parameter(arguments_of(speech)); }

Task<Speech> SpeechSynthesis::parameters() const {
    return read_parameters<Speech>(*this, [](Reading const& read) {
        Speech speech;
        speech.speech_text = read.text("speech_text");
        speech.SSML_text = read.text("SSML_text");
        speech.volume = read.integer("volume");
        speech.language = read.text("language");
        speech.character = read.text("character");
        speech.synthesizable_languages = read.texts("synthesizable_languages");
        speech.synthesizable_characters = read.texts("synthesizable_characters");
        return speech;
    });
}

Task<Completion> Reaction::react(std::string reaction_ref) const {
    return start({reference("reaction_ref", std::move(reaction_ref))});
}

Task<std::vector<Identifier>> Reaction::available_reactions() const { return read_identifiers(*this, "available_reactions"); }

// --- Motion ---

ReachedTarget ReachedTarget::from(ReceiveEvent const& event) {
    Reading const read{results_of(event)};
    return {read.text("target").value_or(""), read.truth("is_final_target")};
}

Target::Target(Pose const& pose) : text{to_text(pose)}, crs{pose.crs} {}

namespace {

ParameterList arguments_of(NavigationParameters const& parameters) {
    std::vector<std::string> places;
    places.reserve(parameters.target_position.size());
    for (auto const& target : parameters.target_position) places.push_back(target.text);
    std::optional<std::string> policy;
    if (parameters.routing_policy) policy = *parameters.routing_policy == RoutingPolicy::time ? "time" : "distance";
    return Arguments{}
        .texts("target_position", places, places.empty() ? "" : parameters.target_position.front().crs)
        .milliseconds("time_limit", parameters.time_limit)
        .text("routing_policy", policy)
        .list();
}

ParameterList arguments_of(FollowParameters const& parameters) {
    return Arguments{}
        .identifier("target_object_ref", parameters.target_object_ref)
        .integer("distance", rounded(parameters.distance))
        .milliseconds("time_limit", parameters.time_limit)
        .list();
}

ParameterList arguments_of(MoveParameters const& parameters) {
    Arguments arguments;
    if (auto const& line = parameters.line)
        arguments.integers("line", {rounded(line->distance.value), rounded(line->direction.value)});
    if (auto const& curve = parameters.curve)
        arguments.integers("curve", {rounded(curve->radius.value), rounded(curve->direction.value)});
    return arguments.milliseconds("time", parameters.time).list();
}

}  // namespace

Task<Completion> Navigation::go_to(Target target, std::optional<Milliseconds> time_limit) const {
    auto parameters = NavigationParameters{}.with_target_position(std::move(target));
    parameters.time_limit = time_limit;
    return go(parameters);
}

Task<Completion> Navigation::go(NavigationParameters const& parameters) const { return start(arguments_of(parameters)); }

Task<Completion> Navigation::set(NavigationParameters const& parameters) const { return set_parameter(arguments_of(parameters)); }

Task<NavigationParameters> Navigation::parameters() const {
    return read_parameters<NavigationParameters>(*this, [](Reading const& read) {
        NavigationParameters parameters;
        parameters.time_limit = read.milliseconds("time_limit");
        for (auto& place : read.texts("target_position")) parameters.target_position.emplace_back(std::move(place));
        if (auto const policy = read.text("routing_policy"))
            parameters.routing_policy = *policy == "distance" ? RoutingPolicy::distance : RoutingPolicy::time;
        return parameters;
    });
}

Task<Completion> Follow::follow(FollowParameters const& parameters) const { return start(arguments_of(parameters)); }

Task<Command> Follow::begin_following(FollowParameters const& parameters) const {
    return begin("start", arguments_of(parameters));
}

Task<Completion> Follow::set(FollowParameters const& parameters) const { return set_parameter(arguments_of(parameters)); }

Task<FollowParameters> Follow::parameters() const {
    return read_parameters<FollowParameters>(*this, [](Reading const& read) {
        FollowParameters parameters;
        parameters.target_object_ref = read.identifier("target_object_ref");
        parameters.distance = length_of(read.integer("distance"));
        parameters.time_limit = read.milliseconds("time_limit");
        return parameters;
    });
}

Task<Completion> Move::move(Line line, std::optional<Milliseconds> time) const {
    auto parameters = MoveParameters{}.with_line(line);
    parameters.time = time;
    return start(arguments_of(parameters));
}

Task<Completion> Move::move(Curve curve, std::optional<Milliseconds> time) const {
    auto parameters = MoveParameters{}.with_curve(curve);
    parameters.time = time;
    return start(arguments_of(parameters));
}

Task<Completion> Move::set(MoveParameters const& parameters) const { return set_parameter(arguments_of(parameters)); }

Task<MoveParameters> Move::parameters() const {
    return read_parameters<MoveParameters>(*this, [](Reading const& read) {
        MoveParameters parameters;
        parameters.time = read.milliseconds("time");
        auto const line = read.numbers("line");
        if (line.size() == 2) parameters.line = Line{millimetres{line[0]}, degrees{line[1]}};
        auto const curve = read.numbers("curve");
        if (curve.size() == 2) parameters.curve = Curve{millimetres{curve[0]}, degrees{curve[1]}};
        return parameters;
    });
}

// --- Streams ---

StreamStatusNotified StreamStatusNotified::from(ReceiveEvent const& event) {
    Reading const read{results_of(event)};
    auto const status = to_code<StreamStatus>(read.text("status").value_or(""));
    return {read.text("stream_id").value_or(""), read.time("timestamp").value_or(Utc{}),
            status.value_or(StreamStatus::not_running)};
}

namespace {

Task<StreamOffer> connect_stream_of(Component component) {
    auto const command = co_await component.begin("connect_stream");
    auto const completion = co_await command.completed();
    if (completion != CompletedStatus::ok)
        throw Error{ReturnCode::error, "connect_stream of " + component.ref().code + ": " + to_text(completion)};
    auto const results = co_await command.results();
    Reading const read{results};
    StreamOffer offer{read.text("stream_id").value_or(""), read.text("encoding_parameters").value_or(""),
                      read.text("transport_parameters").value_or("")};
    co_return offer;
}

Task<StreamStatus> stream_status_of(Component component) {
    auto const results = co_await component.query("get_stream_status");
    auto const status = to_code<StreamStatus>(Reading{results}.text("status").value_or(""));
    if (!status) throw Error{ReturnCode::error, "get_stream_status of " + component.ref().code + ": the answer has no status"};
    co_return *status;
}

ParameterList stream(std::string stream_id) { return {text("stream_id", std::move(stream_id))}; }

}  // namespace

Task<StreamOffer> Streaming::connect_stream() const { return connect_stream_of(*this); }

Task<Completion> Streaming::disconnect_stream(std::string stream_id) const {
    return run("disconnect_stream", stream(std::move(stream_id)));
}

Task<Completion> Streaming::suspend_stream(std::string stream_id) const {
    return run("suspend_stream", stream(std::move(stream_id)));
}

Task<Completion> Streaming::resume_stream(std::string stream_id) const {
    return run("resume_stream", stream(std::move(stream_id)));
}

Task<StreamStatus> Streaming::get_stream_status() const { return stream_status_of(*this); }

Task<Completion> Streaming::set(StreamParameters const& parameters) const {
    return set_parameter(Arguments{}
                             .text("encoding_parameters", parameters.encoding_parameters)
                             .text("transport_parameters", parameters.transport_parameters)
                             .list());
}

Task<StreamParameters> Streaming::parameters() const {
    return read_parameters<StreamParameters>(*this, [](Reading const& read) {
        StreamParameters parameters;
        parameters.encoding_parameters = read.text("encoding_parameters");
        parameters.transport_parameters = read.text("transport_parameters");
        parameters.available_encodings = read.text("available_encodings").value_or("");
        parameters.available_transports = read.text("available_transports").value_or("");
        return parameters;
    });
}

}  // namespace rois
