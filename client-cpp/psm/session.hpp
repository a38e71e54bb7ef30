// The one session of a process that uses the C++ PSM, on top of rois::Client.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "psm/delivery.hpp"
#include "psm/values.hpp"
#include "rois/client.hpp"
#include "xml/codec/codec.hpp"

namespace rois::psm {

void set_reason(std::string);

// Returns a condition, in XML, for components of this type of the specification.
std::string condition_on_type(std::string const& type);

// Thread-safe. Every function that returns a return code sets the calling thread's reason and throws nothing.
class Session {
public:
    static Session& instance();
    ~Session();
    Session(Session const&) = delete;
    Session& operator=(Session const&) = delete;

    // --- For the interfaces ---

    RoIS_HRI::ReturnCode_t connect();
    RoIS_HRI::ReturnCode_t disconnect();

    // Runs an operation. Passes the reply to `take` if it is OK.
    template <class Op, class Take>
    RoIS_HRI::ReturnCode_t call(Op operation, Take take);
    template <class Op>
    RoIS_HRI::ReturnCode_t call(Op operation) {
        return call(std::move(operation), [](typename Op::Reply const&) {});
    }

    // Runs an operation with the application's XML. Passes the reply and its document to `take` if it is OK.
    template <class R, class Take>
    RoIS_HRI::ReturnCode_t send(std::string_view xml, std::string document, Take take);

    RoIS_HRI::ReturnCode_t bind(std::string ref);
    RoIS_HRI::ReturnCode_t bind_any(std::string_view condition, std::string& ref);
    RoIS_HRI::ReturnCode_t release(std::string ref);
    RoIS_HRI::ReturnCode_t execute(std::string_view sequence);
    RoIS_HRI::ReturnCode_t subscribe(std::string const& event_type, std::string const& condition, std::string& id);
    RoIS_HRI::ReturnCode_t unsubscribe(std::string const& id);
    RoIS_HRI::ReturnCode_t get_error_detail(std::string const& id, std::string_view condition, Results& results);

    // --- For the components. RoIS_Common.hpp says which component a type addresses. ---

    // Starts a command of the component of this type.
    RoIS_HRI::ReturnCode_t run(std::string const& component_type, std::string command_type, ParameterList arguments);
    // Starts a command of the component of this type, and waits until it has completed.
    RoIS_HRI::ReturnCode_t run_to_the_end(std::string const& component_type, std::string command_type, ParameterList arguments,
                                          EventResults& results);
    // Queries the component of this type; `more` narrows the condition.
    RoIS_HRI::ReturnCode_t query(std::string const& component_type, std::string query_type, std::optional<Condition> more,
                                 EventResults& results);

    // Gives a sign of life; from now on the notification thread gives none (alive.hpp).
    void alive();

    // --- Receivers ---

    void add(RoIS_Service::ServiceApplicationBase*);
    void remove(RoIS_Service::ServiceApplicationBase*);
    void add(RoIS_Common::Event*);
    void remove(RoIS_Common::Event*);

private:
    struct Bound {
        std::string ref;
        std::string type;  // the last part of its URN; empty if unknown
    };
    struct Subscription {
        std::string event_type;
        std::string condition;
        std::string engine_id;        // in the engine's current session
        bool by_application = false;  // by EventIF::subscribe
        bool by_receivers = false;    // by Event objects
    };
    struct Meant {
        RoIS_HRI::ReturnCode_t code = RoIS_HRI::OK;
        std::string ref;
    };

    Session() = default;

