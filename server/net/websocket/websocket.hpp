// One WebSocket: requests, answers and notifications as text frames (docs/clients.md). Belongs to one thread; always held by a
// shared_ptr.
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>

#include "gateway/gateway.hpp"
#include "net/wake_up.hpp"
#include "net/websocket/websocket_frames.hpp"
#include "wire/wire.hpp"

namespace rois::net {

class Loop;
class Shared;

// Collects answers and notifications, so that few writes send them. `flush` writes at once as long as the peer reads fast enough;
// otherwise `drain` writes the rest.
class WebSocket : public Reader {
public:
    WebSocket(std::shared_ptr<Wire>, Loop&, std::shared_ptr<Client>);

    // Call it after the answer to the handshake. Runs until the connection ends.
    Task<> run();

    // Sends a ping to a silent peer, and to one that moves a robot. Closes the connection of a peer that exceeds a deadline.
    void sweep(Steady now);
    // The number of bytes of an unfinished message, in complete fragments.
    std::size_t gathered() const { return messages_.gathered(); }
    // Sends the last notifications, then closes the connection with 1001.
    void shut_down();

private:
    struct Ending {
        CloseCode code;
        std::string_view reason;
    };

    void woken() override { flush(); }
    void taken_over() override;

    bool take_frames();
    void take(Received const&);
    void take(PendingAnswer&&);
    void take_answers();
    void answered(Answer&&);
    void add(Answer const&);
    void return_message(std::string_view text);
    void add_pong(std::string_view payload);
    void join(Answer const&);
    bool full() const;
    bool in_any_order() const;
    Task<> pause();
    Task<> answer_long_message();
    Task<> leave_session();
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

    std::shared_ptr<Wire> wire_;
    Shared& shared_;
    std::unique_ptr<Reading> reading_;  // of the session, until its last notification was written
    std::shared_ptr<Waker> waker_;      // is woken when an answer has come
    std::list<PendingAnswer> pending_;  // in the order of their requests
    bool session_changes_ = false;      // a pending answer may change the session; until then no frames are handled
    std::string answers_;               // frames for the next write
    std::size_t answers_waiting_ = 0;   // number of answers and pongs among them
    std::size_t answers_in_out_ = 0;    // number of answers and pongs that are being written
    std::shared_ptr<WakeUp> room_;      // raised after a write; null if nothing waits for that
    bool session_over_ = false;         // `reading_` has returned its last notification
    bool ping_due_ = false;
    bool writing_ = false;                // `drain` runs
    bool broken_ = false;                 // the connection is closed
    bool close_gathered_ = false;         // the close frame is being written or was written; nothing follows it
    std::optional<Ending> ending_;        // set: a close frame follows the answers and notifications that wait
    Steady close_due_ = Steady::max();    // when the connection is cut after our close frame
    Steady session_due_ = Steady::max();  // when a session must have been opened; max: there is one, or no sweep has run yet

    bool has_received_ = false;  // since the last sweep
    bool pinged_ = false;        // since the peer has sent anything
    Steady received_at_;         // when a sweep last found that the peer has sent something
    Pings pings_;
    Steady proof_due_ = Steady::min();    // the next ping while the robot moves (decision 33)
    Steady message_due_ = Steady::max();  // when the unfinished message must be complete
    Steady controls_since_;               // the beginning of the second in which control frames are counted
    unsigned controls_ = 0;
    Loop& loop_;
    std::string long_message_;  // for the other thread; no more frames are handled meanwhile
    MessageReader messages_;
    SessionId session_;
    std::shared_ptr<Client> client_;
    std::unique_ptr<Answer> last_answer_;  // to a disconnect; waits until the session's last notifications are sent
    std::string out_;                      // the bytes that `drain` writes
};

}  // namespace rois::net
