// Answers the requests of a session from a recording.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "command/recording/host.hpp"
#include "command/recording/script.hpp"

namespace rois::command {

// `speed`: 2 plays twice as fast; 0: no pauses.
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
    std::map<std::string, std::size_t> used_;      // number of exchanges used so far, by key
    std::map<CommandId, CommandId> recorded_ids_;  // by the application's ids
};

}  // namespace rois::command
