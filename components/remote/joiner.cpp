#include "remote/joiner.hpp"

#include <algorithm>
#include <utility>

#include "types/text/texts.hpp"
#include "xml/validation/joining.hpp"

namespace rois::remote {

namespace {

using namespace std::chrono_literals;

constexpr auto time_to_join = 5s;
constexpr auto first_pause = 100ms;
constexpr auto longest_pause = 30s;
constexpr auto ping_interval = 1s;  // two seconds of silence end a link

client::Link::Document document(std::string_view text) { return std::make_shared<std::string const>(text); }

}  // namespace

// Both links end at the first problem of one.
class Joiner::Own final : public client::Link::Listener {
public:
    explicit Own(Joiner& of)
        : of_{of}, link_{client::websocket_link(of.loop_, client::read_url(of.joining_.own_url), of.settings_, *this)} {}

    virtual ~Own() = default;

    void open() { link_->open(); }
    void send(std::string_view text) { link_->send(rois::remote::document(text)); }
    void cut() { link_->cut(); }

private:
    void connected() override;
    void attached() override {}
    void pinged() override {}
    void document(std::string_view) override;
    void failed(std::string const& reason, client::Failure) override { of_.give_up("no link to this gateway: " + reason); }

    Joiner& of_;
    std::shared_ptr<client::Link> link_;
};

class Joiner::There final : public client::Link::Listener {
public:
    explicit There(Joiner& of) : of_{of} {
        auto target = client::read_url(of.joining_.url);
        target.path += "/engines";
        link_ = client::websocket_link(of.loop_, target, of.settings_, *this);
    }

    virtual ~There() = default;

    void open() { link_->open(); }
    void send(std::string_view text) { link_->send(rois::remote::document(text)); }
    void cut() { link_->cut(); }

private:
    void connected() override { send(xml::encode(xml::Join{of_.joining_.name, of_.instance_})); }
    void attached() override {}
    void pinged() override {}
    void failed(std::string const& reason, client::Failure) override { of_.give_up(reason); }

    void document(std::string_view text) override {
        if (of_.has_joined_) return of_.own_->send(text);
        auto const response = xml::read_join_response(text);
        if (!response) return of_.give_up("it does not take engines: " + quoted(text, 200));
        if (response->return_code != ReturnCode::ok) return of_.give_up("it refuses: " + response->reason);
        of_.has_joined_ = true;
        of_.failures_ = 0;
        of_.note("joined as " + quoted(of_.joining_.name));
    }

    Joiner& of_;
    std::shared_ptr<client::Link> link_;
};

void Joiner::Own::connected() {
    of_.there_ = std::make_shared<There>(of_);
    of_.there_->open();
}

void Joiner::Own::document(std::string_view text) {
    if (of_.there_) of_.there_->send(text);
}

Joiner::Joiner(client::Loop& loop, Joining joining, std::string instance, std::function<void(std::string const&)> report)
    : loop_{loop}, joining_{std::move(joining)}, instance_{std::move(instance)}, report_{std::move(report)} {
    settings_.ping_interval = ping_interval;
}

void Joiner::attempt() {
    if (is_over_) return;
    own_ = std::make_shared<Own>(*this);
    own_->open();
    loop_.at(client::from_now(time_to_join), [self = shared_from_this(), era = era_] {
        if (self->era_ == era && !self->has_joined_) self->give_up("it did not answer within 5 s");
    });
}

// Keeps this object and its links alive while one of them reports that it failed.
void Joiner::give_up(std::string const& reason) {
    auto const self = shared_from_this();
    ++era_;
    has_joined_ = false;
    auto const there = std::exchange(there_, nullptr);
    auto const own = std::exchange(own_, nullptr);
    if (there) there->cut();
    if (own) own->cut();
    if (is_over_) return;
    note(reason);
    auto const pause = std::min<std::chrono::milliseconds>(longest_pause, first_pause * (1 << std::min(failures_, 10U)));
    ++failures_;
    loop_.at(client::from_now(pause), [self, there, own, era = era_] {
        if (self->era_ == era) self->attempt();
    });
}

void Joiner::end() {
    is_over_ = true;
    give_up("");
}

// Repeated attempts fail for the same reason: it is logged once.
void Joiner::note(std::string const& what) {
    if (std::exchange(last_note_, what) != what) report_(what);
}

}  // namespace rois::remote
