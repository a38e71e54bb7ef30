// Folders of component profiles: the check of their files, and the components made from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "files/files.hpp"
#include "kit/profile_folder.hpp"
#include "main/settings.hpp"
#include "main/user_components.hpp"
#include "simulation/adapters/robots.hpp"
#include "simulation/plan/floor_plan_file.hpp"
#include "simulation/scenario/scenario_file.hpp"
#include "xml/profiles/profile_document.hpp"

namespace rois::test {
namespace {

using kit::profile_document;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::string const includes_common =
    "<rois:SubComponentProfile>urn:x-rois:def:Component:OMG::RoISCommon</rois:SubComponentProfile>";
std::string const stand_in = "<gml:metaDataProperty xlink:href=\"urn:x-rois:def:adapter:simulation::stand_in\"/>";

std::shared_ptr<xml::Schemas const> const& schemas() {
    static xml::Platform const platform;
    static auto const all = std::make_shared<xml::Schemas const>(files::schemas());
    return all;
}

std::vector<ComponentProfile> const& built_in() {
    static auto const all = xml::read_component_profiles(schemas(), files::profiles());
    return all;
}

std::string report_on(std::string const& folder, basic::Streams streams = basic::Streams::none) {
    return report_of(read_profile_folder(schemas(), folder, built_in(), streams));
}

TEST(ProfileFolder, ReportsTheContentOfEachFile) {
    kit::ProfileFolder const folder;
    folder.put("a_good.xml", profile_document("urn:a", includes_common));
    folder.put("b_hasty.xml", profile_document("urn:b",
                                               "<rois:ParameterProfile name='p'><rois:data_type_ref rois:code='int'/>"
                                               "</rois:ParameterProfile>"));
    folder.put("c_broken.xml", profile_document("urn:c", "\n<rois:Nonsense/>"));
    folder.put("d_lost.xml", profile_document("urn:d", "<rois:SubComponentProfile>urn:nowhere</rois:SubComponentProfile>"));
    folder.put("e_twice.xml", profile_document("URN:A", ""));
    folder.put("f_lost_too.xml", profile_document("urn:f", "<rois:SubComponentProfile>urn:d</rois:SubComponentProfile>"));
    folder.put("f_round.xml", profile_document("urn:r", "\n<rois:SubComponentProfile>urn:r</rois:SubComponentProfile>"));
    folder.put("g_theirs.xml", profile_document("urn:x-rois:def:component:OMG::Move", ""));
    folder.put("h_not_xml.xml", "Dear reader,");
    folder.put("readme.txt", "not looked at");
    auto const report = report_on(folder.name());
    EXPECT_THAT(report, StartsWith("a_good.xml: ok\nwarning: b_hasty.xml:3:1: the attribute 'name' has no prefix"));
    for (auto const* line :
         {"\nrefused: c_broken.xml:4:1: unknown element 'rois:Nonsense'",
          "\nrefused: d_lost.xml:3:1: no component profile 'urn:nowhere' is known\n",
          "\nrefused: e_twice.xml:1:1: the profile 'URN:A' is in a_good.xml already\n",
          "\nrefused: f_lost_too.xml:3:1: no component profile 'urn:d' is known\n",
          "\nrefused: f_round.xml:4:1: the component profile 'urn:r' includes itself\n",
          "\nwarning: g_theirs.xml:1:1: the gateway has a profile 'urn:x-rois:def:component:OMG::Move' of its own",
          "\nrefused: h_not_xml.xml:1:1: not well-formed", "\n9 files: 1 ok, 2 with warnings, 6 refused\n"})
        EXPECT_THAT(report, HasSubstr(line));
}

TEST(ProfileFolder, WarnsOfAmbiguousNames) {
    kit::ProfileFolder const folder;
    folder.put("a.xml", profile_document("urn:a::Lamp", includes_common));
    folder.put("b.xml", profile_document("urn:b::Lamp", includes_common));
    folder.put("c.xml", profile_document("urn:c", "<rois:SubComponentProfile>Lamp</rois:SubComponentProfile>"));
    auto const report = report_on(folder.name());
    EXPECT_THAT(report, HasSubstr("warning: c.xml:3:1: 'Lamp' may mean 'urn:a::Lamp' or 'urn:b::Lamp'; the gateway uses the "
                                  "first: write the whole identifier\n"));
}

TEST(ProfileFolder, FindsNothingWrongWithTheExamples) {
    for (auto const* folder : {"/components/simulation/profiles", "/schemas/profiles"}) {
        auto const report = report_on(std::string{ROIS_SOURCE_DIR} + folder);
        EXPECT_THAT(report, Not(HasSubstr("is not known"))) << folder;
    }
}

TEST(ProfileFolder, ReportsEntriesThatAreNotFiles) {
    kit::ProfileFolder const folder;
    std::filesystem::create_symlink("/nowhere/at.all", folder.name() + "/lost.xml");
    std::filesystem::create_directory(folder.name() + "/nest.xml");
    auto const report = report_on(folder.name());
    EXPECT_EQ(report,
              "refused: lost.xml: not a regular file\nrefused: nest.xml: not a regular file\n2 files: 0 ok, 0 with warnings, 2 "
              "refused\n");
}

TEST(ProfileFolder, ResolvesANameToAnotherProfileThanItsOwn) {
    kit::ProfileFolder const folder;
    folder.put("a.xml", profile_document("urn:a::Lamp", "<rois:SubComponentProfile>Lamp</rois:SubComponentProfile>"));
    folder.put("b.xml", profile_document("urn:b::Lamp", includes_common));
    auto mine = profile_document("urn:c::Navigation", "<rois:SubComponentProfile>Navigation</rois:SubComponentProfile>");
    folder.put("c.xml", mine.insert(mine.find("<rois:Sub"), "<gml:name>my_navigation</gml:name>"));
    folder.put("d.xml", profile_document("urn:d::Own", "<rois:SubComponentProfile>Own</rois:SubComponentProfile>"));
    auto const report = report_on(folder.name());
    EXPECT_EQ(report,
              "a.xml: ok\nb.xml: ok\nc.xml: ok\nrefused: d.xml:3:1: the component profile 'urn:d::Own' includes itself\n"
              "4 files: 3 ok, 0 with warnings, 1 refused\n");
}

TEST(ProfileFolder, DistinguishesGatewaysWithAndWithoutStreams) {
    kit::ProfileFolder const folder;
    folder.put("phone.xml",
               profile_document("urn:test::Phone", includes_common,
                                "\n<gml:metaDataProperty xlink:href=\"urn:x-rois:def:adapter:simulation::audio_streaming\"/>"));
    EXPECT_THAT(report_on(folder.name(), basic::Streams::served), HasSubstr("phone.xml: ok\n"));
    EXPECT_THAT(report_on(folder.name()), HasSubstr("refused: phone.xml:2:1: unknown adapter 'audio_streaming'"));
}

TEST(ProfileFolder, ThatDoesNotExistIsABadSetting) { EXPECT_THROW(report_on("/nowhere/at.all"), BadSettings); }

// --- Components ---

struct ComponentsOfUsers : testing::Test {
    static std::shared_ptr<simulation::Simulation> hall() {
        auto const text = [](char const* file) { return std::string{files::simulation().at(file)}; };
        auto plan = simulation::read_floor_plan(schemas(), "plan", text("reception-hall.xml"));
        auto day = simulation::read_scenario(schemas(), "scenario", text("reception-day.xml"), plan, {});
        return std::make_shared<simulation::Simulation>(std::move(plan), std::move(day), 1, 1.0);
    }
    static std::string lamp(std::string const& urn) { return profile_document(urn, includes_common, stand_in); }

