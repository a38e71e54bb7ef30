// Compares the profiles of the basic components with tables 31 to 47 (and Move, whose table came later): methods, arguments and
// results, with name, type and order.
#include <gmock/gmock.h>

#include <map>

#include "types/data_type.hpp"
#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Methods = std::vector<std::string>;

std::string in_words(std::vector<ParameterProfile> const& list) {
    std::string words;
    for (auto const& one : list) words += " " + one.name + ":" + one.data_type_ref.code;
    return words;
}

// "event person_detected -> timestamp:DateTime number:int", "command set_parameter line:int[]".
std::string in_words(MessageProfile const& message) {
    static std::map<MessageKind, std::string> const kinds{
        {MessageKind::command, "command "}, {MessageKind::query, "query "}, {MessageKind::event, "event "}};
    auto const results = message.results.empty() ? "" : " ->" + in_words(message.results);
    return kinds.at(message.kind) + message.name + in_words(message.arguments) + results;
}

std::map<std::string, ComponentProfile> const& shipped() {
    static auto const all = [] {
        std::map<std::string, ComponentProfile> read;
        for (auto const& [name, text] : files::profiles())
            read[name.substr(0, name.find('.'))] = read_component_profile(schemas(), name, std::string{text});
        return read;
    }();
    return all;
}

Methods methods(std::string const& name) {
    Methods all;
    for (auto const& message : shipped().at(name).messages) all.push_back(in_words(message));
    return all;
}

// Returns set_parameter and get_parameter with the same parameters.
Methods with_parameters(std::string const& parameters) {
    return {"command set_parameter " + parameters, "query get_parameter -> " + parameters};
}

Methods operator+(Methods methods, std::string const& another) {
    methods.push_back(another);
    return methods;
}

TEST(BasicProfiles, RoISCommonHasTheMethodsOfItsTable) {
    EXPECT_THAT(methods("RoISCommon"), ElementsAre("command start", "command stop", "command suspend", "command resume",
                                                   "query component_status -> status:Component_Status"));
    for (auto const& [name, profile] : shipped()) {
        if (name == "RoISCommon" || name == "SystemInformation") {
            EXPECT_THAT(profile.sub_components, IsEmpty()) << name;
        } else {
            EXPECT_THAT(profile.sub_components, ElementsAre("urn:x-rois:def:component:OMG::RoISCommon")) << name;
        }
    }
}

TEST(BasicProfiles, SystemInformationHasTheMethodsOfItsTable) {
    EXPECT_THAT(methods("SystemInformation"),
                ElementsAre("query robot_position -> timestamp:DateTime robot_ref:RoISIdentifier[] position_data:string[]",
                            "query engine_status -> status:Component_Status operable_time:DateTime"));
}

TEST(BasicProfiles, DetectionLocalizationAndIdentificationHaveTheMethodsOfTheirTables) {
    Methods const limits = with_parameters("detection_threshold:int minimum_interval:int");
    for (auto const& [name, prefix] :
         {std::pair<std::string, std::string>{"Person", "person"}, {"Face", "face"}, {"Sound", "sound"}}) {
        EXPECT_EQ(methods(name + "Detection"), Methods{"event " + prefix + "_detected -> timestamp:DateTime number:int"});
        auto event = "event " + prefix;
        event.append("_localized -> timestamp:DateTime ").append(prefix).append("_ref:RoISIdentifier[] position_data:string[]");
        EXPECT_EQ(methods(name + "Localization"), limits + event);
    }
    EXPECT_EQ(methods("PersonIdentification"),
              Methods{"event person_identified -> timestamp:DateTime person_ref:RoISIdentifier[]"});
}

TEST(BasicProfiles, RecognitionHasTheMethodsOfItsTables) {
    EXPECT_THAT(
        methods("SpeechRecognition"),
        ElementsAre("command set_parameter languages:string[] grammar:string rule:string",
                    "query get_parameter -> recognizable_languages:string[] languages:string[] grammar:string rule:string",
                    "event speech_recognized -> timestamp:DateTime recognized_text:string[]",
                    "event speech_input_started -> timestamp:DateTime", "event speech_input_finished -> timestamp:DateTime"));
    EXPECT_THAT(methods("GestureRecognition"),
                ElementsAre("query get_parameter -> recognizable_gestures:RoISIdentifier[]",
                            "event gesture_recognized -> timestamp:DateTime gesture_ref:RoISIdentifier[]"));
}

TEST(BasicProfiles, ActionsHaveTheMethodsOfTheirTables) {
    EXPECT_THAT(
        methods("SpeechSynthesis"),
        ElementsAre("command set_parameter speech_text:string SSML_text:string volume:int language:string character:string",
                    "query get_parameter -> speech_text:string SSML_text:string volume:int language:string "
                    "character:string synthesizable_languages:string[] synthesizable_characters:string[]"));
    EXPECT_THAT(methods("Reaction"),
                ElementsAre("command set_parameter reaction_ref:RoISIdentifier",
                            "query get_parameter -> available_reactions:RoISIdentifier[] reaction_ref:RoISIdentifier"));
    EXPECT_EQ(methods("Navigation"), with_parameters("target_position:string[] time_limit:int routing_policy:string") +
                                         "event reached_target -> target:string is_final_target:bool");
    EXPECT_EQ(methods("Follow"), with_parameters("target_object_ref:RoISIdentifier distance:int time_limit:int"));
    EXPECT_EQ(methods("Move"), with_parameters("line:int[] curve:int[] time:int"));
}

// RoIS 2.0. The stream id of the query is an argument there; here it is in the condition, and a result.
TEST(BasicProfiles, StreamingHasTheMethodsOfRoIS20) {
    for (auto const* name : {"AudioStreaming", "VideoStreaming"})
        EXPECT_THAT(
            methods(name),
            ElementsAre("command set_parameter encoding_parameters:string transport_parameters:string",
                        "command connect_stream -> stream_id:string encoding_parameters:string transport_parameters:string",
                        "command disconnect_stream stream_id:string", "command suspend_stream stream_id:string",
                        "command resume_stream stream_id:string",
                        "query get_parameter -> encoding_parameters:string transport_parameters:string "
                        "available_encodings:string available_transports:string",
                        "query get_stream_status -> stream_id:string status:Stream_Status",
                        "event notify_stream_status -> stream_id:string timestamp:DateTime status:Stream_Status"))
            << name;
}

// 7.2: symbolic data only, no types for data of cameras, microphones or motors.
TEST(BasicProfiles, UseOnlySymbolicTypes) {
    auto const symbolic = [](std::string const& name, std::vector<ParameterProfile> const& list) {
        for (auto const& one : list) EXPECT_NE(DataType::of(one.data_type_ref).base, BaseType::other) << name << " " << one.name;
    };
    for (auto const& [name, profile] : shipped()) {
        symbolic(name, profile.parameters);
        for (auto const& message : profile.messages) {
            symbolic(name, message.arguments);
            symbolic(name, message.results);
        }
    }
}

// The arguments of set_parameter are the component's parameters (table 29), in the same order.
TEST(BasicProfiles, HaveTheParametersOfSetParameter) {
    for (auto const& [name, profile] : shipped())
        for (auto const& message : profile.messages)
            if (message.name == "set_parameter") {
                EXPECT_EQ(in_words(profile.parameters), in_words(message.arguments)) << name;
            }
}

}  // namespace
}  // namespace rois::xml
