// The published classes of the components: convert arguments and results, and call the session.
#include "psm/session.hpp"
#include "rois/psm/RoIS_Audio_Streaming.hpp"
#include "rois/psm/RoIS_Face_Detection.hpp"
#include "rois/psm/RoIS_Face_Localization.hpp"
#include "rois/psm/RoIS_Follow.hpp"
#include "rois/psm/RoIS_Gesture_Recognition.hpp"
#include "rois/psm/RoIS_Move.hpp"
#include "rois/psm/RoIS_Navigation.hpp"
#include "rois/psm/RoIS_Person_Detection.hpp"
#include "rois/psm/RoIS_Person_Identification.hpp"
#include "rois/psm/RoIS_Person_Localization.hpp"
#include "rois/psm/RoIS_Reaction.hpp"
#include "rois/psm/RoIS_Sound_Detection.hpp"
#include "rois/psm/RoIS_Sound_Localization.hpp"
#include "rois/psm/RoIS_Speech_Recognition.hpp"
#include "rois/psm/RoIS_Speech_Synthesis.hpp"
#include "rois/psm/RoIS_System_Information.hpp"
#include "rois/psm/RoIS_Video_Streaming.hpp"

using rois::psm::Arguments;
using rois::psm::EventResults;
using rois::psm::Session;

namespace {

RoIS_HRI::ReturnCode_t set_parameters(std::string const& component_type, Arguments const& arguments) {
    return Session::instance().run(component_type, "set_parameter", arguments.list());
}

RoIS_HRI::ReturnCode_t get_parameters(std::string const& component_type, EventResults& parameters) {
    return Session::instance().query(component_type, "get_parameter", {}, parameters);
}

// The parameters of the three localizations.
RoIS_HRI::ReturnCode_t set_thresholds(std::string const& component_type, RoIS_HRI::Integer detection_threshold,
                                      RoIS_HRI::Integer minimum_interval) {
    Arguments arguments;
    arguments.integer("detection_threshold", detection_threshold);
    arguments.integer("minimum_interval", minimum_interval);
    return set_parameters(component_type, arguments);
}

RoIS_HRI::ReturnCode_t get_thresholds(std::string const& component_type, RoIS_HRI::Integer& detection_threshold,
                                      RoIS_HRI::Integer& minimum_interval) {
    EventResults parameters;
    auto const code = get_parameters(component_type, parameters);
    if (code != RoIS_HRI::OK) return code;
    detection_threshold = parameters.integer("detection_threshold");
    minimum_interval = parameters.integer("minimum_interval");
    return code;
}

// The parameters of the two streaming components.
RoIS_HRI::ReturnCode_t set_stream_parameters(std::string const& component_type, std::string encodings, std::string transports) {
    Arguments arguments;
    arguments.text("encoding_parameters", std::move(encodings));
    arguments.text("transport_parameters", std::move(transports));
    return set_parameters(component_type, arguments);
}

RoIS_HRI::ReturnCode_t get_stream_parameters(std::string const& component_type, std::string& encodings, std::string& transports) {
    EventResults parameters;
    auto const code = get_parameters(component_type, parameters);
    if (code != RoIS_HRI::OK) return code;
    encodings = parameters.text("available_encodings");
    transports = parameters.text("available_transports");
    return code;
}

// Runs a command on a stream until it has completed.
RoIS_HRI::ReturnCode_t run_stream(std::string const& component_type, std::string command_type, std::string stream_id) {
    EventResults none;
    return Session::instance().run_to_the_end(component_type, std::move(command_type),
                                              {rois::text("stream_id", std::move(stream_id))}, none);
}

RoIS_HRI::ReturnCode_t begin_stream(std::string const& component_type, std::string& stream_id) {
    EventResults results;
    auto const code = Session::instance().run_to_the_end(component_type, "connect_stream", {}, results);
    if (code == RoIS_HRI::OK) stream_id = results.text("stream_id");
    return code;
}

RoIS_HRI::ReturnCode_t ask_stream(std::string const& component_type, std::string const& stream_id,
                                  RoIS_Common::Stream_Status& status) {
    std::optional<rois::Condition> which;
    if (!stream_id.empty()) which = rois::conditions::result("stream_id") == stream_id;
    EventResults results;
    auto const code = Session::instance().query(component_type, "get_stream_status", std::move(which), results);
    if (code != RoIS_HRI::OK || rois::psm::read_status(results.text("status"), status)) return code;
    rois::psm::set_reason("the answer has no status");
    return RoIS_HRI::ERROR;
}

}  // namespace

