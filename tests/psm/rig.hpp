// Tools for the tests of the C++ PSM: an application that records notifications, and a session.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <vector>

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
#include "RoIS_Sound_Localization.hpp"
#include "RoIS_Speech_Recognition.hpp"
#include "RoIS_Speech_Synthesis.hpp"
#include "RoIS_System_Information.hpp"
#include "RoIS_Video_Streaming.hpp"
#include "kit/gateway_process.hpp"
#include "reason.hpp"
#include "rois/blocking.hpp"

namespace rois::test::psm {

using namespace std::chrono_literals;
using kit::GatewayProcess;
using kit::shared_gateway;
using rois::Blocking;
using rois::psm::reason;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

using RoIS_HRI::BAD_PARAMETER;
using RoIS_HRI::UNSUPPORTED;
constexpr auto ok = RoIS_HRI::OK;
constexpr auto error = RoIS_HRI::ERROR;
using Result = RoIS_HRI::Result;

// Waits for what other threads report.
class Bell {
public:
    template <class Function>
    void ring(Function change) {
        std::lock_guard const lock{mutex_};
        change();
        news_.notify_all();
    }
    template <class Predicate>
    bool await(Predicate reached) {
        std::unique_lock lock{mutex_};
        return news_.wait_for(lock, 20s, reached);
    }

private:
    std::mutex mutex_;
    std::condition_variable news_;
};

// An application that records its notifications.
class Application : public RoIS_Service::ServiceApplicationBase {
public:
    ~Application() override { end_notifications(); }

    void notify_error(std::string id, RoIS_Service::ErrorType type) override {
        bell.ring([&] { errors.emplace(id, type); });
    }
    void completed(std::string id, RoIS_Service::Completed_Status status) override {
        bell.ring([&] { ended.emplace(id, status); });
    }
    void notify_event(std::string id, std::string type, std::string subscribe_id, std::string expire) override {
        RoIS_HRI::ResultList details;  // asked for on the notification thread
        auto const code = RoIS_HRI::EventIF{}.get_event_detail(id, "", details);
        bell.ring([&] { events.push_back({type, subscribe_id, expire, code, details}); });
    }

    RoIS_Service::Completed_Status status_of(std::string const& command) {
        EXPECT_TRUE(bell.await([&] { return ended.contains(command); })) << command << " has not completed";
        return ended[command];
    }
    std::string text_of_an_error() {
        EXPECT_TRUE(bell.await([&] { return !errors.empty(); }));
        RoIS_HRI::ResultList results;
        EXPECT_EQ(RoIS_HRI::SystemIF{}.get_error_detail(errors.begin()->first, "", results), ok);
        return results.empty() ? "" : results.front().value;
    }

    struct ReceivedEvent {
        std::string type;
        std::string subscribe_id;
        std::string expire;
        RoIS_HRI::ReturnCode_t code;
        RoIS_HRI::ResultList details;
    };
    Bell bell;
    std::map<std::string, RoIS_Service::ErrorType> errors;
    std::map<std::string, RoIS_Service::Completed_Status> ended;
    std::vector<ReceivedEvent> events;
};

inline void use(std::string const& url) { setenv("ROIS_URL", url.c_str(), 1); }

class CppPsm : public testing::Test {
protected:
    void SetUp() override { use(shared_gateway().url()); }
    void TearDown() override { system.disconnect(); }

    RoIS_HRI::SystemIF system;
    RoIS_HRI::CommandIF command;
    RoIS_HRI::QueryIF query;
    RoIS_HRI::EventIF event;
    Application application;
    RoIS_HRI::ResultList results;
    std::string id = "as it was";
};

}  // namespace rois::test::psm
