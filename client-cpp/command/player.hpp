// Answers a session as a recording says.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "command/host.hpp"
#include "command/script.hpp"

namespace rois::command {

// `speed`: recorded seconds in a second; 0: without any pause.
class Player : public Guest {
public:
    Player(asio::io_context&, HostedSession&, std::shared_ptr<Script const>, double speed);
    ~Player() override;

    void take(std::string const& document, std::variant<Request, Fault> const& read,
              std::function<void(std::string)> reply) override;

private:
    class Stage;

    std::string answer(Request const&);
    Exchange const* matching(Operation const&);
    std::variant<Reply, Fault> answer_of(Exchange const&, Operation const&);

    std::shared_ptr<Stage> stage_;
    std::shared_ptr<Script const> script_;
    std::map<std::string, std::size_t> used_;      // how many exchanges of each key
    std::map<CommandId, CommandId> recorded_ids_;  // by what the application calls them
};

}  // namespace rois::command
