// The sessions of logical components, in which they use their members as applications do (docs/choosing.md).
#include <utility>

#include "engine/core.hpp"

namespace rois {

namespace {

// An operation of a logical component. The answer is a call to the component.
class OwnOperation final : public Asked {
public:
    OwnOperation(Session const& session, OperationAsked&& asked)
        : Asked{session.notifications, 0},
          operation_{std::move(asked.operation)},
          then_{std::move(asked.then)},
          owner_{session.owner->hosted().shared_from_this()} {}

    Operation const& operation() const override { return operation_; }
    void answer(Reply&& reply) override { call(std::make_shared<Reply>(std::move(reply))); }
    void refuse(Refusal) override { call(nullptr); }

private:
    // Without memory for the call the component is halted (Executor::repair), which ends the commands that wait for the answer.
    void call(std::shared_ptr<Reply const> reply) {
        try {
            owner_->call([then = std::move(then_), reply = std::move(reply)](Component&) { then(reply.get()); });
        } catch (...) {
            owner_->lose_report();
            throw;
        }
    }

    Operation const operation_;
    OperationAsked::Then then_;
    std::shared_ptr<HostedComponent> const owner_;
};

}  // namespace

// Returns the session of a logical component; opens it if necessary. The engine expects no signs of life in it: if the
// application gives none, the engine suspends or halts the logical component, which does the same with its members.
Session& Engine::Core::own_session(RegisteredComponent& component, Instant now) {
    if (component.own_session != nullptr) return *component.own_session;
    auto session = std::make_unique<Session>(MotionLease::Terms{settings_.motion_lease, settings_.motion_lease_http}, now.steady);
    session->window = settings_.resume_window;
    session->is_engine = true;
    session->owner = component.shared_from_this();
    session->lease.opened(LinkKind::stream, now.steady);
    component.hosted().call([now](Component& owner) { owner.session_began(now); });
    component.own_session = &open(std::move(session), now);
    return *component.own_session;
}

// Releases the members of a logical component that no session has bound. Normally the component does so. But memory may be
// missing, or a `bind` was answered late.
void Engine::Core::free_members(RegisteredComponent const& component, Instant now) {
    auto* session = component.own_session;
    if (session == nullptr || component.bound_to != nullptr || component.halting || component.binds_asked > 0) return;
    while (!session->bound.empty()) {
        auto& member = **session->bound.begin();
        component.hosted().call([ref = member.ref().code](Component& owner) { owner.member_freed(ref); });
        executor_.release(*session, member, now);
        unbind(*session, member, now);
    }
}

// A component that leaves may still ask, because its provider runs on another thread. It gets no answer.
void Engine::Core::perform(RegisteredComponent& component, OperationAsked&& asked, Instant now) {
    if (registry_.find(component.ref().code) != &component) return;
    auto const& session = own_session(component, now);
    take(std::make_shared<OwnOperation>(session, std::move(asked)), now);
}

// Logical components learn a new status at once, so that the next command does not choose a member that is lost.
void Engine::Core::notify_owners(RegisteredComponent const& member, Instant now) {
    for (auto* logical : registry_.logical()) {
        auto const& refs = logical->members();
        auto* session = logical->own_session;
        bool const is_concerned = std::ranges::find(refs, member.ref().code) != refs.end();
        if (is_concerned && session != nullptr && !session->ending) notify_of_state(*session, member, now);
    }
}

// Calls the logical components with the notifications of their sessions.
void Engine::Core::call_owners(Instant now) {
    constexpr std::size_t most = 1'000;
    if (registry_.logical().empty() || notifier_.pushed() == pushed_at_last_call_) return;
    auto const pushed = notifier_.pushed();
    for (auto* component : registry_.logical()) {
        auto* session = component->own_session;
        if (session == nullptr) continue;
        for (auto next = NotificationQueue::Next::more; next == NotificationQueue::Next::more;) {
            std::vector<Numbered> read;
            next = session->notifications->read(session->delivered, most, read);
            if (read.empty()) break;
            auto const last = read.back().sequence;
            component->hosted().call([now, read = std::move(read)](Component& owner) {
                for (auto const& each : read) owner.notified(each.notification->body, now);
            });
            session->delivered = last;
        }
    }
    pushed_at_last_call_ = pushed;
}

// A client that sees the present members may still not know one that has left.
bool Engine::Core::hides_members(Session const& asker, std::string const& ref) const {
    auto const* const rights = asker.rights.get();
    if (may_see_everything(rights) || may_command(rights, ref)) return false;
    auto const* const component = registry_.find(ref);
    return component == nullptr || component->is_logical();  // null: it has gone, and was perhaps a logical one
}

// Notifies the session that has agreed on switching, and those that receive all switches.
void Engine::Core::publish(RegisteredComponent const& component, MemberSwitched&& switched) {
    auto const notification = std::make_shared<OutgoingNotification const>(
        Switched{component.ref(), switched.from, switched.to, std::move(switched.reason)});
    for (auto const& [id, session] : sessions_) {
        bool const agreed = component.bound_to == session.get() && component.switching != Switching::none;
        auto const* rights = session->rights.get();
        auto const& ref = component.ref().code;
        bool const sees_members = may_see(rights, switched.from) && may_see(rights, switched.to);
        bool const sees = may_command(rights, ref) || (may_see(rights, ref) && sees_members);
        if (agreed || (session->receives_switches && sees))
            notifier_.notify(*session, notification, component.answer_to(*session));
    }
}

}  // namespace rois
