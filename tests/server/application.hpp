// A service application in the domain's words, the same over HTTP with long poll and over a WebSocket.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "server/gateway_process.hpp"
#include "server/vocabulary.hpp"

namespace rois::test {

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
    // The session in which requests are made from now on.
    virtual void use(std::string const& session) = 0;
};

// Checks always, beside what the test says: each answer belongs to its request (name and request_id), a refusal has a reason and
// no out parameters, and the notifications' sequence has no gap.
class Application {
public:
    // Not connected yet.
    explicit Application(Way, GatewayProcess const&);
    ~Application();  // disconnects
    Application(Application const&) = delete;
    Application& operator=(Application const&) = delete;

    // An operation and its children.
    Document ask(std::string const& operation, std::string const& children = "", std::string const& attributes = "");

    Document connect();
    Document disconnect();
    Document bind(std::string const& ref);
    Document release(std::string const& ref);
    Document get_parameter(std::string const& ref);
    Document set_parameter(std::string const& ref, std::vector<Argument> const& arguments);
    Document execute(std::string const& units);
    Document execute(Command const& command) { return execute(unit(command)); }
    Document get_command_result(std::string const& id, std::string const& condition = "");
    Document query(std::string const& type, std::string const& condition = "");
    Document subscribe(std::string const& event, std::string const& condition = "", bool inline_results = false);
    Document unsubscribe(std::string const& id);
    Document get_event_detail(std::string const& id, std::string const& condition = "");
    std::vector<std::string> search(std::string const& condition = "");  // refs; "" for a refusal

    // The next notification.
    Document hear();
    // Passes over others until it comes.
    Document hear_event(std::string const& type);
    // The status with which a command completes; passes over others until then.
    std::string status_of(std::string const& command_id);

    // All that was heard until now, in order.
    std::vector<Document> const& history() const { return history_; }

private:
    void take(std::vector<std::string> const& news);

    std::unique_ptr<Wire> wire_;
    std::vector<Document> waiting_;  // arrived and not heard yet
    std::vector<Document> history_;
    std::uint64_t last_sequence_ = 0;  // of those that have arrived
    unsigned requests_ = 0;
    bool connected_ = false;
};

// "reached_target", "completed move-1 OK", "lost": a line for each notification.
std::vector<std::string> lines(std::vector<Document> const& notifications);

}  // namespace rois::test
