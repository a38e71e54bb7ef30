#include "rois/connection.hpp"

#include <stdexcept>

#include "core/core.hpp"

namespace rois {

std::string_view to_text(State state) {
    switch (state) {
        case State::connecting:
            return "connecting";
        case State::open:
            return "open";
        case State::lost:
            return "lost";
        case State::resumed:
            return "resumed";
        case State::closed:
            break;
    }
    return "closed";
}

namespace {

Task<std::optional<NoAnswer>> wait_until_open(std::shared_ptr<detail::Core> core, std::chrono::milliseconds within) {
    co_await core->here();
    bool late = false;
    auto const ticket = core->loop().in(within, [&] {
        late = true;
        core->opened.raise();
    });
    while (!core->is_open() && !core->is_closed() && !late) co_await core->opened.raised();
    core->loop().cancel(ticket);
    std::optional<NoAnswer> problem;
    if (core->is_closed()) {
        problem = core->closed();
    } else if (!core->is_open()) {
        auto reason = "no session within " + std::to_string(within.count()) + " ms";
        if (!core->last_reason().empty()) reason += ": " + core->last_reason();
        problem = NoAnswer{NoAnswer::Why::deadline, std::move(reason)};
    }
    co_return problem;
}

Task<std::variant<std::string, NoAnswer>> send_raw(std::shared_ptr<detail::Core> core, std::string document,
                                                   std::chrono::milliseconds deadline) {
    co_await core->here();
    auto const call = core->send(client::Call::Kind::raw, std::move(document), {}, deadline);
    auto& outcome = co_await call->outcome();
    if (auto* const text = std::get_if<std::string>(&outcome)) co_return std::move(*text);
    co_return std::move(std::get<NoAnswer>(std::get<Answer>(outcome)));
}

Task<> sleep_on(std::shared_ptr<detail::Core> core, std::chrono::milliseconds time) {
    co_await core->here();
    co_await core->pass(time);
}

}  // namespace

Connection::Connection(Settings settings, Observers observers)
    : core_{std::make_shared<detail::Core>(std::move(settings), std::move(observers))} {
    core_->start();
}

Connection::~Connection() { core_->destroy(); }

State Connection::state() const { return core_->state(); }

SessionId Connection::session() const { return core_->session(); }

Task<std::optional<NoAnswer>> Connection::opened(std::optional<std::chrono::milliseconds> within) {
    return wait_until_open(core_, within.value_or(core_->settings().connect_deadline));
}

Task<Answer> Connection::request(Request request, std::optional<std::chrono::milliseconds> deadline) {
    return core_->request(std::move(request), deadline.value_or(core_->settings().deadline));
}

Task<std::variant<std::string, NoAnswer>> Connection::send(std::string document,
                                                           std::optional<std::chrono::milliseconds> deadline) {
    return send_raw(core_, std::move(document), deadline.value_or(core_->settings().deadline));
}

Task<> Connection::sleep(std::chrono::milliseconds time) { return sleep_on(core_, time); }

void Connection::alive() { core_->alive(); }

std::chrono::milliseconds Connection::between_signs_of_life() const { return core_->between_signs_of_life(); }

void Connection::close() { core_->close(); }

void Connection::spawn(Task<> task) { core_->spawn(std::move(task)); }

void Connection::check_not_own_thread() const {
    if (core_->loop().is_here())
        throw std::logic_error{"rois: a wait on the client's thread would never end; use co_await there"};
}

}  // namespace rois
