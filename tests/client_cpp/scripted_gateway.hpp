// A gateway that the test itself plays, step by step.
#pragma once

#include <memory>
#include <string>

namespace rois::test {

// Speaks WebSocket on a free port of the loopback. What does not come within a while, or goes wrong, throws std::runtime_error.
class ScriptedGateway {
public:
    ScriptedGateway();
    ~ScriptedGateway();
    ScriptedGateway(ScriptedGateway const&) = delete;
    ScriptedGateway& operator=(ScriptedGateway const&) = delete;

    std::string url() const;

    // The next link, in place of the one that there was, which is cut.
    void accept();
    void cut();
    // The next document that comes must be this operation; gives it whole.
    std::string hear(std::string const& operation);
    // Answers what was heard last.
    void answer(std::string const& content = {}, std::string const& return_code = "OK");
    void fault(std::string const& code);
    void event(int sequence, std::string const& subscribe_id);

private:
    class Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace rois::test
