// For simple programs: every operation waits. `Blocking` is a client that is called where coroutines are awaited:
//
//     rois::Blocking robot;
//     auto navigation = robot.bind_any<rois::Navigation>();
//     robot(navigation.go_to("desk"));
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rois/client.hpp"

namespace rois {

// Not to be called on the client's thread, in an observer for instance: there it throws std::logic_error.
class Blocking {
public:
    explicit Blocking(Settings settings = {}, Observers observers = {}) : client_{std::move(settings), std::move(observers)} {}

    // Waits for any operation of a client, a component or a stream, and gives what it gives.
    template <class T>
    T operator()(Task<T> task) {
        return client_.wait(std::move(task));
    }

    // Throws Error when there is no session within the settings' connect_deadline.
    void open();

    Component bind(std::string ref) { return client_.wait(client_.bind(std::move(ref))); }
    Component bind_any(QueryExpression condition) { return client_.wait(client_.bind_any(std::move(condition))); }
    template <class Facade>
    Facade bind(std::string ref) {
        return client_.wait(client_.bind<Facade>(std::move(ref)));
    }
    template <class Facade>
    Facade bind_any(QueryExpression condition = {}) {
        return client_.wait(client_.bind_any<Facade>(std::move(condition)));
    }
    std::vector<Identifier> search(QueryExpression condition = {}) { return client_.wait(client_.search(std::move(condition))); }
    Query::Reply query(std::string query_type, QueryExpression condition = {}) {
        return client_.wait(client_.query(std::move(query_type), std::move(condition)));
    }
    template <class E>
    Events<E> events(QueryExpression condition = {}) {
        return client_.wait(client_.events<E>(std::move(condition)));
    }

    // An operation with its return code as a value.
    template <class Op>
    typename Op::Reply call(Op operation) {
        return client_.wait(client_.call(std::move(operation)));
    }

    Client& client() { return client_; }

private:
    Client client_;
};

}  // namespace rois
