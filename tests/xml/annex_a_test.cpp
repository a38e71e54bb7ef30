// The examples of Annex A, with their identifiers, codes and misprints. The element structure is that of the published trees; the
// texts around it are our own.
#include <gmock/gmock.h>

#include "types/data_type.hpp"
#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string data_type(std::string const& name) {
    return "<rois:data_type_ref rois:code='urn:x-rois:def:DataType:ATR::" + name + "'/>";
}

std::string results(std::string const& name, std::string const& type) {
    return "<rois:Results rois:name='" + name + "'>" + data_type(type) + "</rois:Results>";
}

std::string message(std::string const& type, std::string const& name, std::string const& inside = "") {
    return "<rois:MessageProfile xsi:type='rois:" + type + "' rois:name='" + name + "'>" + inside + "</rois:MessageProfile>";
}

std::string const max_number =
    "<rois:ParameterProfile rois:description='how many at most' rois:default_value='10' rois:name='max_number'>" +
    data_type("Integer") + "</rois:ParameterProfile>";
std::string const person_detected =
    message("EventMessageProfileType", "person_detected", results("timestamp", "DateTime") + results("number", "Integer"));

// As published, the identifier has no code space.
std::string whole(std::string const& root, std::string const& identifier, std::string const& inside) {
    return "<rois:" + root +
           " xmlns:rois='http://www.omg.org/spec/RoIS/20151201' xmlns:gml='http://www.opengis.net/gml/3.2' "
           "xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' gml:id='a'><gml:identifier>" +
           identifier + "</gml:identifier>" + inside + "</rois:" + root + ">";
}

ProfileDocument component(std::string const& inside) {
    return read_profile_document(schemas(), "a.xml",
                                 whole("HRIComponentProfile", "urn:x-rois:def:HRIComponent:ATR::PersonDetection",
                                       "<gml:name>PersonDetection</gml:name>" + inside));
}

ComponentProfile profile(std::string const& inside) { return std::get<ComponentProfile>(component(inside).profile); }

TEST(AnnexA, AParameterProfileHasNameTypeAndDefault) {
    auto const parameter = profile(max_number).parameters.at(0);
    EXPECT_EQ(parameter.name, "max_number");
    EXPECT_EQ(parameter.default_value, "10");
    EXPECT_EQ(parameter.description, "how many at most");
    EXPECT_EQ(to_text(DataType::of(parameter.data_type_ref)), "int");
}

TEST(AnnexA, ACommandMessageProfileHasArguments) {
    auto const inside =
        "<rois:Arguments rois:description='words a minute' rois:name='speed'>" + data_type("Integer") + "</rois:Arguments>";
    auto const read = profile(message("CommandMessageProfileType", "change_speech_speed", inside)).messages.at(0);
    EXPECT_EQ(read.kind, MessageKind::command);
    EXPECT_EQ(read.name, "change_speech_speed");
    EXPECT_EQ(read.arguments.at(0).name, "speed");
}

TEST(AnnexA, AnEventMessageProfileHasResults) {
    auto const read = profile(person_detected).messages.at(0);
    EXPECT_EQ(read.kind, MessageKind::event);
    ASSERT_THAT(read.results, SizeIs(2));
    EXPECT_EQ(to_text(DataType::of(read.results[0].data_type_ref)), "DateTime");
    EXPECT_EQ(to_text(DataType::of(read.results[1].data_type_ref)), "int");
}

TEST(AnnexA, AQueryMessageProfileHasResults) {
    auto const read = profile(message("QueryMessageProfileType", "engine_status",
                                      results("status", "Component_Status") + results("operable_time", "DateTime")))
                          .messages.at(0);
    EXPECT_EQ(read.kind, MessageKind::query);
    EXPECT_EQ(to_text(DataType::of(read.results.at(0).data_type_ref)), "Component_Status");
}

