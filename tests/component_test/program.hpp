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

// All functions throw Broken if the program does not do what docs/component-programs.md asks.
class Program {
public:
    Program(std::vector<std::string> command, std::chrono::milliseconds patience, std::shared_ptr<xml::Schemas const> const&);
    ~Program();  // kills it
    Program(Program const&) = delete;
    Program& operator=(Program const&) = delete;

    // Joined, with a session, a profile and an open link, whatever has happened before.
    void be_ready();

    // Waits for a link and its `join`, and accepts that.
    xml::Join await_join();
    // Opens a new session on the link.
    Connect::Reply connect();
    void cut();
    // Ends session and link after a broken rule: the next check begins with new ones.
    void abandon_link();
    bool link_has_ended() const { return !link_ || link_->has_ended(); }

    // Sends the request, and waits for its answer.
    template <class Op>
    typename Op::Reply ask(Op operation) {
        auto const answer = answer_to(std::move(operation));
        auto const* reply = std::get_if<xml::Answered>(&answer);
        auto const* of_operation = reply == nullptr ? nullptr : std::get_if<typename Op::Reply>(&reply->reply);
        if (of_operation == nullptr) complain("the answer is not that of the request");
        return *of_operation;
    }
    // The answer, or the fault.
    xml::EngineMessage answer_to(Operation);
    void send(std::string const& document);

    // Executes one command. Returns its id if it was accepted; else the reply has the reason.
    struct Started {
        Execute::Reply reply;
        std::string id;
    };
    Started execute(std::string const& ref, std::string const& command, ParameterList const& arguments = {},
                    bool check_only = false);
    // Waits for the end of a command.
    Completed completed(std::string const& id, std::chrono::milliseconds within);
    bool has_subscribed(std::string const& event_type) const { return subscribed_.contains(event_type); }

    // Takes the notifications that come within this time. An answer breaks a rule.
    void settle(std::chrono::milliseconds time = std::chrono::milliseconds{200});

    std::vector<ComponentEntry> const& components() const { return components_; }
    SessionId const& session() const { return session_; }
    std::uint64_t last_sequence() const { return last_sequence_; }
    std::string const& instance() const { return instance_; }
    bool reports(std::string const& ref) const { return states_.contains(ref); }
    std::chrono::milliseconds patience() const { return patience_; }
    EngineProfile const& profile() const { return *profile_; }

    // Sends SIGTERM. Returns the exit code; nothing if it does not end in time.
    std::optional<int> end();

    [[noreturn]] static void complain(std::string const& what);

private:
    // Takes one message until then. Returns an answer or a fault; nothing after a notification, or if none came.
    std::optional<xml::EngineMessage> take(Clock::time_point until);
    void judge(xml::NumberedNotification const&);
    void judge(ReceiveEvent const&);
    void judge(ReceiveError const&) {}
    void judge(Completed const&);
    void judge(Lost const&) {}
    void judge(ProfileChanged const&) {}
    void judge(ComponentChanged const&);
    ComponentProfile const& profile_of(std::string const& ref) const;

    std::chrono::milliseconds patience_;
    kit::Listener listener_;
    pid_t process_;
    std::unique_ptr<Link> link_;
    std::unique_ptr<xml::Validator> validator_;
    xml::JoinReader joins_;
    xml::AnswerReader reader_;
    std::string instance_;
    SessionId session_;
    std::uint64_t last_sequence_ = 0;
    std::uint64_t last_request_ = 0;
    std::uint64_t last_command_ = 0;
    std::shared_ptr<EngineProfile const> profile_;
    std::vector<ComponentEntry> components_;
    std::map<std::string, std::pair<std::string, std::string>> commands_;  // component and command, by id
    std::map<std::string, Completed> completed_;
    std::set<std::string> subscribed_;
    std::set<std::string> states_;
};

// Returns why the results do not fit the profile, or an empty text.
std::string why_not(Results const&, std::vector<ParameterProfile> const& known);

}  // namespace rois::component_test
