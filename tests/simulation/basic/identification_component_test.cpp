#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

Role at_the_robot(std::string id) {
    return visitor(std::move(id), {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Wait{1000})});
}

TEST(Identification, ReportsThePermanentIdOfAKnownVisitorOnce) {
    Stage stage{{known(at_the_robot("tanaka"))}};
    stage["person_identification"].start();
    stage.run(30);
    auto const events = stage["person_identification"].events("person_identified");
    ASSERT_THAT(events, SizeIs(1));
    EXPECT_THAT(values(events[0].results, "person_ref"), ElementsAre("tanaka"));
    EXPECT_EQ(codebook_of(events[0].results, "person_ref"), "urn:x-rois:def:codebook:simulation::visitor");
    EXPECT_NE(value(events[0].results, "timestamp"), "none");
}

TEST(Identification, ReportsThePositionOfTheVisitor) {
    Stage stage{{known(at_the_robot("tanaka"))}};
    stage.run(15);
    stage["person_identification"].start();
    stage["person_localization"].start();
    stage.step();
    auto const identified = stage["person_identification"].events("person_identified");
    auto const localized = stage["person_localization"].events("person_localized");
    ASSERT_THAT(identified, SizeIs(1));
    ASSERT_THAT(localized, SizeIs(1));
    ASSERT_THAT(identified[0].results.located, SizeIs(1));
    auto const& entity = identified[0].results.located[0];
    EXPECT_EQ(entity.of, "person_ref");
    EXPECT_EQ(entity.ref, "tanaka");
    EXPECT_EQ(entity.position, localized[0].results.located.at(0).position);
    EXPECT_EQ(entity.certainty, localized[0].results.located.at(0).certainty);
}

TEST(Identification, IgnoresStrangersAndDistantVisitors) {
    Stage stage{
        {at_the_robot("stranger"), known(visitor("suzuki", {does(Walk{at(9, 4)}), does(Face{at("robot")}), does(Wait{1000})}))}};
    stage["person_identification"].start();
    stage.run(20);
    EXPECT_THAT(stage["person_identification"].events("person_identified"), IsEmpty());
}

TEST(Identification, ReportsAReturningVisitorAgain) {
    auto const visit = [](Seconds enters) {
        return known(visitor("tanaka", {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Wait{3}), does(Leave{})}, enters));
    };
    Stage stage{{visit(0), visit(40)}};
    stage["person_identification"].start();
    stage.run(80);
    EXPECT_THAT(stage["person_identification"].events("person_identified"), SizeIs(2));
}

TEST(Identification, ReportsAfterResumeAnArrivalDuringSuspension) {
    Stage stage{{known(at_the_robot("tanaka"))}};
    auto& identification = stage["person_identification"];
    identification.start();
    identification.suspend();
    stage.run(20);
    EXPECT_THAT(identification.events("person_identified"), IsEmpty());
    identification.resume();
    stage.step();
    EXPECT_THAT(identification.events("person_identified"), SizeIs(1));
}

}  // namespace
}  // namespace rois::simulation::stage
