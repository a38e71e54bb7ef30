// A gateway that a test controls step by step.
#pragma once

#include <memory>
#include <string>

namespace rois::test {

// Speaks WebSocket on a free port of the loopback. The functions throw std::runtime_error after 20 s, or if they fail.
class ScriptedGateway {
public:
    ScriptedGateway();
    ~ScriptedGateway();
    ScriptedGateway(ScriptedGateway const&) = delete;
    ScriptedGateway& operator=(ScriptedGateway const&) = delete;

    std::string url() const;

    // Cuts the present link and waits for the next one.
    void accept();
    void cut();
    // Waits for the next document, which must be this operation. Returns the document.
    std::string receive(std::string const& operation);
    // Answers the document that was received last.
    void answer(std::string const& content = {}, std::string const& return_code = "OK");
    void fault(std::string const& code);
    void event(int sequence, std::string const& subscribe_id);
    void switched(int sequence);  // navigation, from robot1 to robot2

private:
    class Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace rois::test
