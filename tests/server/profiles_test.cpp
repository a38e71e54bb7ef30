// Profiles that users bring: checked, made components of, and re-read while the gateway runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/gateway_process.hpp"
#include "server/profile_folder.hpp"

namespace rois::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string const includes_common =
    "<rois:SubComponentProfile>urn:x-rois:def:Component:OMG::RoISCommon</rois:SubComponentProfile>";

TEST(CheckProfiles, SaysOfEachFileWhatIsInIt) {
    ProfileFolder const folder;
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
    auto const ended = run_gateway({"--check-profiles", folder.name()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(ended.error, "");
    EXPECT_THAT(ended.out, StartsWith("a_good.xml: ok\nwarning: b_hasty.xml:3:1: the attribute 'name' has no prefix"));
    for (auto const* line :
         {"\nrefused: c_broken.xml:4:1: unknown element 'rois:Nonsense'",
          "\nrefused: d_lost.xml:3:1: no component profile 'urn:nowhere' is known\n",
          "\nrefused: e_twice.xml:1:1: the profile 'URN:A' is in a_good.xml already\n",
          "\nrefused: f_lost_too.xml:3:1: no component profile 'urn:d' is known\n",
          "\nrefused: f_round.xml:4:1: the component profile 'urn:r' includes itself\n",
          "\nwarning: g_theirs.xml:1:1: the gateway has a profile 'urn:x-rois:def:component:OMG::Move' of its own",
          "\nrefused: h_not_xml.xml:1:1: not well-formed", "\n9 files: 1 ok, 2 with warnings, 6 refused\n"})
        EXPECT_THAT(ended.out, HasSubstr(line));
}

TEST(CheckProfiles, IsContentWithWarnings) {
    ProfileFolder const folder;
    EXPECT_EQ(run_gateway({"--check-profiles", folder.name()}).out, "0 files: 0 ok, 0 with warnings, 0 refused\n");
    folder.put("b.xml", profile_document("urn:b", "<rois:SubComponentProfile>urn:a</rois:SubComponentProfile>"));
    folder.put("z.xml", profile_document("urn:a",
                                         "<rois:ParameterProfile name='p'><rois:data_type_ref rois:code='int'/>"
                                         "</rois:ParameterProfile>"));
    auto const ended = run_gateway({"--check-profiles", folder.name()});
    EXPECT_EQ(ended.exit_code, 0) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("2 files: 1 ok, 1 with warnings, 0 refused\n"));
}

TEST(CheckProfiles, WithoutAFolderIsBadUse) {
    auto const ended = run_gateway({"--check-profiles", "/nowhere/at.all"});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.error, AllOf(StartsWith("rois-gateway: /nowhere/at.all: cannot be read: "), HasSubstr("No such file")));
    EXPECT_EQ(run_gateway({"--check-profiles"}).exit_code, 2);
}

}  // namespace
}  // namespace rois::test
