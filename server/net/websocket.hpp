// One WebSocket: requests, answers and notifications as text frames (wire.md). Belongs to one thread; always held by a
// shared_ptr.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gateway/gateway.hpp"
#include "net/long_documents.hpp"
#include "net/settings.hpp"
#include "net/signal.hpp"
#include "net/websocket_frames.hpp"
#include "net/wire.hpp"

namespace rois::net {

// Answers and notifications are gathered and go out in as few writes as possible: whoever has something to say calls `flush`,
// which writes at once as long as the peer keeps up, and leaves the rest to `drain` when it does not.
class WebSocket : public Reader {
public:
    WebSocket(std::shared_ptr<Wire>, Gateway&, Telemetry&, xml::RequestReader&, LongDocuments&, Wakes&, Settings const&,
              std::shared_ptr<Opener>);

    // After the handshake has been answered: until the connection is over.
    Task<> run();

    // Looks at the clock: pings who is silent or commands something that moves, closes for who sends a message too slowly.
    void sweep(Steady now);
    // Bytes of a message that is not whole yet, in fragments that are.
    std::size_t gathered() const { return messages_.gathered(); }
    // The peer hears its last notifications, then the connection closes with 1001.
    void shut_down();

private:
    struct Ending {
        CloseCode code;
        std::string_view reason;
    };

    void woken() override { flush(); }
    void taken_over() override;

    static constexpr std::size_t most_answers = 64 * 1024;  // bytes that wait before it is read again

    bool take_frames();
    void take(MessageReader::Heard const&);
    void answered(Answer&&);
    void say(Answer const&);
    void say_pong(std::string_view payload);
    void join(Answer const&);
    bool full() const { return answers_waiting_ >= settings_.max_requests_in_flight || answers_.size() > most_answers; }
    Task<> pause();
    Task<> answer_long_message();
    Task<> say_farewell();
    Task<> wait_for_room();
    Task<> something_written();
    void note_message();
    void note_control();
    void close(Ending);

    void flush();
    void write();
    void break_off() noexcept;
    void keep_unsent(std::string_view);
    bool gather(std::string& out);
    bool gather_notifications(std::string& out);
    void written();
    Task<> drain();

    // What every notification needs comes first, close together: an event to a thousand WebSockets finds each of them far away in
    // memory.
    std::shared_ptr<Wire> wire_;
    Telemetry& telemetry_;
    std::unique_ptr<Reading> reading_;  // of the session, until its last notification was written
    std::string answers_;               // frames that wait for the next write
    std::size_t answers_waiting_ = 0;   // among them, pongs too
    std::size_t answers_in_out_ = 0;
    std::shared_ptr<Signal> room_;  // raised when output was written; null while nobody waits for that
    bool session_over_ = false;     // reading_ has given its last
    bool ping_due_ = false;
    bool writing_ = false;
    bool broken_ = false;
    bool close_gathered_ = false;   // the close frame is in out_; nothing follows
    std::optional<Ending> ending_;  // decided: the close frame goes out behind what was said before
    Steady close_due_ = Steady::max();
    Steady session_due_ = Steady::max();  // when it must have a session; max: it has one, or nobody has looked yet

    bool heard_something_ = false;  // from the peer, since the last sweep
    bool pinged_ = false;           // since it was heard
    Steady heard_;                  // from the peer, last
    Pings pings_;
    Steady proof_due_ = Steady::min();    // the next ping while the robot moves (decision 33)
    Steady message_due_ = Steady::max();  // when what has begun to arrive must be whole
    Steady controls_since_;               // the beginning of the second in which control frames are counted
    unsigned controls_ = 0;
    Settings const& settings_;
    Gateway& gateway_;
    xml::RequestReader& reader_;
    LongDocuments& long_documents_;
    std::string long_message_;  // waits for the other thread; no more is taken meanwhile
    MessageReader messages_;
    SessionId session_;
    std::shared_ptr<Opener> opener_;
    std::unique_ptr<Answer> farewell_;  // to a disconnect: waits for the session's last notifications to be heard
    std::string out_;                   // what `drain` writes; empty while everything is taken at once
};

}  // namespace rois::net
