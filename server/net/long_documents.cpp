#include "net/long_documents.hpp"

#include <boost/asio/post.hpp>
#include <exception>
#include <latch>
#include <memory>
#include <utility>

#include "net/wake_up.hpp"

namespace rois::net {

Task<PendingAnswer> LongDocuments::answer(Settings const& settings, Gateway& gateway, SessionId const& session,
                                          std::string_view text, Via via, std::weak_ptr<Waker> waits,
                                          std::shared_ptr<Client> const& client, Wakes& wakes) {
    Executor const executor = co_await asio::this_coro::executor;
    auto const done = std::make_shared<WakeUp>(executor, wakes);
    auto const left = std::make_shared<std::latch>(1);
    PendingAnswer answer;
    std::exception_ptr failed;
    asio::post(thread_, [&, done, left] {
        try {
            auto& reader = reader_.use(settings.document, settings.validation);
            answer = gateway.answer(reader, session, text, via, waits, client);
        } catch (...) {
            failed = std::current_exception();
        }
        left->count_down();
        done->wake();
    });
    // Also after an exception, this coroutine stays until the other thread uses it no longer.
    struct End {
        std::latch& left;
        ~End() { left.wait(); }
    } const end{*left};
    co_await done->wait_until(Steady::max());
    if (failed) std::rethrow_exception(failed);
    co_return answer;
}

}  // namespace rois::net
