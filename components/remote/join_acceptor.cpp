#include "remote/join_acceptor.hpp"

#include <utility>

#include "remote/times.hpp"

namespace rois::remote {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t most_pending_joins = 100;
constexpr auto time_to_read_refusal = 1s;

}  // namespace

class JoinAcceptor::PendingJoin final : public client::Link::Listener, public std::enable_shared_from_this<PendingJoin> {
public:
    PendingJoin(std::weak_ptr<JoinAcceptor> at, MayJoin may_join) : at_{std::move(at)}, may_join_{std::move(may_join)} {}
    virtual ~PendingJoin() = default;

    void enter(std::shared_ptr<client::Link> link) {
        link_ = std::move(link);
        link_->open();
        leave_after(time_for_attempt);
    }

    void leave() {
        if (auto const link = std::exchange(link_, nullptr)) link->cut();
        if (auto const acceptor = at_.lock()) acceptor->leave(shared_from_this());
    }

private:
    void connected() override {}
    void attached() override {}
    void pinged() override {}
    void failed(std::string const&, client::Failure) override { leave(); }

    void document(std::string_view text) override {
        auto const self = shared_from_this();
        auto const acceptor = at_.lock();
        if (!acceptor || !link_ || is_refused_) return;
        auto const read = acceptor->reader_.read(text);
        if (auto const* fault = std::get_if<Fault>(&read)) return refuse(xml::encode(*fault));
        auto const found = acceptor->find_(std::get<xml::Join>(read), may_join_);
        xml::JoinResponse response;
        if (auto const* reason = std::get_if<std::string>(&found)) {
            response.return_code = ReturnCode::bad_parameter;
            response.reason = *reason;
            return refuse(xml::encode(response));
        }
        auto const& engine = std::get<std::shared_ptr<RemoteEngine>>(found);
        response.window = engine->settings().window;
        link_->send(std::make_shared<std::string const>(xml::encode(response)));
        engine->joined(std::exchange(link_, nullptr));
        leave();
    }

    void refuse(std::string document) {
        is_refused_ = true;
        link_->send(std::make_shared<std::string const>(std::move(document)));
        leave_after(time_to_read_refusal);
    }

    void leave_after(std::chrono::milliseconds time) {
        auto const acceptor = at_.lock();
        if (!acceptor) return;
        acceptor->loop_.at(client::from_now(time), [pending = weak_from_this()] {
            if (auto const self = pending.lock()) self->leave();
        });
    }

    std::weak_ptr<JoinAcceptor> at_;
    MayJoin may_join_;
    std::shared_ptr<client::Link> link_;  // null: it has joined, or left
    bool is_refused_ = false;
};

JoinAcceptor::JoinAcceptor(client::Loop& loop, std::shared_ptr<xml::Schemas const> schemas, Find find)
    : loop_{loop}, reader_{std::move(schemas)}, find_{std::move(find)} {
    settings_.ping_interval = ping_interval;
    settings_.longest_document = largest_document;
}

void JoinAcceptor::open(UniqueDescriptor socket, std::string head, MayJoin may_join) {
    if (pending_.size() >= most_pending_joins) return;
    auto const pending = std::make_shared<PendingJoin>(weak_from_this(), std::move(may_join));
    auto link = client::accepted_link(loop_, std::move(socket), std::move(head), settings_, *pending);
    if (!link) return;
    pending_.insert(pending);
    pending->enter(std::move(link));
}

void JoinAcceptor::close() {
    for (auto const& pending : std::exchange(pending_, {})) pending->leave();
}

void JoinAcceptor::leave(std::shared_ptr<PendingJoin> const& pending) { pending_.erase(pending); }

}  // namespace rois::remote