namespace System_Information {

RoIS_HRI::ReturnCode_t Query::robot_position(RoIS_HRI::DateTime& timestamp, RoIS_HRI::RoIS_IdentifierList& robot_ref,
                                             std::vector<RoLo::Architecture::Data>& position_data) {
    return Session::instance().call(rois::Query{"robot_position", {}}, [&](rois::Query::Reply const& reply) {
        EventResults const results{reply.results.parameters};
        timestamp = results.time("timestamp");
        robot_ref = results.identifiers("robot_ref");
        position_data = results.points("position_data");
    });
}

RoIS_HRI::ReturnCode_t Query::engine_status(RoIS_Common::Component_Status& status,
                                            std::vector<RoIS_HRI::DateTime>& operable_time) {
    bool understood = true;
    auto const code = Session::instance().call(rois::Query{"engine_status", {}}, [&](rois::Query::Reply const& reply) {
        EventResults const results{reply.results.parameters};
        understood = rois::psm::read_status(results.text("status"), status);
        if (understood) operable_time = results.texts("operable_time");
    });
    if (understood) return code;
    rois::psm::set_reason("the answer has no status");
    return RoIS_HRI::ERROR;
}

}  // namespace System_Information

namespace Person_Detection {

void Event::person_detected(RoIS_HRI::DateTime, RoIS_HRI::Integer) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "person_detected") person_detected(results.time("timestamp"), results.integer("number"));
}

}  // namespace Person_Detection

namespace Person_Localization {

RoIS_HRI::ReturnCode_t Command::set_parameter(RoIS_HRI::Integer detection_threshold, RoIS_HRI::Integer minimum_interval) {
    return set_thresholds(component_type(), detection_threshold, minimum_interval);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(RoIS_HRI::Integer& detection_threshold, RoIS_HRI::Integer& minimum_interval) {
    return get_thresholds(component_type(), detection_threshold, minimum_interval);
}

void Event::person_localized(RoIS_HRI::DateTime, RoIS_HRI::RoIS_IdentifierList, std::vector<RoLo::Architecture::Data>) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "person_localized")
        person_localized(results.time("timestamp"), results.identifiers("person_ref"), results.points("position_data"));
}

}  // namespace Person_Localization

namespace Person_Identification {

void Event::person_identified(RoIS_HRI::DateTime, RoIS_HRI::RoIS_IdentifierList) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "person_identified") person_identified(results.time("timestamp"), results.identifiers("person_ref"));
}

}  // namespace Person_Identification

namespace Face_Detection {

void Event::face_detected(RoIS_HRI::DateTime, RoIS_HRI::Integer) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "face_detected") face_detected(results.time("timestamp"), results.integer("number"));
}

}  // namespace Face_Detection

namespace Face_Localization {

RoIS_HRI::ReturnCode_t Command::set_parameter(RoIS_HRI::Integer detection_threshold, RoIS_HRI::Integer minimum_interval) {
    return set_thresholds(component_type(), detection_threshold, minimum_interval);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(RoIS_HRI::Integer& detection_threshold, RoIS_HRI::Integer& minimum_interval) {
    return get_thresholds(component_type(), detection_threshold, minimum_interval);
}

void Event::face_localized(RoIS_HRI::DateTime, RoIS_HRI::RoIS_IdentifierList, std::vector<RoLo::Architecture::Data>) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "face_localized")
        face_localized(results.time("timestamp"), results.identifiers("face_ref"), results.points("position_data"));
}

}  // namespace Face_Localization

