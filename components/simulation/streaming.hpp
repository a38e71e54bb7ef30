// What the two streaming components have in common (RoIS 2.0): streams that are connected, held and closed, and whose media pass
// beside RoIS messages.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "media/media.hpp"
#include "simulation/media_offers.hpp"
#include "simulation/robot_component.hpp"

namespace rois::simulation {

// Has no action of its own: it is active as long as a stream is connected.
class Streaming : public RobotComponent {
public:
    using RobotComponent::RobotComponent;

    void start(CommandHandle, ParameterList const&, Instant now) final;
    Halted halt(Instant now) final;
    void suspend(Instant now) final;
    void resume(Instant now) final;
    void parameters_changed(ParameterList const& parameters, Instant) final { parameters_ = parameters; }
    void perform(CommandHandle, std::string_view command_type, ParameterList const& arguments, Instant now) final;
    ParameterList readable_parameters() const final;
    std::vector<Results> query(std::string_view query_type, Instant now) final;

protected:
    // What an encoding and a transport agree on.
    struct Opening {
        std::string encoding;  // with all its fields
        std::function<std::unique_ptr<media::Outlet>(media::Flow)> open;
    };

    // Their names, the first of them when nothing is asked for.
    virtual std::vector<std::string_view> encodings() const = 0;
    virtual std::vector<std::string_view> transports() const = 0;

    // Why nothing can be sent to the target of a transport, whatever it is.
    virtual std::optional<std::string> unreachable(MediaOffer const&) const { return {}; }

    // Or why there is none. Both names are known ones, and the transport can be reached.
    virtual std::variant<Opening, std::string> opening(MediaOffer const& encoding, MediaOffer const& transport) const = 0;

    // Once a step of the world, while a stream is connected.
    virtual void look(Instant) {}

private:
    struct Stream {
        std::string id;
        std::unique_ptr<media::Outlet> outlet;
        StreamStatus status = StreamStatus::not_running;
        bool received = false;
        bool held_with_all = false;  // by `suspend`
    };

    void stepped(Instant when) final;
    void time_passed(Instant now) final;
    std::optional<std::string> unfit(ParameterList const&) const final;
    std::optional<std::string> impossible(std::string_view command_type, ParameterList const& arguments) const final;

    std::variant<Opening, std::string> negotiated(ParameterList const&) const;
    void connect(CommandHandle, Instant now);
    void disconnect(Stream&, Instant now);
    void hold(Stream&, Instant now);
    void go_on(Stream&, Instant now);
    void receptions(Stream&, Instant now);
    Stream* find(std::string_view id);
    void turn(Stream&, StreamStatus, Instant now);

    ParameterList parameters_;
    std::vector<Stream> streams_;     // connected, in the order of connecting
    std::deque<std::string> closed_;  // ids, the last one closed first
    unsigned last_ = 0;
    bool held_ = false;  // by `suspend`, which holds what is connected meanwhile, too
};

}  // namespace rois::simulation
