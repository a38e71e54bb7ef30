// The component program under test, as its engine sees it.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "component_test/link.hpp"
#include "types/messages.hpp"
#include "xml/codec/codec.hpp"
#include "xml/validation/joining.hpp"
#include "xml/validation/schemas.hpp"
#include "xml/validation/validator.hpp"

namespace rois::component_test {

constexpr std::chrono::milliseconds window{1'000};
constexpr std::chrono::milliseconds longest_halt{500};
constexpr std::chrono::milliseconds motion_lease{1'000};
constexpr std::chrono::milliseconds short_link{5'500};

// All functions throw Broken if the program violates docs/component-programs.md.
class Program {
public:
    Program(std::vector<std::string> command, std::chrono::milliseconds patience, std::shared_ptr<xml::Schemas const> const&);
    ~Program();  // kills the program
    Program(Program const&) = delete;
    Program& operator=(Program const&) = delete;

    // Waits until the program has joined, and has a session and an open link. Reads its profile.
    void ensure_ready();

    // Waits for a link and its `join`, and accepts the `join`.
    xml::Join await_join();
    // Sends `connect`, which opens a session on a new link, or after `disconnect`.
    Connect::Reply connect(std::chrono::milliseconds with_window = window);
    // Sends `disconnect`, which ends the session. The link stays.
    void disconnect();
    // Sends a ping, and waits for its pong.
    void ping();
    void cut();
    // Ends the session and the link after a broken rule, so that the next check begins with new ones.
    void abandon_link();
    bool link_has_ended() const { return !link_ || link_->has_ended(); }
    // Waits until the end of the link is not the end of a short link, after which a program may join later than 0.2 s.
    void outlast_short_link() {
        settle(std::chrono::duration_cast<std::chrono::milliseconds>(joined_ + short_link - Clock::now()));
    }

    // Sends the request, waits for its answer, and returns it.
    template <class Op>
    typename Op::Reply ask(Op operation) {
        auto const answer = answer_to(std::move(operation));
        auto const* reply = std::get_if<xml::Answered>(&answer);
        auto const* of_operation = reply == nullptr ? nullptr : std::get_if<typename Op::Reply>(&reply->reply);
        if (of_operation == nullptr)
            fail("expected the answer of the requested operation, got a fault or the answer of another one");
        return *of_operation;
    }
    // Sends the request, and returns its answer or fault.
    xml::EngineMessage answer_to(Operation);
    // Sends the requests without a pause between them. Returns their answers in the order of the requests; they may come in any
    // order.
    std::vector<xml::EngineMessage> answers_to(std::vector<Operation>);
    void send(std::string const& document);

    // Executes one command. If the program refuses it, the reply has the reason.
    struct Started {
        Execute::Reply reply;
        std::string id;
    };
    Started execute(std::string const& ref, std::string const& command, ParameterList const& arguments = {},
                    bool check_only = false);
    // Waits until a command completes.
    Completed completed(std::string const& id, std::chrono::milliseconds within);
    bool has_completed(std::string const& id) const { return completed_.contains(id); }
    // The number of events and errors of a component until now.
    std::size_t events_of(std::string const& ref) const { return number(events_, ref); }
    std::size_t errors_of(std::string const& ref) const { return number(errors_, ref); }
    // By the ref of each component: whether it reports no events while nothing runs, if a check has measured it.
    std::map<std::string, bool>& quiet() { return quiet_; }
    bool has_subscribed(std::string const& event_type) const { return subscribed_.contains(event_type); }

    // Reads notifications for this time. Throws Broken if an answer arrives: no request is open.
    void settle(std::chrono::milliseconds time = std::chrono::milliseconds{200});

    std::vector<ComponentEntry> const& components() const { return components_; }
    SessionId const& session() const { return session_; }
    std::uint64_t last_sequence() const { return last_sequence_; }
    std::string const& instance() const { return instance_; }
    bool reports(std::string const& ref) const { return states_.contains(ref); }
    std::chrono::milliseconds patience() const { return patience_; }
    EngineProfile const& profile() const { return *profile_; }

    // Returns the exit code, or minus the signal that killed the program, if it has ended.
    std::optional<int> exit_code();
    // Sends SIGTERM. Returns the exit code, or nothing if the program does not end within the patience.
    std::optional<int> end();

    [[noreturn]] static void fail(std::string const& what);

private:
    using Numbers = std::map<std::string, std::size_t>;  // by the ref of the component

    static std::size_t number(Numbers const& of, std::string const& ref) { return of.contains(ref) ? of.at(ref) : 0; }
    // Reads one message. Returns an answer or a fault. Returns nothing after a notification, or if no message arrives before the
    // deadline.
    std::optional<xml::EngineMessage> take(Clock::time_point until);
    // Waits for an answer, which must be that of this request.
    // `missing`: where the answers to requests belong, by request_id.
    void take_next_answer(std::map<std::string, xml::EngineMessage*>& missing);
    void check_notification(xml::NumberedNotification const&);
    void check_notification(ReceiveEvent const&);
    void check_notification(ReceiveError const&);
    void check_notification(Completed const&);
    void check_notification(Lost const&) {}
    void check_notification(ProfileChanged const&) {}
    void check_notification(Switched const&) {}
    void check_notification(ComponentChanged const&);
    ComponentProfile const& profile_of(std::string const& ref) const;

    std::chrono::milliseconds patience_;
    kit::Listener listener_;
    pid_t process_;
    std::optional<int> exit_code_;
    std::unique_ptr<Link> link_;
    std::unique_ptr<xml::Validator> validator_;
    xml::JoinReader joins_;
    xml::AnswerReader reader_;
    std::string instance_;
    Clock::time_point joined_;
    SessionId session_;
    std::uint64_t last_sequence_ = 0;
    std::uint64_t last_request_ = 0;
    std::uint64_t last_command_ = 0;
    std::shared_ptr<EngineProfile const> profile_;
    std::vector<ComponentEntry> components_;
    std::map<std::string, std::pair<std::string, std::string>> commands_;  // id -> component and command
    std::map<std::string, Completed> completed_;
    std::set<std::string> reported_;  // ids of events and errors
    Numbers events_, errors_;
    std::map<std::string, bool> quiet_;
    std::set<std::string> subscribed_;
    std::set<std::string> states_;
};

// Returns why the results do not match the profile, or an empty text if they do.
std::string why_not(Results const&, std::vector<ParameterProfile> const& known);

}  // namespace rois::component_test
