// Base of the two streaming components (RoIS 2.0): connects, suspends and closes streams. Sound and pictures are not sent in RoIS
// messages.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "basic/base/robot_component.hpp"
#include "basic/streaming/media_offers.hpp"
#include "media/media.hpp"

namespace rois::basic {

// Active while a stream is connected; `start` only sets parameters.
class Streaming : public RobotComponent {
public:
    using RobotComponent::RobotComponent;

    Halted halt(Instant now) final;
    void suspend(Instant now) final;
    void resume(Instant now) final;
    void parameters_changed(ParameterList const& parameters, Instant) final { parameters_ = parameters; }
    ParameterList readable_parameters() const final;
    std::vector<Results> query(std::string_view query_type, Instant now) final;

protected:
    // The result of a negotiation.
    struct Opening {
        std::string encoding;  // with all its fields
        std::function<std::unique_ptr<media::Outlet>(media::Flow)> open;
    };

    // The supported names; the first is the default.
    virtual std::vector<std::string_view> encodings() const = 0;
    virtual std::vector<std::string_view> transports() const = 0;

    // Returns why the target of a transport is rejected for all encodings, or nothing.
    virtual std::optional<std::string> unreachable(MediaOffer const&) const { return {}; }

    // Returns the stream's opening, or why the pair is unsupported. The caller has checked that both names are supported and that
    // the transport's target is valid.
    virtual std::variant<Opening, std::string> opening(MediaOffer const& encoding, MediaOffer const& transport) const = 0;

    // Called after each step while a stream is connected.
    virtual void look(Instant) {}

private:
    struct Stream {
        std::string id;
        std::unique_ptr<media::Outlet> outlet;
        StreamStatus status = StreamStatus::not_running;
        bool received = false;
        bool held_with_all = false;  // by `suspend`
    };

    void on_step(Instant when) final;
    void time_passed(Instant now) final;
    std::optional<std::string> parameter_problem(ParameterList const&) const final;
    Prepared prepare_start(ParameterList const&) final;
    Prepared prepare_command(std::string_view command_type, ParameterList const& arguments) final;
    void change(CommandHandle, std::string_view command_type, std::string_view stream_id, Instant now);

    std::variant<Opening, std::string> negotiated(ParameterList const&) const;
    void connect(CommandHandle, Instant now);
    void disconnect(Stream&, Instant now);
    void hold(Stream&, Instant now);
    void go_on(Stream&, Instant now);
    void receptions(Stream&, Instant now);
    Stream* find(std::string_view id);
    void turn(Stream&, StreamStatus, Instant now);

    ParameterList parameters_;
    std::vector<Stream> streams_;     // connected streams, oldest first
    std::deque<std::string> closed_;  // ids, the most recently closed first
    unsigned last_ = 0;
    bool held_ = false;  // set by `suspend`; streams that connect later are held, too
};

}  // namespace rois::basic
