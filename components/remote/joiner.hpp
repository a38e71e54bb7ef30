// Makes this engine a sub engine of another one that cannot connect to it: opens a WebSocket there, joins, and passes the
// documents on to this engine's own gateway, and its answers back.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/loop.hpp"
#include "links/link.hpp"
#include "remote/sub_engine.hpp"
#include "types/instant.hpp"

namespace rois::remote {

// Used on the thread of the links.
class Joiner : public std::enable_shared_from_this<Joiner> {
public:
    // `instance`: of this engine. `report` receives lines for the log.
    Joiner(client::Loop&, Joining, std::string instance, std::function<void(std::string const&)> report);

    void begin() { attempt(); }
    void end();
    // An exception, for example because memory is missing, may have interrupted this object: joins again.
    void recover() { give_up("an exception on the thread of the links"); }

private:
    class Side;
    class MainEngineLink;
    class OwnGatewayLink;

    void attempt();
    void give_up(std::string const& reason);
    void note(std::string const& what);

    client::Loop& loop_;
    Joining joining_;
    std::string instance_;
    std::function<void(std::string const&)> report_;
    Settings settings_;
    std::shared_ptr<Side> own_gateway_;  // null between attempts
    std::shared_ptr<Side> main_engine_;  // null until the own gateway is connected
    std::string last_note_;
    std::uint64_t era_ = 0;  // counts attempts and lost links
    unsigned failures_ = 0;  // short links and failed attempts in a row, since a session could be resumed
    Steady joined_at_{};
    std::chrono::milliseconds window_{0};  // within which the main engine may resume its session after a loss
    Steady may_resume_until_{};
    bool has_joined_ = false;
    bool is_over_ = false;
};

}  // namespace rois::remote