namespace Sound_Detection {

void Event::sound_detected(RoIS_HRI::DateTime, RoIS_HRI::Integer) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "sound_detected") sound_detected(results.time("timestamp"), results.integer("number"));
}

}  // namespace Sound_Detection

namespace Sound_Localization {

RoIS_HRI::ReturnCode_t Command::set_parameter(RoIS_HRI::Integer detection_threshold, RoIS_HRI::Integer minimum_interval) {
    return set_thresholds(component_type(), detection_threshold, minimum_interval);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(RoIS_HRI::Integer& detection_threshold, RoIS_HRI::Integer& minimum_interval) {
    return get_thresholds(component_type(), detection_threshold, minimum_interval);
}

void Event::sound_localized(RoIS_HRI::DateTime, RoIS_HRI::RoIS_IdentifierList, std::vector<RoLo::Architecture::Data>) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "sound_localized")
        sound_localized(results.time("timestamp"), results.identifiers("sound_ref"), results.points("position_data"));
}

}  // namespace Sound_Localization

namespace Speech_Recognition {

RoIS_HRI::ReturnCode_t Command::set_parameter(std::vector<std::string> languages, std::string grammer, std::string rule) {
    Arguments arguments;
    arguments.texts("languages", std::move(languages));
    arguments.text("grammar", std::move(grammer));
    arguments.text("rule", std::move(rule));
    return set_parameters(component_type(), arguments);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(std::vector<std::string>& recognizable_languages, std::vector<std::string>& languages,
                                            std::string& grammer, std::string& rule) {
    EventResults parameters;
    auto const code = get_parameters(component_type(), parameters);
    if (code != RoIS_HRI::OK) return code;
    recognizable_languages = parameters.texts("recognizable_languages");
    languages = parameters.texts("languages");
    grammer = parameters.text("grammar");
    rule = parameters.text("rule");
    return code;
}

void Event::speech_recognized(RoIS_HRI::DateTime, std::vector<std::string>) {}
void Event::speech_input_started(RoIS_HRI::DateTime) {}
void Event::speech_input_finished(RoIS_HRI::DateTime) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "speech_recognized") speech_recognized(results.time("timestamp"), results.texts("recognized_text"));
    if (event_type == "speech_input_started") speech_input_started(results.time("timestamp"));
    if (event_type == "speech_input_finished") speech_input_finished(results.time("timestamp"));
}

}  // namespace Speech_Recognition

namespace Gesture_Recognition {

RoIS_HRI::ReturnCode_t Query::get_parameter(RoIS_HRI::RoIS_IdentifierList& recognizable_gestures) {
    EventResults parameters;
    auto const code = get_parameters(component_type(), parameters);
    if (code != RoIS_HRI::OK) return code;
    recognizable_gestures = parameters.identifiers("recognizable_gestures");
    return code;
}

void Event::gesture_recognized(RoIS_HRI::DateTime, RoIS_HRI::RoIS_IdentifierList) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    if (event_type == "gesture_recognized") gesture_recognized(results.time("timestamp"), results.identifiers("gesture_ref"));
}

}  // namespace Gesture_Recognition

