// An engine that lets its components work at once, on the test's thread: when a call returns, its consequences have been handled.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

#include "engine/attempts.hpp"
#include "engine/engine.hpp"
#include "engine/memory_journal.hpp"

namespace rois {

using Said = std::variant<Reply, Refusal>;

// An operation of a test, and its answer once there is one.
class TestedOperation final : public Asked {
public:
    TestedOperation(std::shared_ptr<NotificationQueue> from, Operation operation, std::shared_ptr<Rights const> of_client)
        : Asked{std::move(from), 0, std::move(of_client)}, operation_{std::move(operation)} {}

    Operation const& operation() const override { return operation_; }
    void answer(Reply&& reply) override { note(std::move(reply)); }
    void refuse(Refusal refusal) override { note(refusal); }

    std::optional<Said> said;

private:
    void note(Said answer) {
        if (said) throw std::logic_error("an operation was answered twice");
        said = std::move(answer);
    }

    Operation operation_;
};

class WorkingEngine : public Engine {
public:
    using Engine::Engine;

    // The journal must outlive the engine.
    void keep_in(MemoryJournal& journal) {
        journal_ = &journal;
        Engine::keep_in(journal);
    }

    // The answer may come later.
    std::shared_ptr<TestedOperation> begin_to_handle(SessionId const& session, Operation const& operation, Instant now,
                                                     std::shared_ptr<Rights const> const& rights = nullptr) {
        auto asked = std::make_shared<TestedOperation>(notifications(session, rights.get()), operation, rights);
        and_work([&] { handle(asked, now); }, now);
        return asked;
    }

    Said answer_of(SessionId const& session, Operation const& operation, Instant now) {
        auto const asked = begin_to_handle(session, operation, now);
        if (!asked->said) throw std::logic_error("the operation was not answered at once");
        return *asked->said;
    }

    void add(std::unique_ptr<Component> component) {
        and_work([&] { Engine::add(std::move(component)); }, {});
    }
    void add(std::shared_ptr<Device> device) { Engine::add(std::move(device), "stage"); }
    std::vector<std::string> change(ComponentChange change, Instant now) {
        std::vector<std::string> left_out;
        and_work([&] { left_out = Engine::change(std::move(change), now); }, now);
        return left_out;
    }
    void begin(Instant now) {
        and_work([&] { Engine::begin(now); }, now, Provider::Runner::clock);
    }
    void tick(Instant now) {
        and_work([&] { Engine::tick(now); }, now, Provider::Runner::clock);
    }
    void end_withdrawn(Instant now) {
        and_work([&] { Engine::end_withdrawn(now); }, now);
    }
    void end(SessionId const& session, Instant now) {
        and_work([&] { Engine::end(session, now); }, now);
    }
    void stop_everything(Instant now) {
        and_work([&] { Engine::stop_everything(now); }, now);
    }
    void shut_down(Instant now) {
        and_work([&] { Engine::shut_down(now); }, now);
    }

    // Works even if `what` throws, as the gateway does.
    template <class What>
    void and_work(What const& what, Instant now, Provider::Runner runner = Provider::Runner::client) {
        Attempts attempts;
        attempts(what);
        std::unique_lock lock{mutex_};
        attempts([&] { work(lock, now, runner); });
        while (journal_ != nullptr && journal_->has_waiting() && journal_->then != MemoryJournal::Then::later) {
            bool const stored = journal_->settle(journal_->then == MemoryJournal::Then::stored);
            attempts([&] { stored ? Engine::stored(now) : Engine::not_stored(now); });
            attempts([&] { work(lock, now, runner); });
        }
        attempts.rethrow();
    }

private:
    MemoryJournal* journal_ = nullptr;
    std::mutex mutex_;
};

}  // namespace rois
