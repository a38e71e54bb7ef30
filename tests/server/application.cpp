#include "server/application.hpp"

#include <gtest/gtest.h>

#include "kit/line.hpp"

namespace rois::test {

Application::Application(Transport transport, Address const& address) : kit::Application{connection_over(address, transport)} {}

Application::~Application() {
    try {
        disconnect_if_connected();
    } catch (LineEnded const& ended) {
        ADD_FAILURE() << "at disconnect: " << ended.what();
    }
}

void Application::check_answer(Document const& answer, std::string const& operation, std::string const& request_id) {
    EXPECT_EQ(answer.attribute("request_id"), request_id) << answer.whole();
    if (!answer.fault().empty()) return;
    EXPECT_EQ(answer.name(), operation + "_response");
    if (answer.return_code() == "OK") return;
    EXPECT_EQ(answer.children(), std::vector<std::string>{"reason"}) << answer.whole();
    EXPECT_NE(answer.reason(), "");
}

void Application::check_notification(Document const& notification, std::uint64_t sequence) {
    EXPECT_EQ(notification.attribute("sequence"), std::to_string(sequence)) << notification.whole();
}

}  // namespace rois::test
