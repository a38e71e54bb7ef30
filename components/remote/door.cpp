#include "remote/door.hpp"

#include <unistd.h>

#include <utility>

#include "remote/times.hpp"

namespace rois::remote {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t most_guests = 100;
constexpr auto time_to_read_refusal = 1s;

}  // namespace

class Door::Guest final : public client::Link::Listener, public std::enable_shared_from_this<Guest> {
public:
    explicit Guest(std::weak_ptr<Door> at) : at_{std::move(at)} {}
    virtual ~Guest() = default;

    void enter(std::shared_ptr<client::Link> link) {
        link_ = std::move(link);
        link_->open();
        leave_after(time_for_attempt);
    }

    void leave() {
        if (auto const link = std::exchange(link_, nullptr)) link->cut();
        if (auto const door = at_.lock()) door->leave(shared_from_this());
    }

private:
    void connected() override {}
    void attached() override {}
    void pinged() override {}
    void failed(std::string const&, client::Failure) override { leave(); }

    void document(std::string_view text) override {
        auto const self = shared_from_this();
        auto const door = at_.lock();
        if (!door || !link_ || is_refused_) return;
        auto const read = door->reader_.read(text);
        if (auto const* fault = std::get_if<Fault>(&read)) return refuse(xml::encode(*fault));
        auto const found = door->find_(std::get<xml::Join>(read));
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
        auto const door = at_.lock();
        if (!door) return;
        door->loop_.at(client::from_now(time), [guest = weak_from_this()] {
            if (auto const self = guest.lock()) self->leave();
        });
    }

    std::weak_ptr<Door> at_;
    std::shared_ptr<client::Link> link_;  // null: it has joined, or left
    bool is_refused_ = false;
};

Door::Door(client::Loop& loop, std::shared_ptr<xml::Schemas const> schemas, Find find)
    : loop_{loop}, reader_{std::move(schemas)}, find_{std::move(find)} {
    settings_.ping_interval = ping_interval;
    settings_.longest_document = SubEngine{}.longest_document;
}

void Door::open(int socket, std::string head) {
    if (guests_.size() >= most_guests) {
        ::close(socket);
        return;
    }
    auto const guest = std::make_shared<Guest>(weak_from_this());
    auto link = client::accepted_link(loop_, socket, std::move(head), settings_, *guest);
    if (!link) {
        ::close(socket);
        return;
    }
    guests_.insert(guest);
    guest->enter(std::move(link));
}

void Door::close() {
    for (auto const& guest : std::exchange(guests_, {})) guest->leave();
}

void Door::leave(std::shared_ptr<Guest> const& guest) { guests_.erase(guest); }

}  // namespace rois::remote
