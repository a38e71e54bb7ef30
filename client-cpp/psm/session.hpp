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
#include "xml/codec.hpp"

namespace rois::psm {

void set_reason(std::string);

// A condition on components of a type of the specification, in XML.
std::string condition_on_type(std::string const& type);

// Thread-safe. Every function that returns a return code sets the calling thread's reason and throws nothing.
class Session {
public:
    static Session& instance();
    ~Session();
    Session(Session const&) = delete;
    Session& operator=(Session const&) = delete;

    // --- What the interfaces are made of ---

    RoIS_HRI::ReturnCode_t connect();
    RoIS_HRI::ReturnCode_t disconnect();

    // An operation; its reply is given to `take` if it is OK.
    template <class Op, class Take>
    RoIS_HRI::ReturnCode_t call(Op operation, Take take);
    template <class Op>
    RoIS_HRI::ReturnCode_t call(Op operation) {
        return call(std::move(operation), [](typename Op::Reply const&) {});
    }

    // An operation with the application's XML. Its reply is given to `take` if it is OK, with the document.
    template <class R, class Take>
    RoIS_HRI::ReturnCode_t send(std::string_view xml, std::string document, Take take);

    RoIS_HRI::ReturnCode_t bind(std::string ref);
    RoIS_HRI::ReturnCode_t bind_any(std::string_view condition, std::string& ref);
    RoIS_HRI::ReturnCode_t release(std::string ref);
    RoIS_HRI::ReturnCode_t execute(std::string_view sequence);
    RoIS_HRI::ReturnCode_t subscribe(std::string const& event_type, std::string const& condition, std::string& id);
    RoIS_HRI::ReturnCode_t unsubscribe(std::string const& id);
    RoIS_HRI::ReturnCode_t get_error_detail(std::string const& id, std::string_view condition, Results& results);

    // --- What the components are made of ---

    // Starts a command of the component that is meant by this type; see RoIS_Common.hpp.
    RoIS_HRI::ReturnCode_t run(std::string const& component_type, std::string command_type, ParameterList arguments);
    // The same, and waits until it has completed.
    RoIS_HRI::ReturnCode_t run_to_the_end(std::string const& component_type, std::string command_type, ParameterList arguments,
                                          EventResults& results);
    // Asks the component that is meant by this type; `more` narrows the condition.
    RoIS_HRI::ReturnCode_t query(std::string const& component_type, std::string query_type, std::optional<Condition> more,
                                 EventResults& results);

    // The application gives signs of life by itself from now on (alive.hpp).
    void alive();

    // --- Receivers ---

    void add(RoIS_Service::ServiceApplicationBase*);
    void remove(RoIS_Service::ServiceApplicationBase*);
    void add(RoIS_Common::Event*);
    void remove(RoIS_Common::Event*);

private:
    struct Bound {
        std::string ref;
        std::string type;  // the last part of its URN; empty if it is not known
    };
    struct Subscription {
        std::string event_type;
        std::string condition;
        std::string engine_id;        // in the present session of the engine
        bool by_application = false;  // by EventIF::subscribe
        bool by_receivers = false;    // by Event objects
    };
    struct Meant {
        RoIS_HRI::ReturnCode_t code = RoIS_HRI::OK;
        std::string ref;
    };

    Session() = default;

    std::shared_ptr<Client> client() const;  // null while not connected
    std::shared_ptr<Client> ready_client();  // the same; makes new receivers receive
    void activate(std::shared_ptr<Client> const&);
    Observers observers();
    void give_sign_of_life() const;
    RoIS_HRI::ReturnCode_t failed(Answer const&, Client const&) const;
    // Sends a document and reads its answer. `note` is called with a reply that is OK, on the client's thread, and so before any
    // notification that follows it.
    static Task<Answer> exchange(std::shared_ptr<Client>, std::string document, std::string& response,
                                 std::function<void(Reply const&)> note);
    // The same, once the application's XML in it is known to be well-formed. Nothing is sent otherwise.
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
    void report(std::string text);  // as an error of the library
    void abort_commands();
    void subscribe_again();
    void deliver_error(std::string const& id, RoIS_Service::ErrorType);
    void deliver_completed(std::string const& id, RoIS_Service::Completed_Status);
    std::vector<RoIS_Service::ServiceApplicationBase*> applications() const;

    mutable std::mutex mutex_;  // guards all that follows; never held while the engine or the application is called
    std::mutex connecting_;     // one connect or disconnect at a time
    std::shared_ptr<Client> client_;
    std::vector<Bound> bound_;                           // the last one last
    std::map<std::string, Subscription> subscriptions_;  // by the id that the application knows
    std::set<std::string> running_;                      // ids of accepted commands that have not completed
    std::map<std::string, std::string> errors_;          // the library's own, with their texts; the oldest go first
    std::vector<RoIS_Service::ServiceApplicationBase*> applications_;
    std::vector<RoIS_Common::Event*> events_;
    std::set<Receiver> new_;  // registered, but not receiving yet
    unsigned long last_command_ = 0;
    unsigned long last_error_ = 0;

    std::atomic<bool> speaks_itself_ = false;  // it has called alive()
    std::atomic<bool> dropping_ = false;       // a report of dropped events waits: more of them need none of their own

    Delivery delivery_;  // last: its thread ends first
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
