// Identifiers and their codebooks (decision 31), and conditions on details (decision 19).
#include "server/conversation.hpp"

namespace rois::test {
namespace {

std::string const reactions = "urn:x-rois:def:codebook:simulation::reaction";

Xml identifier(std::string const& name, std::string const& code, std::string const& codebook) {
    Attributes type{{"rois:code", "RoISIdentifier"}};
    if (!codebook.empty()) type.emplace_back("rois:codebook_ref", codebook);
    return element("parameter", {{"rois:name", name}}, element("rois:data_type_ref", type) + text_element("rois:value", code));
}

struct Decision31 : testing::TestWithParam<Transport> {
    Decision31() {
        desk.connect();
        for (auto const* ref : {"reaction", "follow"}) desk.bind(ref);
    }

    Document set(std::string const& ref, Xml const& parameter, std::string const& codebook_of_ref = "") {
        Attributes component{{"rois:code", ref}};
        if (!codebook_of_ref.empty()) component.emplace_back("rois:codebook_ref", codebook_of_ref);
        return desk.ask("set_parameter", element("component_ref", component) + element("parameters", parameter));
    }

    Application desk{GetParam(), shared_gateway()};
};
ROIS_OVER_BOTH_WAYS(Decision31);

TEST_P(Decision31, IdentifiersAreOfAKnownCodebook) {
    EXPECT_THAT(set("reaction", identifier("reaction_ref", "9", "")), IsOk());
    auto const reply = desk.ask("get_parameter", element("component_ref", {{"rois:code", "reaction"}}));
    EXPECT_EQ(reply.root()
                  .select_node("parameters/parameter[@rois:name='reaction_ref']/rois:data_type_ref")
                  .node()
                  .attribute("rois:codebook_ref")
                  .value(),
              reactions)
        << "the default goes with the code";
    EXPECT_THAT(set("reaction", identifier("reaction_ref", "9", reactions)), IsOk());
    EXPECT_THAT(set("reaction", identifier("reaction_ref", "9", "urn:x-test:dances")),
                IsRefused("BAD_PARAMETER",
                          "parameter 'reaction_ref': '9' is from the codebook 'urn:x-test:dances', which is unknown "
                          "here; expected one of " +
                              reactions));
    EXPECT_THAT(set("follow", identifier("target_object_ref", "tanaka", "urn:x-test:staff")),
                IsRefused("BAD_PARAMETER", "urn:x-rois:def:codebook:simulation::track"));
    EXPECT_THAT(set("follow", identifier("target_object_ref", "tanaka", "urn:x-rois:def:codebook:simulation::visitor")), IsOk());
    EXPECT_THAT(set("reaction", identifier("reaction_ref", "9", ""), "urn:x-rois:def:component:OMG::Follow"),
                IsRefused("BAD_PARAMETER", "expected one of urn:x-rois:def:component:OMG::Reaction"));
    EXPECT_THAT(set("reaction", identifier("reaction_ref", "9", ""), "urn:x-rois:def:component:OMG::Reaction"), IsOk());
}

}  // namespace
}  // namespace rois::test
