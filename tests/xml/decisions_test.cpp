// Decisions 27 and 29, as far as they concern documents.
#include <gmock/gmock.h>

#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Decision27, LocatedDataHaveATextAndAStructure) {
    Located where{"position_data", "person-1", "urn:x-rois:def:crs:simulation::hall", {9500, 6000.5, 0}, {0, 0, 90}, {}};
    where.certainty = Located::Covariance{{2500, 0, 0, 0, 2500, 0, 0, 0, 64}};
    GetEventDetail::Reply reply;
    reply.results = {{positions("position_data", {"9500, 6000.5, 90"}, where.crs)}, {where}};
    auto const written = encode(Reply{reply}, "");
    EXPECT_EQ(problem("answer.xml", written), "");
    EXPECT_THAT(
        written,
        HasSubstr("rois:codebook_ref=\"urn:x-rois:def:crs:simulation::hall\"/><rois:value>9500, 6000.5, 90</rois:value>"));
    EXPECT_THAT(written, HasSubstr("<located of=\"position_data\" ref=\"person-1\" crs=\"urn:x-rois:def:crs:simulation::hall\">"
                                   "<position>9500 6000.5 0</position><orientation>0 0 90</orientation>"
                                   "<covariance>2500 0 0 0 2500 0 0 0 64</covariance></located>"));
}

TEST(Decision29, NamesOfOtherVersionsAreRead) {
    auto const read = read_profile_document(
        schemas(), "p.xml",
        "<rois:HRIComponentProfile xmlns:rois='http://www.omg.org/spec/RoIS/20151201' xmlns:gml='http://www.opengis.net/gml/3.2' "
        "xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' gml:id='p'><gml:identifier>urn:x-rois:def:HRIComponent:ATR::Lamp"
        "</gml:identifier><rois:MessageProfile xsi:type='rois:CommaneMessageProfileType' rois:name='start'/>"
        "<rois:ParameterProfile rois:name='volume'><rois:data_type_ref rois:code='urn:x-rois:def:DataType:ATR::Integer'/>"
        "</rois:ParameterProfile></rois:HRIComponentProfile>");
    auto const profile = std::get<ComponentProfile>(read.profile);
    EXPECT_EQ(profile.messages.at(0).kind, MessageKind::command);
    auto const written = encode(profile, "profile.lamp");
    EXPECT_EQ(problem("again.xml", written), "");
    EXPECT_THAT(written, HasSubstr("http://www.omg.org/spec/RoIS/20240801")) << "the current namespace";
    EXPECT_THAT(written, HasSubstr("\"rois:CommandMessageProfileType\""));
}

// The names of the parts of profiles in the tables of 2011.
TEST(Decision29, NamesOf2011AreRead) {
    std::string const declared =
        " xmlns:rois='http://www.omg.org/spec/RoIS/20240801' xmlns:gml='http://www.opengis.net/gml/3.2' "
        "xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' gml:id='p'><gml:identifier "
        "codeSpace='c'>urn:x:lamp</gml:identifier>";
    auto const type = std::string{"<rois:data_type_ref rois:code='int'/>"};
    auto const read = read_profile_document(
        schemas(), "p.xml",
        "<rois:HRI_Component_Profile" + declared +
            "<rois:sub_component>urn:x:base</rois:sub_component>"
            "<rois:message xsi:type='rois:Command_Message_ProfileType' rois:name='shine'><rois:results rois:name='lumen'>" +
            type + "</rois:results><rois:argument rois:name='colour'>" + type +
            "</rois:argument></rois:message><rois:Event_Message_Profile rois:name='faded'/>"
            "<rois:parameter rois:name='volume'>" +
            type + "</rois:parameter><rois:Parameter_Profile rois:name='pitch'>" + type +
            "</rois:Parameter_Profile></rois:HRI_Component_Profile>");
    auto const profile = std::get<ComponentProfile>(read.profile);
    EXPECT_EQ(profile.sub_components, std::vector<std::string>{"urn:x:base"});
    ASSERT_EQ(profile.messages.size(), 2U);
    EXPECT_EQ(profile.messages[0].kind, MessageKind::command);
    EXPECT_EQ(profile.messages[0].results.at(0).name, "lumen");
    EXPECT_EQ(profile.messages[0].arguments.at(0).name, "colour");
    EXPECT_EQ(profile.messages[1].kind, MessageKind::event);
    EXPECT_EQ(profile.parameters.size(), 2U);
    EXPECT_THAT(read.warnings,
                Contains("p.xml:1:1: 'rois:HRI_Component_Profile' is a name of 2011: read as 'HRIComponentProfile'"));
    EXPECT_THAT(read.warnings, Contains(HasSubstr("'rois:argument' is a name of 2011: read as 'Arguments'")));

    auto const engine = read_profile_document(schemas(), "p.xml",
                                              "<rois:HRI_Engine_Profile" + declared +
                                                  "<rois:component>lamp</rois:component><rois:component>door</rois:component>"
                                                  "</rois:HRI_Engine_Profile>");
    EXPECT_EQ(std::get<EngineProfile>(engine.profile).components, (std::vector<std::string>{"lamp", "door"}));
}

TEST(Decision29, NotificationsHaveTheNamesOf2011) {
    auto const written = [](Notification const& notification) {
        return std::string{notification_head(notification)} + "1" + notification_tail(notification);
    };
    EXPECT_THAT(written(ReceiveEvent{{"e-1"}, "seen", {"s-1"}, {}, {"lamp", {}, {}, {}}, {}}), StartsWith("<receive_event "));
    EXPECT_THAT(written(ReceiveError{{"x-1"}, ErrorType::user_defined_error, {}}), StartsWith("<receive_error "));
    EXPECT_THAT(written(Completed{{"c-1"}, CompletedStatus::ok}), StartsWith("<completed "));
}

}  // namespace
}  // namespace rois::xml
