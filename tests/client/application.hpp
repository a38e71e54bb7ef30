// A service application in the domain's words, the same over HTTP with long poll and over a WebSocket.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "client/address.hpp"
#include "client/vocabulary.hpp"

namespace rois::client {

enum class Way : std::uint8_t { http, websocket };

std::ostream& operator<<(std::ostream&, Way);
inline constexpr Way all_ways[] = {Way::http, Way::websocket};

// How an application reaches the gateway.
class Wire {
public:
    virtual ~Wire() = default;
    // The answer to one request document; notifications that come before it are put into `news`.
    virtual std::string ask(std::string const& request, std::vector<std::string>& news) = 0;
    // Waits until there is at least one notification; throws LineEnded when none comes for very long.
    virtual void wait(std::vector<std::string>& news) = 0;
    // Puts into `news` what has arrived, without waiting.
    virtual void look(std::vector<std::string>& news) = 0;
    // The session in which requests are made from now on.
    virtual void use(std::string const& session) = 0;
};

std::unique_ptr<Wire> wire_to(Address const&, Way);

// Whoever derives says what is checked of each answer and notification, and leaves in its destructor.
class Application {
public:
    // Not connected yet.
    explicit Application(std::unique_ptr<Wire> wire) : wire_{std::move(wire)} {}
    virtual ~Application() = default;
    Application(Application const&) = delete;
    Application& operator=(Application const&) = delete;

    // An operation and its children.
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

    // The next notification.
    Document hear();
    // The next notification if one has arrived. Over a WebSocket, those that came before the last answer have.
    std::optional<Document> hear_now();
    // Passes over others until it comes.
    Document hear_event(std::string const& type);
    // The status with which a command completes; passes over others until then.
    std::string status_of(std::string const& command_id);

    // All that was heard until now, in order.
    std::vector<Document> const& history() const { return history_; }

    std::string const& session() const { return session_; }  // of the last connect

protected:
    virtual void check_answer(Document const& answer, std::string const& operation, std::string const& request_id) = 0;
    // `sequence` is the one that is due.
    virtual void check_notification(Document const&, std::uint64_t sequence) = 0;

    bool is_connected() const { return connected_; }
    // Disconnects if it is connected.
    void leave();

private:
    void take(std::vector<std::string> const& news);

    std::unique_ptr<Wire> wire_;
    std::vector<Document> waiting_;  // arrived and not heard yet
    std::vector<Document> history_;
    std::uint64_t last_sequence_ = 0;  // of those that have arrived
    unsigned requests_ = 0;
    std::string session_;
    bool connected_ = false;
};

// "reached_target", "completed move-1 OK", "lost": a line for each notification.
std::vector<std::string> lines(std::vector<Document> const& notifications);

}  // namespace rois::client
