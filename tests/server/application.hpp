// A service application that checks always, beside what the test says: each answer belongs to its request (name and request_id),
// a refusal has a reason and no out parameters, and the notifications' sequence has no gap.
#pragma once

#include "client/application.hpp"
#include "server/gateway_process.hpp"

namespace rois::test {

using namespace client;

class Application : public client::Application {
public:
    // Not connected yet.
    explicit Application(Way, GatewayProcess const&);
    ~Application() override;  // disconnects

private:
    void check_answer(Document const& answer, std::string const& operation, std::string const& request_id) override;
    void check_notification(Document const&, std::uint64_t sequence) override;
};

}  // namespace rois::test
