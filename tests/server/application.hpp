// A service application that always checks: each answer belongs to its request (name and request_id),
// a refusal has a reason and no out parameters, and the sequence of the notifications has no gap.
#pragma once

#include "kit/application.hpp"
#include "kit/gateway_process.hpp"

namespace rois::test {

using namespace kit;

class Application : public kit::Application {
public:
    // Not connected yet.
    explicit Application(Transport transport, GatewayProcess const& gateway) : Application{transport, gateway.address()} {}
    explicit Application(Transport, Address const&);
    ~Application() override;  // disconnects

private:
    void check_answer(Document const& answer, std::string const& operation, std::string const& request_id) override;
    void check_notification(Document const&, std::uint64_t sequence) override;
};

}  // namespace rois::test