namespace Speech_Synthesis {

RoIS_HRI::ReturnCode_t Command::set_parameter(std::string speech_text, std::string SSML_text, RoIS_HRI::Integer volume,
                                              std::string language, RoIS_HRI::RoIS_Identifier character) {
    Arguments arguments;
    arguments.text("speech_text", std::move(speech_text));
    arguments.text("SSML_text", std::move(SSML_text));
    arguments.integer("volume", volume);
    arguments.text("language", std::move(language));
    arguments.text("character", std::move(character));
    return set_parameters(component_type(), arguments);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(std::string& speech_text, std::string& SSML_text, RoIS_HRI::Integer& volume,
                                            std::string& language, RoIS_HRI::RoIS_Identifier& character,
                                            std::vector<std::string>& synthesizable_languages,
                                            RoIS_HRI::RoIS_IdentifierList& synthesizable_characters) {
    EventResults parameters;
    auto const code = get_parameters(component_type(), parameters);
    if (code != RoIS_HRI::OK) return code;
    speech_text = parameters.text("speech_text");
    SSML_text = parameters.text("SSML_text");
    volume = parameters.integer("volume");
    language = parameters.text("language");
    character = parameters.identifier("character");
    synthesizable_languages = parameters.texts("synthesizable_languages");
    synthesizable_characters = parameters.identifiers("synthesizable_characters");
    return code;
}

}  // namespace Speech_Synthesis

namespace Reaction {

RoIS_HRI::ReturnCode_t Command::set_parameter(RoIS_HRI::RoIS_IdentifierList reaction_ref) {
    Arguments arguments;
    arguments.identifiers("reaction_ref", std::move(reaction_ref));
    return set_parameters(component_type(), arguments);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(RoIS_HRI::RoIS_IdentifierList& available_reactions,
                                            RoIS_HRI::RoIS_Identifier& reaction_ref) {
    EventResults parameters;
    auto const code = get_parameters(component_type(), parameters);
    if (code != RoIS_HRI::OK) return code;
    available_reactions = parameters.identifiers("available_reactions");
    reaction_ref = parameters.identifier("reaction_ref");
    return code;
}

}  // namespace Reaction

namespace Navigation {

RoIS_HRI::ReturnCode_t Command::set_parameter(std::vector<RoLo::Architecture::Data> target_position, RoIS_HRI::Integer time_limit,
                                              std::string routing_policy) {
    Arguments arguments;
    arguments.points("target_position", std::move(target_position));
    arguments.integer("time_limit", time_limit);
    arguments.text("routing_policy", std::move(routing_policy));
    return set_parameters(component_type(), arguments);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(std::vector<RoLo::Architecture::Data>& target_position, RoIS_HRI::Integer& time_limit,
                                            std::string& routing_policy) {
    EventResults parameters;
    auto const code = get_parameters(component_type(), parameters);
    if (code != RoIS_HRI::OK) return code;
    target_position = parameters.points("target_position");
    time_limit = parameters.integer("time_limit");
    routing_policy = parameters.text("routing_policy");
    return code;
}

}  // namespace Navigation

namespace Follow {

RoIS_HRI::ReturnCode_t Command::set_parameter(RoIS_HRI::RoIS_Identifier target_object_ref, RoIS_HRI::Integer distance,
                                              RoIS_HRI::Integer time_limit) {
    Arguments arguments;
    arguments.identifier("target_object_ref", std::move(target_object_ref));
    arguments.integer("distance", distance);
    arguments.integer("time_limit", time_limit);
    return set_parameters(component_type(), arguments);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(RoIS_HRI::RoIS_Identifier& target_object_ref, RoIS_HRI::Integer& distance,
                                            RoIS_HRI::Integer& time_limit) {
    EventResults parameters;
    auto const code = get_parameters(component_type(), parameters);
    if (code != RoIS_HRI::OK) return code;
    target_object_ref = parameters.identifier("target_object_ref");
    distance = parameters.integer("distance");
    time_limit = parameters.integer("time_limit");
    return code;
}

}  // namespace Follow

namespace Move {

RoIS_HRI::ReturnCode_t Command::set_parameter(std::vector<RoIS_HRI::Integer> line, std::vector<RoIS_HRI::Integer> curve,
                                              RoIS_HRI::Integer time) {
    Arguments arguments;
    arguments.integers("line", line);
    arguments.integers("curve", curve);
    arguments.integer("time", time);
    return set_parameters(component_type(), arguments);
}

RoIS_HRI::ReturnCode_t Query::get_parameter(std::vector<RoIS_HRI::Integer>& line, std::vector<RoIS_HRI::Integer>& curve,
                                            RoIS_HRI::Integer& time) {
    EventResults parameters;
    auto const code = get_parameters(component_type(), parameters);
    if (code != RoIS_HRI::OK) return code;
    line = parameters.integers("line");
    curve = parameters.integers("curve");
    time = parameters.integer("time");
    return code;
}

}  // namespace Move

namespace Audio_Streaming {

RoIS_HRI::ReturnCode_t Command::set_parameter(std::string encoding_parameters, std::string transport_parameters) {
    return set_stream_parameters(component_type(), std::move(encoding_parameters), std::move(transport_parameters));
}

RoIS_HRI::ReturnCode_t Command::connect_stream(std::string& stream_id) { return begin_stream(component_type(), stream_id); }

RoIS_HRI::ReturnCode_t Command::disconnect_stream(std::string stream_id) {
    return run_stream(component_type(), "disconnect_stream", std::move(stream_id));
}

RoIS_HRI::ReturnCode_t Command::suspend_stream(std::string stream_id) {
    return run_stream(component_type(), "suspend_stream", std::move(stream_id));
}

RoIS_HRI::ReturnCode_t Command::resume_stream(std::string stream_id) {
    return run_stream(component_type(), "resume_stream", std::move(stream_id));
}

RoIS_HRI::ReturnCode_t Query::get_parameter(std::string& available_encodings, std::string& available_transports) {
    return get_stream_parameters(component_type(), available_encodings, available_transports);
}

RoIS_HRI::ReturnCode_t Query::get_stream_status(std::string stream_id, RoIS_Common::Stream_Status& status) {
    return ask_stream(component_type(), stream_id, status);
}

void Event::notify_stream_status(std::string, RoIS_HRI::DateTime, RoIS_Common::Stream_Status) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    RoIS_Common::Stream_Status status{};
    if (event_type == "notify_stream_status" && rois::psm::read_status(results.text("status"), status))
        notify_stream_status(results.text("stream_id"), results.time("timestamp"), status);
}

}  // namespace Audio_Streaming

namespace Video_Streaming {

RoIS_HRI::ReturnCode_t Command::set_parameter(std::string encoding_parameters, std::string transport_parameters) {
    return set_stream_parameters(component_type(), std::move(encoding_parameters), std::move(transport_parameters));
}

RoIS_HRI::ReturnCode_t Command::connect_stream(std::string& stream_id) { return begin_stream(component_type(), stream_id); }

RoIS_HRI::ReturnCode_t Command::disconnect_stream(std::string stream_id) {
    return run_stream(component_type(), "disconnect_stream", std::move(stream_id));
}

RoIS_HRI::ReturnCode_t Command::suspend_stream(std::string stream_id) {
    return run_stream(component_type(), "suspend_stream", std::move(stream_id));
}

RoIS_HRI::ReturnCode_t Command::resume_stream(std::string stream_id) {
    return run_stream(component_type(), "resume_stream", std::move(stream_id));
}

RoIS_HRI::ReturnCode_t Query::get_parameter(std::string& available_encodings, std::string& available_transports) {
    return get_stream_parameters(component_type(), available_encodings, available_transports);
}

RoIS_HRI::ReturnCode_t Query::get_stream_status(std::string stream_id, RoIS_Common::Stream_Status& status) {
    return ask_stream(component_type(), stream_id, status);
}

void Event::notify_stream_status(std::string, RoIS_HRI::DateTime, RoIS_Common::Stream_Status) {}

void Event::deliver(std::string const& event_type, EventResults const& results) {
    RoIS_Common::Stream_Status status{};
    if (event_type == "notify_stream_status" && rois::psm::read_status(results.text("status"), status))
        notify_stream_status(results.text("stream_id"), results.time("timestamp"), status);
}

}  // namespace Video_Streaming
