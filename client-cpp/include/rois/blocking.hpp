// A blocking client, for programs without coroutines: each call returns when the operation is done.
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

// Throws std::logic_error if it is called on the client's thread, for example in an observer.
class Blocking {
public:
    explicit Blocking(Settings settings = {}, Observers observers = {}) : client_{std::move(settings), std::move(observers)} {}

    // Waits for any operation of a client, a component or a stream, and returns its result.
    template <class T>
    T operator()(Task<T> task) {
        return client_.wait(std::move(task));
    }

    // Waits for the session. Throws Error if none is open within Settings::connect_deadline.
    void open();

    Component bind(std::string ref, Switching switching = Switching::none) {
        return client_.wait(client_.bind(std::move(ref), switching));
    }
    Component take_over(std::string ref, Switching switching = Switching::none) {
        return client_.wait(client_.take_over(std::move(ref), switching));
    }
    Component bind_any(QueryExpression condition, Switching switching = Switching::none) {
        return client_.wait(client_.bind_any(std::move(condition), switching));
    }
    template <class Facade>
    Facade bind(std::string ref, Switching switching = Switching::none) {
        return client_.wait(client_.bind<Facade>(std::move(ref), switching));
    }
    template <class Facade>
    Facade bind_any(QueryExpression condition = {}, Switching switching = Switching::none) {
        return client_.wait(client_.bind_any<Facade>(std::move(condition), switching));
    }
    std::vector<Identifier> search(QueryExpression condition = {}) { return client_.wait(client_.search(std::move(condition))); }
    Query::Reply query(std::string query_type, QueryExpression condition = {}) {
        return client_.wait(client_.query(std::move(query_type), std::move(condition)));
    }
    template <class E>
    Events<E> events(QueryExpression condition = {}) {
        return client_.wait(client_.events<E>(std::move(condition)));
    }

    // Runs an operation and returns its reply with the return code, as Connection::call does.
    template <class Op>
    typename Op::Reply call(Op operation) {
        return client_.wait(client_.call(std::move(operation)));
    }

    Client& client() { return client_; }

private:
    Client client_;
};

}  // namespace rois
