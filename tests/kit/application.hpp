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

enum class Way : std::uint8_t { http, websocket };

std::ostream& operator<<(std::ostream&, Way);
inline constexpr Way all_ways[] = {Way::http, Way::websocket};

// The transport of an application.
class Wire {
public:
    virtual ~Wire() = default;
    // Sends a request document and returns its answer. Appends notifications that arrive before it to `news`.
    virtual std::string ask(std::string const& request, std::vector<std::string>& news) = 0;
    // Waits for at least one notification. Throws LineEnded if none arrives within the patience.
    virtual void wait(std::vector<std::string>& news) = 0;
    // Appends the notifications that have arrived to `news`, without waiting.
    virtual void look(std::vector<std::string>& news) = 0;
    // Sets the session of later requests.
    virtual void use(std::string const& session) = 0;
};

std::unique_ptr<Wire> wire_to(Address const&, Way);

// A derived class checks each answer and notification, and calls `leave` in its destructor.
class Application {
public:
    // Not connected yet.
    explicit Application(std::unique_ptr<Wire> wire) : wire_{std::move(wire)} {}
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
    std::vector<std::string> search(Xml const& condition = {});  // refs; "" for a refusal

    // Waits for the next notification and returns it.
    Document receive();
    // Returns the next notification, or nullopt if none has arrived. Over a WebSocket, only notifications that were sent before
    // the last answer have arrived.
    std::optional<Document> receive_now();
    // Waits for the next event of this type and returns it. Skips other notifications.
    Document next_event(std::string const& type);
    // Waits until the command completes and returns its status. Skips other notifications.
    std::string status_of(std::string const& command_id);

    // Other names of these functions, which tests/conformance uses.
    Document hear() { return receive(); }
    std::optional<Document> hear_now() { return receive_now(); }
    Document hear_event(std::string const& type) { return next_event(type); }

    // All notifications so far, in order.
    std::vector<Document> const& history() const { return history_; }

    std::string const& session() const { return session_; }  // of the last connect

protected:
    virtual void check_answer(Document const& answer, std::string const& operation, std::string const& request_id) = 0;
    // `sequence` is the expected one.
    virtual void check_notification(Document const&, std::uint64_t sequence) = 0;

    bool is_connected() const { return connected_; }
    // Disconnects if it is connected.
    void leave();

private:
    void take(std::vector<std::string> const& news);

    std::unique_ptr<Wire> wire_;
    std::vector<Document> waiting_;  // arrived, not returned yet
    std::vector<Document> history_;
    std::uint64_t last_sequence_ = 0;  // that has arrived
    unsigned requests_ = 0;
    std::string session_;
    bool connected_ = false;
};

// "reached_target", "completed move-1 OK", "lost": a line for each notification.
std::vector<std::string> lines(std::vector<Document> const& notifications);

}  // namespace rois::kit