    std::shared_ptr<Client> client() const;  // null while not connected
    std::shared_ptr<Client> ready_client();  // the same, after activating new receivers
    void activate(std::shared_ptr<Client> const&);
    Observers observers();
    void give_sign_of_life() const;
    RoIS_HRI::ReturnCode_t failed(Answer const&, Client const&) const;
    // Sends a document and reads its answer. Calls `note` with a reply that is OK, on the client's thread: before any later
    // notification.
    static Task<Answer> exchange(std::shared_ptr<Client>, std::string document, std::string& response,
                                 std::function<void(Reply const&)> note);
    // Like `exchange`, but sends nothing if the application's XML is not well-formed.
    RoIS_HRI::ReturnCode_t send_on(std::shared_ptr<Client> const&, std::string_view xml, std::string document,
                                   std::string& response, std::function<void(Reply const&)> note) const;
    RoIS_HRI::ReturnCode_t subscribe_on(std::shared_ptr<Client> const&, std::string const& event_type,
                                        std::string const& condition, bool Subscription::*by, std::string& id);
    void note_bound(std::shared_ptr<Client> const&, std::string const& ref);
    Meant component_of(std::string const& type, bool bind);
    std::optional<std::string> bound_of(std::string const& type) const;  // with mutex_ locked
    CommandUnitSequence one_command(std::string const& ref, std::string const& command_type, ParameterList arguments,
                                    CommandId& id);

    void take(Notification const&);
    void take(ReceiveEvent const&);
    void take_gap(Gap const&);
    void take_state(StateChange const&);
    void post(Delivery::Kind, std::function<void()>);
    void report(std::string text);  // reports an error of the library to the receivers
    void abort_commands();
    void subscribe_again();
    template <class Receiver>
    void add_to(std::vector<Receiver*>&, Receiver*);
    template <class Receiver>
    void remove_from(std::vector<Receiver*>&, Receiver*);
    void deliver_error(std::string const& id, RoIS_Service::ErrorType);
    void deliver_completed(std::string const& id, RoIS_Service::Completed_Status);
    std::vector<RoIS_Service::ServiceApplicationBase*> applications() const;

    mutable std::mutex mutex_;  // guards the members below; not held during calls to the engine or the application
    std::mutex connecting_;     // one connect or disconnect at a time
    std::shared_ptr<Client> client_;
    std::vector<Bound> bound_;                           // in the order of binding
    std::map<std::string, Subscription> subscriptions_;  // by the id that the application knows
    std::set<std::string> running_;                      // ids of accepted commands that have not completed
    std::map<std::string, std::string> errors_;          // the library's own errors: text by id
    std::vector<RoIS_Service::ServiceApplicationBase*> applications_;
    std::vector<RoIS_Common::Event*> events_;
    std::set<Receiver> new_;  // registered, but not receiving yet
    unsigned long last_command_ = 0;
    unsigned long last_error_ = 0;

    std::atomic<bool> application_gives_signs_ = false;  // it has called alive()
    std::atomic<bool> dropping_ = false;                 // a report of dropped events is queued; a second one is not needed

    Delivery delivery_;  // the last member: its thread must end first
};

template <class Op, class Take>
RoIS_HRI::ReturnCode_t Session::call(Op operation, Take take) try {
    set_reason({});
    auto const client = ready_client();
    if (!client) return RoIS_HRI::ERROR;
    Request request{std::move(operation), {}};
    auto const answer = client->wait(client->request(std::move(request)));
    auto const code = failed(answer, *client);
    if (code != RoIS_HRI::OK) return code;
    take(std::get<typename Op::Reply>(std::get<Reply>(answer)));
    return RoIS_HRI::OK;
} catch (std::exception const& problem) {
    set_reason(problem.what());
    return RoIS_HRI::ERROR;
}

template <class R, class Take>
RoIS_HRI::ReturnCode_t Session::send(std::string_view xml, std::string document, Take take) try {
    set_reason({});
    auto const client = ready_client();
    if (!client) return RoIS_HRI::ERROR;
    std::string response;
    R reply;
    auto const code = send_on(client, xml, std::move(document), response, [&](Reply const& all) { reply = std::get<R>(all); });
    if (code == RoIS_HRI::OK) take(reply, response);
    return code;
} catch (std::exception const& problem) {
    set_reason(problem.what());
    return RoIS_HRI::ERROR;
}

}  // namespace rois::psm