// The published types of its commands are misspelt.
TEST(AnnexA, AComponentProfileHasMessagesAndParameters) {
    std::string inside;
    for (auto const* name : {"start", "stop", "suspend", "resume"}) inside += message("CommaneMessageProfileType", name);
    inside += message("QueryMessageProfileType", "component_status", results("status", "Component_Status"));
    auto const document = component(inside + person_detected + max_number);
    auto const& read = std::get<ComponentProfile>(document.profile);
    EXPECT_EQ(read.object.identifier, "urn:x-rois:def:HRIComponent:ATR::PersonDetection");
    EXPECT_EQ(read.object.name, "PersonDetection");
    ASSERT_THAT(read.messages, SizeIs(6));
    EXPECT_EQ(read.messages[0].kind, MessageKind::command);
    EXPECT_THAT(read.parameters, SizeIs(1));
    EXPECT_THAT(document.warnings, SizeIs(5)) << "the code space and four types";
}

TEST(AnnexA, AnExtendedComponentProfileIncludesAnother) {
    auto const detection = profile(person_detected + max_number);
    auto const monitor = std::get<ComponentProfile>(
        read_profile_document(schemas(), "b.xml",
                              whole("HRIComponentProfile", "urn:x-rois:def:HRIComponent:ATR::PersonMonitor",
                                    "<rois:SubComponentProfile>urn:x-rois:def:HRIComponent:ATR::PersonDetection"
                                    "</rois:SubComponentProfile>" +
                                        message("EventMessageProfileType", "person_disappeared")))
            .profile);
    auto const all = flattened(monitor, std::vector{detection});
    ASSERT_THAT(all.messages, SizeIs(2));
    EXPECT_EQ(all.messages[0].name, "person_disappeared");
    EXPECT_EQ(all.messages[1].name, "person_detected");
    EXPECT_EQ(all.parameters.at(0).name, "max_number");
}

TEST(AnnexA, AnEngineProfileListsItsComponents) {
    auto const read =
        read_profile_document(schemas(), "e.xml",
                              whole("HRIEngineProfile", "urn:x-rois:def:HRIEngine:ATR::MainHRI",
                                    "<gml:name>MainHRI</gml:name><rois:HRIComponent>urn:x-rois:def:HRIComponent:ATR::"
                                    "PersonDetection</rois:HRIComponent>"));
    auto const& engine = std::get<EngineProfile>(read.profile);
    EXPECT_EQ(engine.object.identifier, "urn:x-rois:def:HRIEngine:ATR::MainHRI");
    EXPECT_THAT(engine.components, ElementsAre("urn:x-rois:def:HRIComponent:ATR::PersonDetection"));
}

// Both robots have a component with the same id, and the main engine has none. The published schema rejects both.
TEST(AnnexA, AnEngineProfileOfTwoRobotsHasSubProfiles) {
    std::string robots;
    for (auto const* robot : {"Robot1", "Robot2"})
        robots += std::string{"<rois:SubProfile gml:id='"} + robot + "'><gml:identifier>urn:x-rois:def:HRIEngine:ATR::" + robot +
                  "</gml:identifier><rois:HRIComponent>urn:x-rois:def:HRIComponent:ATR::PersonDetection</rois:HRIComponent>"
                  "</rois:SubProfile>";
    auto const read =
        read_profile_document(schemas(), "e.xml", whole("HRIEngineProfile", "urn:x-rois:def:HRIEngine:ATR::MainHRI", robots));
    auto const& engine = std::get<EngineProfile>(read.profile);
    EXPECT_THAT(engine.components, IsEmpty());
    ASSERT_THAT(engine.sub_profiles, SizeIs(2));
    EXPECT_EQ(engine.sub_profiles[0].components, engine.sub_profiles[1].components);
    EXPECT_THAT(read.warnings, testing::Contains(HasSubstr("codeSpace")));
}

}  // namespace
}  // namespace rois::xml
