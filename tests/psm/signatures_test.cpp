// The published names, types and signatures (section 7.7), checked by the compiler.
#include <gtest/gtest.h>

#include <type_traits>

#include "RoIS_Audio_Streaming.hpp"
#include "RoIS_Face_Detection.hpp"
#include "RoIS_Face_Localization.hpp"
#include "RoIS_Follow.hpp"
#include "RoIS_Gesture_Recognition.hpp"
#include "RoIS_Move.hpp"
#include "RoIS_Navigation.hpp"
#include "RoIS_Person_Detection.hpp"
#include "RoIS_Person_Identification.hpp"
#include "RoIS_Person_Localization.hpp"
#include "RoIS_Reaction.hpp"
#include "RoIS_Sound_Detection.hpp"
#include "RoIS_Sound_Localization.hpp"
#include "RoIS_Speech_Recognition.hpp"
#include "RoIS_Speech_Synthesis.hpp"
#include "RoIS_System_Information.hpp"
#include "RoIS_Video_Streaming.hpp"

namespace {

using RoIS_HRI::Integer;
using RoIS_HRI::RoIS_Identifier;
using RoIS_HRI::RoIS_IdentifierList;
using Code = RoIS_HRI::ReturnCode_t;
using Text = std::string;
using Texts = std::vector<std::string>;
using Points = std::vector<RoLo::Architecture::Data>;
using Integers = std::vector<Integer>;
using RoIS_Common::Component_Status;
using RoIS_Common::Stream_Status;
using RoIS_HRI::ResultList;

// The signature of a member function.
template <class Class, class Function, class Wanted>
constexpr bool has(Function Class::*, Wanted*) {
    return std::is_same_v<Function, Wanted>;
}
#define HAS(member, ...) static_assert(has(&member, static_cast<std::add_pointer_t<__VA_ARGS__>>(nullptr)))

// --- Types ---

static_assert(std::is_same_v<RoIS_Identifier, std::string> && std::is_same_v<RoIS_IdentifierList, Texts>);
static_assert(std::is_same_v<RoIS_HRI::Condition_t, std::string> && std::is_same_v<RoIS_HRI::HRI_Engine_Profile, std::string>);
static_assert(std::is_same_v<RoIS_HRI::CommandUnitSequence, std::string> && std::is_same_v<RoIS_HRI::DateTime, std::string>);
static_assert(std::is_same_v<Integer, long> && std::is_same_v<RoLo::Architecture::Data, std::string>);
static_assert(std::is_same_v<RoIS_HRI::ResultList, std::vector<RoIS_HRI::Result>>);
static_assert(std::is_same_v<RoIS_HRI::ParameterList, std::vector<RoIS_HRI::Parameter>>);
static_assert(std::is_same_v<RoIS_HRI::ArgumentList, std::vector<RoIS_HRI::Argument>>);
static_assert(std::is_same_v<RoIS_Service::DateTime, std::string>);
static_assert(RoIS_HRI::OK == 0 && RoIS_HRI::ERROR == 1 && RoIS_HRI::BAD_PARAMETER == 2 && RoIS_HRI::UNSUPPORTED == 3 &&
              RoIS_HRI::OUT_OF_RESOURCES == 4 && RoIS_HRI::TIMEOUT == 5);
static_assert(RoIS_Service::OK == 0 && RoIS_Service::ERROR == 1 && RoIS_Service::ABORT == 2 &&
              RoIS_Service::OUT_OF_RESOURCES == 3 && RoIS_Service::TIMEOUT == 4);
static_assert(RoIS_Service::ENGINE_INTERNAL_ERROR == 0 && RoIS_Service::COMPONENT_INTERNAL_ERROR == 1 &&
              RoIS_Service::COMPONENT_NOT_RESPONDING == 2 && RoIS_Service::USER_DEFINED_ERROR == 3);
static_assert(RoIS_Common::UNINITIALIZED == 0 && RoIS_Common::READY == 1 && RoIS_Common::BUSY == 2 && RoIS_Common::WARNING == 3 &&
              RoIS_Common::ERROR == 4);
static_assert(RoIS_Common::STREAMING_NOT_RUNNING == 0 && RoIS_Common::STREAMING_NOT_CONNECTED == 1 &&
              RoIS_Common::STREAMING_RUNNING == 2 && RoIS_Common::STREAMING_SUSPENDED == 3 &&
              RoIS_Common::STREAMING_RESUMED == 4);

// --- Interfaces ---

HAS(RoIS_HRI::SystemIF::connect, Code());
HAS(RoIS_HRI::SystemIF::disconnect, Code());
HAS(RoIS_HRI::SystemIF::get_profile, Code(Text, Text&));
HAS(RoIS_HRI::SystemIF::get_error_detail, Code(Text, Text, ResultList&));
HAS(RoIS_HRI::CommandIF::search, Code(Text, RoIS_IdentifierList&));
HAS(RoIS_HRI::CommandIF::bind, Code(RoIS_Identifier));
HAS(RoIS_HRI::CommandIF::bind_any, Code(Text, RoIS_Identifier&));
HAS(RoIS_HRI::CommandIF::release, Code(RoIS_Identifier));
HAS(RoIS_HRI::CommandIF::get_parameter, Code(RoIS_Identifier, RoIS_HRI::ParameterList&));
HAS(RoIS_HRI::CommandIF::set_parameter, Code(RoIS_Identifier, RoIS_HRI::ParameterList, Text&));
HAS(RoIS_HRI::CommandIF::execute, Code(RoIS_HRI::CommandUnitSequence));
HAS(RoIS_HRI::CommandIF::get_command_result, Code(Text, Text, ResultList&));
HAS(RoIS_HRI::QueryIF::query, Code(Text, Text, ResultList&));
HAS(RoIS_HRI::EventIF::subscribe, Code(Text, Text, Text&));
HAS(RoIS_HRI::EventIF::unsubscribe, Code(Text));
HAS(RoIS_HRI::EventIF::get_event_detail, Code(Text, Text, ResultList&));
HAS(RoIS_Service::ServiceApplicationBase::notify_error, void(Text, RoIS_Service::ErrorType));
HAS(RoIS_Service::ServiceApplicationBase::completed, void(Text, RoIS_Service::Completed_Status));
HAS(RoIS_Service::ServiceApplicationBase::notify_event, void(Text, Text, Text, RoIS_Service::DateTime));
HAS(RoIS_Common::Command::start, Code());
HAS(RoIS_Common::Command::stop, Code());
HAS(RoIS_Common::Command::suspend, Code());
HAS(RoIS_Common::Command::resume, Code());
HAS(RoIS_Common::Query::component_status, Code(Component_Status&));

// --- Components ---

HAS(System_Information::Query::robot_position, Code(Text&, RoIS_IdentifierList&, Points&));
HAS(System_Information::Query::engine_status, Code(Component_Status&, Texts&));
HAS(Person_Detection::Event::person_detected, void(Text, Integer));
HAS(Person_Localization::Command::set_parameter, Code(Integer, Integer));
HAS(Person_Localization::Query::get_parameter, Code(Integer&, Integer&));
HAS(Person_Localization::Event::person_localized, void(Text, RoIS_IdentifierList, Points));
HAS(Person_Identification::Event::person_identified, void(Text, RoIS_IdentifierList));
HAS(Face_Detection::Event::face_detected, void(Text, Integer));
HAS(Face_Localization::Command::set_parameter, Code(Integer, Integer));
HAS(Face_Localization::Query::get_parameter, Code(Integer&, Integer&));
HAS(Face_Localization::Event::face_localized, void(Text, RoIS_IdentifierList, Points));
HAS(Sound_Detection::Event::sound_detected, void(Text, Integer));
HAS(Sound_Localization::Command::set_parameter, Code(Integer, Integer));
HAS(Sound_Localization::Query::get_parameter, Code(Integer&, Integer&));
HAS(Sound_Localization::Event::sound_localized, void(Text, RoIS_IdentifierList, Points));
HAS(Speech_Recognition::Command::set_parameter, Code(Texts, Text, Text));
HAS(Speech_Recognition::Query::get_parameter, Code(Texts&, Texts&, Text&, Text&));
HAS(Speech_Recognition::Event::speech_recognized, void(Text, Texts));
HAS(Speech_Recognition::Event::speech_input_started, void(Text));
HAS(Speech_Recognition::Event::speech_input_finished, void(Text));
HAS(Gesture_Recognition::Query::get_parameter, Code(RoIS_IdentifierList&));
HAS(Gesture_Recognition::Event::gesture_recognized, void(Text, RoIS_IdentifierList));
HAS(Speech_Synthesis::Command::set_parameter, Code(Text, Text, Integer, Text, RoIS_Identifier));
HAS(Speech_Synthesis::Query::get_parameter, Code(Text&, Text&, Integer&, Text&, RoIS_Identifier&, Texts&, RoIS_IdentifierList&));
HAS(Reaction::Command::set_parameter, Code(RoIS_IdentifierList));
HAS(Reaction::Query::get_parameter, Code(RoIS_IdentifierList&, RoIS_Identifier&));
HAS(Navigation::Command::set_parameter, Code(Points, Integer, Text));
HAS(Navigation::Query::get_parameter, Code(Points&, Integer&, Text&));
HAS(Follow::Command::set_parameter, Code(RoIS_Identifier, Integer, Integer));
HAS(Follow::Query::get_parameter, Code(RoIS_Identifier&, Integer&, Integer&));
HAS(Move::Command::set_parameter, Code(Integers, Integers, Integer));
HAS(Move::Query::get_parameter, Code(Integers&, Integers&, Integer&));
HAS(Audio_Streaming::Command::set_parameter, Code(Text, Text));
HAS(Audio_Streaming::Command::connect_stream, Code(Text&));
HAS(Audio_Streaming::Command::disconnect_stream, Code(Text));
HAS(Audio_Streaming::Command::suspend_stream, Code(Text));
HAS(Audio_Streaming::Command::resume_stream, Code(Text));
HAS(Audio_Streaming::Query::get_parameter, Code(Text&, Text&));
HAS(Audio_Streaming::Query::get_stream_status, Code(Text, Stream_Status&));
HAS(Audio_Streaming::Event::notify_stream_status, void(Text, Text, Stream_Status));
HAS(Video_Streaming::Command::set_parameter, Code(Text, Text));
HAS(Video_Streaming::Command::connect_stream, Code(Text&));
HAS(Video_Streaming::Command::disconnect_stream, Code(Text));
HAS(Video_Streaming::Command::suspend_stream, Code(Text));
HAS(Video_Streaming::Command::resume_stream, Code(Text));
HAS(Video_Streaming::Query::get_parameter, Code(Text&, Text&));
HAS(Video_Streaming::Query::get_stream_status, Code(Text, Stream_Status&));
HAS(Video_Streaming::Event::notify_stream_status, void(Text, Text, Stream_Status));

// Every component has its three classes, derived from those of RoIS_Common and not abstract.
template <class Command, class Query, class Event>
constexpr bool is_component = std::is_base_of_v<RoIS_Common::Command, Command>&& std::is_base_of_v<RoIS_Common::Query, Query>&&
    std::is_base_of_v<RoIS_Common::Event, Event>&& std::is_default_constructible_v<Command>&&
        std::is_default_constructible_v<Query>&& std::is_default_constructible_v<Event>;
#define IS_COMPONENT(name) static_assert(is_component<name::Command, name::Query, name::Event>)
IS_COMPONENT(Person_Detection);
IS_COMPONENT(Person_Localization);
IS_COMPONENT(Person_Identification);
IS_COMPONENT(Face_Detection);
IS_COMPONENT(Face_Localization);
IS_COMPONENT(Sound_Detection);
IS_COMPONENT(Sound_Localization);
IS_COMPONENT(Speech_Recognition);
IS_COMPONENT(Gesture_Recognition);
IS_COMPONENT(Speech_Synthesis);
IS_COMPONENT(Reaction);
IS_COMPONENT(Navigation);
IS_COMPONENT(Follow);
IS_COMPONENT(Move);
IS_COMPONENT(Audio_Streaming);
IS_COMPONENT(Video_Streaming);

// The global names of the published RoIS_Common.hpp.
[[maybe_unused]] ::ReturnCode_t const code = ::BAD_PARAMETER;
[[maybe_unused]] ::Completed_Status const aborted = ::ABORT;

TEST(HeadersOfTheCppPsm, HaveThePublishedNamesAndSignatures) { SUCCEED() << "the compiler has checked them"; }

}  // namespace
