#include "remote/joiner.hpp"

#include <stdexcept>
#include <utility>

#include "remote/times.hpp"
#include "types/text/texts.hpp"
#include "xml/validation/joining.hpp"

namespace rois::remote {

// One of the two links. If one fails, both end.
class Joiner::Side : public client::Link::Listener {
public:
    using Listener = client::Link::Listener;
    Side(Joiner& of, std::function<std::shared_ptr<client::Link>(Listener&)> const& link) : of_{of}, link_{link(*this)} {}
    virtual ~Side() = default;

    void open() { link_->open(); }
    void send(std::string_view text) { link_->send(std::make_shared<std::string const>(text)); }
    void cut() { link_->cut(); }

protected:
    Joiner& of_;

private:
    void attached() override {}
    void pinged() override {}
    void failed(std::string const& reason, client::Failure) override { of_.give_up(reason); }

    std::shared_ptr<client::Link> link_;
};

class Joiner::MainEngineLink final : public Side {
public:
    explicit MainEngineLink(Joiner& of)
        : Side{of, [&](Listener& listener) {
                   auto const target = target_of(of.joining_.url);
                   return client::websocket_link(of.loop_, target, of.settings_, listener);
               }} {}

private:
    static client::Target target_of(std::string const& url) {
        auto target = client::read_url(url);
        target.path += "/engines";
        return target;
    }

    void connected() override { send(xml::encode(xml::Join{of_.joining_.name, of_.instance_})); }

    void document(std::string_view text) override {
        if (of_.has_joined_) return of_.own_gateway_->send(text);
        auto const response = xml::read_join_response(text);
        if (!response) return of_.give_up("unexpected answer to join: expected join_response, not " + quoted(text, 200));
        if (response->return_code != ReturnCode::ok) return of_.give_up("it refuses: " + response->reason);
        of_.joined_at_ = std::chrono::steady_clock::now();
        of_.has_joined_ = true;
        of_.window_ = response->window;
        of_.note("joined as " + quoted(of_.joining_.name));
    }
};

class Joiner::OwnGatewayLink final : public Side {
public:
    explicit OwnGatewayLink(Joiner& of)
        : Side{of, [&](Listener& listener) {
                   auto link = client::link_on(of.loop_, of.joining_.own_gateway(), of.settings_, listener);
                   if (!link) throw std::runtime_error{"the system gives this gateway no connection to itself"};
                   return link;
               }} {}

private:
    void connected() override {
        of_.main_engine_ = std::make_shared<MainEngineLink>(of_);
        of_.main_engine_->open();
    }

    void document(std::string_view text) override {
        if (of_.main_engine_) of_.main_engine_->send(text);
    }
};

Joiner::Joiner(client::Loop& loop, Joining joining, std::string instance, std::function<void(std::string const&)> report)
    : loop_{loop}, joining_{std::move(joining)}, instance_{std::move(instance)}, report_{std::move(report)} {
    settings_.ping_interval = ping_interval;
    settings_.token = joining_.token;
    settings_.ca_file = joining_.ca_file;
    settings_.certificate_file = joining_.certificate_file;
}

void Joiner::attempt() {
    if (is_over_) return;
    try {
        own_gateway_ = std::make_shared<OwnGatewayLink>(*this);
        own_gateway_->open();
    } catch (std::runtime_error const& problem) {
        return give_up(problem.what());
    }
    loop_.at(client::from_now(time_for_attempt), [self = shared_from_this(), era = era_] {
        if (self->era_ == era && !self->has_joined_) self->give_up("it did not answer within " + shown(time_for_attempt));
    });
}

// Keeps this object and its links alive while one of them reports that it failed.
void Joiner::give_up(std::string const& reason) {
    auto const self = shared_from_this();
    ++era_;
    auto const now = std::chrono::steady_clock::now();
    // A link that breaks at once may have been refused for its profile: the pause then stays long.
    if (std::exchange(has_joined_, false) && now > joined_at_ + time_for_attempt) {
        may_resume_until_ = now + window_;
        failures_ = 0;
    }
    auto const main_engine = std::exchange(main_engine_, nullptr);
    auto const own_gateway = std::exchange(own_gateway_, nullptr);
    if (main_engine) main_engine->cut();
    if (own_gateway) own_gateway->cut();
    if (is_over_) return;
    note(reason);
    auto const pause = now < may_resume_until_ ? pause_within_window : pause_after(failures_++);
    loop_.at(client::from_now(pause), [self, main_engine, own_gateway, era = era_] {
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