    // Reads the folder. Returns the refs of new components.
    std::vector<std::string> added() {
        auto const change = components.read();
        gone = change.going;
        components.keep();
        std::vector<std::string> refs;
        for (auto const& component : change.coming) refs.push_back(component->description().ref.code);
        return refs;
    }

    kit::ProfileFolder folder;
    UserComponents components{
        schemas(), {simulation::robots(hall(), nullptr), schemas()}, built_in(), {"navigation"}, folder.name()};
    std::vector<std::string> gone;
};

TEST_F(ComponentsOfUsers, FollowTheirFiles) {
    folder.put("a.xml", lamp("urn:test::Lamp"));
    EXPECT_THAT(added(), ElementsAre("lamp"));
    EXPECT_THAT(added(), IsEmpty()) << "unchanged files keep their components";
    EXPECT_THAT(gone, IsEmpty());
    folder.put("b.xml", lamp("urn:test::Fan"));
    folder.remove("a.xml");
    EXPECT_THAT(added(), ElementsAre("fan"));
    EXPECT_THAT(gone, ElementsAre("lamp"));
}

TEST_F(ComponentsOfUsers, DoNotChangeIfAFileIsRefused) {
    folder.put("a.xml", lamp("urn:test::Lamp"));
    added();
    folder.put("a.xml", "Dear reader,");
    EXPECT_THROW(components.read(), BadSettings);
    folder.put("a.xml", lamp("urn:test::Lamp"));
    EXPECT_THAT(added(), IsEmpty()) << "it is the same lamp";
    EXPECT_THAT(gone, IsEmpty());
}

TEST_F(ComponentsOfUsers, ChangeBesideAFileThatWasRefusedBefore) {
    folder.put("a.xml", "Dear reader,");
    added();
    folder.put("b.xml", lamp("urn:test::Lamp"));
    EXPECT_EQ(added().size(), 1U);
    folder.put("a.xml", "Dear reader, goodbye");
    EXPECT_NO_THROW(components.read()) << "for the same reason";
    folder.put("a.xml", "<and");
    EXPECT_THROW(components.read(), BadSettings);
}

TEST_F(ComponentsOfUsers, AreReadAgainUntilTheChangeIsKept) {
    folder.put("a.xml", lamp("urn:test::Lamp"));
    EXPECT_EQ(components.read().coming.size(), 1U);
    EXPECT_EQ(components.read().coming.size(), 1U) << "the first change was not kept";
}

TEST_F(ComponentsOfUsers, DoNotTakeTheNamesOfOthers) {
    folder.put("a.xml", lamp("urn:test::Navigation"));
    EXPECT_THAT(added(), IsEmpty());
}

}  // namespace
}  // namespace rois::test
