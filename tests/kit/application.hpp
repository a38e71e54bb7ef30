// A service application with a function for each operation, over HTTP with long poll or over a WebSocket.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "kit/address.hpp"
#include "kit/vocabulary.hpp"

namespace rois::kit {

enum class Transport : std::uint8_t { http, websocket };

std::ostream& operator<<(std::ostream&, Transport);
inline constexpr Transport all_transports[] = {Transport::http, Transport::websocket};

// The connection of an application over one transport.
class Connection {
public:
    virtual ~Connection() = default;
    // Sends a request document and returns its answer. Appends notifications that arrive before the answer to `notifications`.
    virtual std::string ask(std::string const& request, std::vector<std::string>& notifications) = 0;
    // Waits for at least one notification, and appends it to `notifications`. Throws LineEnded if none arrives within the
    // patience.
    virtual void wait(std::vector<std::string>& notifications) = 0;
    // Appends the notifications that have arrived to `notifications`, without waiting.
    virtual void fetch(std::vector<std::string>& notifications) = 0;
    // Sets the session of later requests.
    virtual void set_session(std::string const& session) = 0;
};

std::unique_ptr<Connection> connection_over(Address const&, Transport);

// A derived class checks each answer and notification, and calls `disconnect_if_connected` in its destructor.
class Application {
public:
    // Opens no session: call `connect`.
    explicit Application(std::unique_ptr<Connection> connection) : connection_{std::move(connection)} {}
    virtual ~Application() = default;
    Application(Application const&) = delete;
    Application& operator=(Application const&) = delete;

    // Sends an operation with these child elements.
    Document ask(std::string const& operation, Xml const& children = {}, Attributes const& attributes = {});

    Document connect();
    Document disconnect();
    Document bind(std::string const& ref);
    Document release(std::string const& ref);
    Document get_parameter(std::string const& ref);
    Document set_parameter(std::string const& ref, std::vector<Argument> const& arguments);
    Document execute(Xml const& units);
    Document execute(Command const& command) { return execute(unit(command)); }
    Document get_command_result(std::string const& id, Xml const& condition = {});
    Document query(std::string const& type, Xml const& condition = {});
    Document subscribe(std::string const& event, Xml const& condition = {}, bool inline_results = false);
    Document unsubscribe(std::string const& id);
    Document get_event_detail(std::string const& id, Xml const& condition = {});
    std::vector<std::string> search(Xml const& condition = {});  // refs; {""} if the gateway refuses the search

    // Waits for the next notification and returns it.
    Document receive();
    // Returns the next notification if one has arrived. Over a WebSocket, returns only notifications that arrived before the last
    // answer.
    std::optional<Document> receive_now();
    // Waits for the next event of this type and returns it. Skips other notifications.
    Document next_event(std::string const& type);
    // Waits until a command completes and returns its status. Skips other notifications.
    std::string status_of(std::string const& command_id);

    // All notifications that the functions above have returned or skipped, in order.
    std::vector<Document> const& history() const { return history_; }

    std::string const& session() const { return session_; }  // of the last connect

protected:
    virtual void check_answer(Document const& answer, std::string const& operation, std::string const& request_id) = 0;
    // `sequence` is the expected sequence number.
    virtual void check_notification(Document const&, std::uint64_t sequence) = 0;

    bool is_connected() const { return connected_; }
    void disconnect_if_connected();

private:
    void take(std::vector<std::string> const& notifications);

    std::unique_ptr<Connection> connection_;
    std::vector<Document> waiting_;  // arrived, but not returned yet
    std::vector<Document> history_;
    std::uint64_t last_sequence_ = 0;  // of the last notification that has arrived
    unsigned requests_ = 0;
    std::string session_;
    bool connected_ = false;
};

// Returns a line for each notification: "reached_target", "completed move-1 OK", "lost".
std::vector<std::string> lines(std::vector<Document> const& notifications);

}  // namespace rois::kit
