// Motion leases (docs/safety.md): a robot moves on while a program of the C++ PSM lives, and is held when the program hangs.
#include "alive.hpp"
#include "psm/rig.hpp"

namespace rois::test::psm {
namespace {

constexpr auto empty_hall = ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml";
constexpr auto longer = 2500ms;  // than the lease of a second, with time for a busy machine

class CppPsmAndMotion : public testing::Test {
protected:
    void SetUp() override {
        use(gateway.url());
        ASSERT_EQ(system.connect(), ok);
        ASSERT_EQ(navigation.set_parameter({"14000, 6000", "1000, 6000", "14000, 6000"}, 90'000, ""), ok);
        ASSERT_EQ(navigation.start(), ok);
    }
    void TearDown() override { system.disconnect(); }

    std::string why_held() {
        application.text_of_an_error();
        RoIS_HRI::ResultList results;
        EXPECT_EQ(system.get_error_detail(application.errors.begin()->first, "", results), ok);
        return results.empty() ? "" : results.back().value;
    }

    GatewayProcess gateway{{"--sim-speed", "1", "--motion-lease", "1", "--scenario", empty_hall}};
    RoIS_HRI::SystemIF system;
    Application application;
    ::Navigation::Command navigation;
};

TEST_F(CppPsmAndMotion, GoesOnWhileTheProgramWaitsForItsOwnFunctions) {
    std::this_thread::sleep_for(longer);
    EXPECT_THAT(application.errors, IsEmpty());
}

TEST_F(CppPsmAndMotion, IsHeldWhileAFunctionOfTheApplicationHangs) {
    struct Hanging : RoIS_Service::ServiceApplicationBase {
        ~Hanging() override { end_notifications(); }
        void completed(std::string, RoIS_Service::Completed_Status) override { std::this_thread::sleep_for(longer); }
    } hanging;
    ::Person_Detection::Command detection;
    ASSERT_EQ(detection.start(), ok);
    EXPECT_THAT(why_held(), HasSubstr("its application gave no sign of life"));
}

TEST_F(CppPsmAndMotion, GoesOnOnlyWhileTheProgramCallsAlive) {
    for (auto time = 0ms; time < longer; time += 200ms) {
        rois::psm::alive();
        std::this_thread::sleep_for(200ms);
    }
    EXPECT_THAT(application.errors, IsEmpty());
    EXPECT_THAT(why_held(), HasSubstr("its application gave no sign of life"));
}

}  // namespace
}  // namespace rois::test::psm
