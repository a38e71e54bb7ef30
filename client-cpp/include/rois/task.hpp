// Task: the coroutine that each operation of the client returns. It runs when it is awaited.
#pragma once

#include <concepts>
#include <coroutine>
#include <exception>
#include <utility>
#include <variant>

namespace rois {

template <class T>
class Task;

namespace detail {

// Resumes the awaiting coroutine when the task has ended.
struct TaskPromiseBase {
    struct Final {
        bool await_ready() const noexcept { return false; }
        template <class Promise>
        std::coroutine_handle<> await_suspend(std::coroutine_handle<Promise> ended) const noexcept {
            return ended.promise().continuation;
        }
        void await_resume() const noexcept {}
    };

    std::suspend_always initial_suspend() const noexcept { return {}; }
    Final final_suspend() const noexcept { return {}; }

    std::coroutine_handle<> continuation = std::noop_coroutine();
};

template <class T>
struct TaskPromise : TaskPromiseBase {
    Task<T> get_return_object();
    template <std::convertible_to<T> Value = T>
    void return_value(Value&& value) {
        result.template emplace<1>(std::forward<Value>(value));
    }
    void unhandled_exception() { result.template emplace<2>(std::current_exception()); }
    T take() {
        if (result.index() == 2) std::rethrow_exception(std::get<2>(result));
        return std::move(std::get<1>(result));
    }

    std::variant<std::monostate, T, std::exception_ptr> result;
};

template <>
struct TaskPromise<void> : TaskPromiseBase {
    Task<void> get_return_object();
    void return_void() const noexcept {}
    void unhandled_exception() { problem = std::current_exception(); }
    void take() const {
        if (problem) std::rethrow_exception(problem);
    }

    std::exception_ptr problem;
};

}  // namespace detail

// A coroutine that returns a T. It starts when it is awaited, which is allowed once; the co_await rethrows its exception. A task
// that is never awaited does nothing. After an operation of a client, the awaiting coroutine continues on the client's thread
// (connection.hpp).
//
// Errors of g++ 12: it destroys an aggregate made in braces inside a co_await twice (`co_await f({.text = "a"})`), and copies a
// temporary that is awaited in place: give such a value a name first. It also drops the code after a co_await in the condition
// of a loop or an if.
template <class T = void>
class [[nodiscard]] Task {
public:
    using promise_type = detail::TaskPromise<T>;
    using Handle = std::coroutine_handle<promise_type>;

    explicit Task(Handle coroutine) : coroutine_{coroutine} {}
    Task(Task&& other) noexcept : coroutine_{std::exchange(other.coroutine_, {})} {}
    Task& operator=(Task&& other) noexcept {
        std::swap(coroutine_, other.coroutine_);
        return *this;
    }
    ~Task() {
        if (coroutine_) coroutine_.destroy();
    }

    class Awaiter {
    public:
        explicit Awaiter(Handle coroutine) : coroutine_{coroutine} {}
        bool await_ready() const noexcept { return false; }
        Handle await_suspend(std::coroutine_handle<> continuation) const noexcept {
            coroutine_.promise().continuation = continuation;
            return coroutine_;
        }
        T await_resume() const { return coroutine_.promise().take(); }

    private:
        Handle coroutine_;
    };

    Awaiter operator co_await() const& noexcept { return Awaiter{coroutine_}; }
    Awaiter operator co_await() const&& noexcept { return Awaiter{coroutine_}; }

private:
    Handle coroutine_;
};

namespace detail {

template <class T>
Task<T> TaskPromise<T>::get_return_object() {
    return Task<T>{std::coroutine_handle<TaskPromise<T>>::from_promise(*this)};
}

inline Task<void> TaskPromise<void>::get_return_object() {
    return Task<void>{std::coroutine_handle<TaskPromise<void>>::from_promise(*this)};
}

}  // namespace detail

}  // namespace rois
