#include "net/long_documents.hpp"

#include <boost/asio/post.hpp>
#include <exception>
#include <new>
#include <thread>
#include <utility>

namespace rois::net {

namespace {

// Whoever waits would wait for ever.
void post_surely(Executor const& executor, auto const& what) {
    while (true) {
        try {
            return asio::post(executor, what);
        } catch (std::bad_alloc const&) {
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
    }
}

}  // namespace

LongDocuments::LongDocuments(std::shared_ptr<xml::Schemas const> schemas, xml::DocumentLimits const& limits,
                             xml::Validation validation)
    : reader_{std::move(schemas), limits, validation} {}

Task<Answer> LongDocuments::answer(Gateway& gateway, SessionId const& session, std::string_view text, Via via,
                                   std::shared_ptr<Opener> const& opener) {
    Answer answer;
    std::exception_ptr failed;
    auto const read = [&] {
        try {
            answer = gateway.answer(reader_, session, text, via, opener);
        } catch (...) {
            failed = std::current_exception();
        }
    };
    using Token = asio::use_awaitable_t<Executor>;
    Token token;
    co_await asio::async_initiate<Token, void()>(
        [&](auto handler) {
            auto const back = asio::get_associated_executor(handler);
            auto const waiting = std::make_shared<decltype(handler)>(std::move(handler));
            asio::post(thread_, [&read, back, waiting] {
                read();
                post_surely(back, [waiting] { std::move (*waiting)(); });
            });
        },
        token);
    if (failed) std::rethrow_exception(failed);
    co_return answer;
}

}  // namespace rois::net
