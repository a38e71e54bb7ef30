#include "media/server.hpp"

#include "media/asio.hpp"

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>

#include "media/channel.hpp"
#include "media/rtp.hpp"

namespace rois::media {

namespace {

constexpr auto pause_when_full = std::chrono::milliseconds{50};

std::string text_of(std::string const& host, std::uint16_t port) {
    bool const ipv6 = host.find(':') != std::string::npos;
    return (ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

// Returns the loopback address for a server that listens on every address.
std::string reachable(std::string const& host) {
    if (host == "0.0.0.0") return "127.0.0.1";
    return host == "::" ? "::1" : host;
}

class SharedOutlet final : public Outlet {
public:
    SharedOutlet(std::shared_ptr<Channel> channel, std::string address, std::function<void()> closed)
        : channel_{std::move(channel)}, address_{std::move(address)}, closed_{std::move(closed)} {}

    ~SharedOutlet() override {
        channel_->end();
        if (closed_) closed_();
    }
    SharedOutlet(SharedOutlet const&) = delete;
    SharedOutlet& operator=(SharedOutlet const&) = delete;

    std::string const& address() const override { return address_; }
    void hold() override { channel_->hold(); }
    void go_on() override { channel_->go_on(); }
    std::vector<Reception> receptions() override { return channel_->receptions(); }

private:
    std::shared_ptr<Channel> channel_;
    std::string address_;
    std::function<void()> closed_;
};

RtpPackets::Beginning drawn_by_lot() {
    std::random_device random;
    return {.ssrc = random(), .timestamp = random(), .sequence = static_cast<std::uint16_t>(random())};
}

}  // namespace

class Server::Running {
public:
    Running(Settings settings, std::function<std::string()> fresh_id)
        : settings_{std::move(settings)}, fresh_id_{std::move(fresh_id)}, acceptor_{io_.get_executor()} {
        listen();
        thread_ = std::jthread{[this](std::stop_token const& stop) { run(stop); }};
    }

    ~Running() {
        thread_.request_stop();
        io_.stop();
    }
    Running(Running const&) = delete;
    Running& operator=(Running const&) = delete;

    Settings const& settings() const { return settings_; }
    void use(Limits const& limits) {
        asio::post(io_, [this, limits] { settings_.limits = limits; });
    }
    std::string const& url() const { return url_; }

    std::unique_ptr<Outlet> serve(Content content, Flow flow) {
        auto channel = std::make_shared<Channel>(std::move(content));
        if (flow == Flow::held) channel->hold();
        auto const id = fresh_id_();
        directory_->add(id, channel);
        return std::make_unique<SharedOutlet>(std::move(channel), url_ + "/" + id,
                                              [directory = directory_, id] { directory->remove(id); });
    }

    std::unique_ptr<Outlet> send(Tone const& tone, asio::ip::udp::endpoint const& target, Flow flow) {
        auto const beginning = drawn_by_lot();
        auto channel = std::make_shared<Channel>(Sound{tone, Sound::Form::l16});
        if (flow == Flow::held) channel->hold();
        boost::system::error_code error;
        Datagrams socket{io_.get_executor()};
        socket.open(target.protocol(), error);
        if (error) throw std::runtime_error{"cannot send by RTP: " + error.message()};
        auto address = "rtp://" + text_of(target.address().to_string(), target.port()) +
                       ";payload_type=" + std::to_string(payload_type(tone)) + ";ssrc=" + std::to_string(beginning.ssrc);
        asio::co_spawn(io_, send_by_rtp(channel, std::move(socket), target, RtpPackets{tone, beginning}), asio::detached);
        return std::make_unique<SharedOutlet>(std::move(channel), std::move(address), nullptr);
    }

private:
    // An exception that leaves a coroutine, for example because memory is missing, ends one stream. It never ends this thread.
    void run(std::stop_token const& stop) {
        while (!stop.stop_requested()) {
            try {
                if (!accepts_) asio::co_spawn(io_, accept(), asio::detached);
                io_.run();
            } catch (std::exception const&) {
                std::this_thread::sleep_for(pause_when_full);
            }
            if (!stop.stop_requested()) io_.restart();
        }
    }

    void listen() {
        try {
            asio::ip::basic_resolver<asio::ip::tcp, Executor> resolver{acceptor_.get_executor()};
            auto const found = resolver.resolve(settings_.host, std::to_string(settings_.port), asio::ip::resolver_base::passive);
            auto const endpoint = found.begin()->endpoint();
            acceptor_.open(endpoint.protocol());
            acceptor_.set_option(asio::socket_base::reuse_address{true});
            acceptor_.bind(endpoint);
            acceptor_.listen();
            auto const port = acceptor_.local_endpoint().port();
            auto const* const scheme = settings_.credentials ? "https://" : "http://";
            url_ = settings_.url.empty() ? scheme + text_of(reachable(settings_.host), port) : settings_.url;
            while (url_.ends_with('/')) url_.pop_back();
        } catch (boost::system::system_error const& error) {
            throw std::runtime_error{"cannot serve media on " + text_of(settings_.host, settings_.port) + ": " +
                                     error.code().message()};
        }
    }

    // The handler is not called if `co_spawn` throws.
    void begin_to_serve(Socket socket) {
        ++connections_;
        try {
            asio::co_spawn(io_, serve_receiver(std::move(socket), *directory_, settings_),
                           [this](std::exception_ptr const&) { --connections_; });
        } catch (...) {
            --connections_;
            throw;
        }
    }

    // Connections beyond the limit wait until another one closes.
    Task<> accept() {
        struct End {
            Running& of;
            ~End() {
                of.accepts_ = false;
                of.io_.stop();  // `run` restarts it
            }
        } const end{*this};
        accepts_ = true;
        Timer pause{acceptor_.get_executor()};
        while (true) {
            boost::system::error_code error;
            if (connections_ < settings_.limits.max_connections) {
                auto socket = co_await acceptor_.async_accept(into(error));
                if (!error) {
                    begin_to_serve(std::move(socket));
                    continue;
                }
            }
            pause.expires_after(pause_when_full);
            co_await pause.async_wait(into(error));
        }
    }

    Settings settings_;  // the thread of `io_` changes and reads the limits
    std::function<std::string()> fresh_id_;
    std::shared_ptr<Directory> const directory_ = std::make_shared<Directory>();
    std::string url_;
    std::size_t connections_ = 0;
    bool accepts_ = false;  // `accept` goes on
    asio::io_context io_{1};
    Acceptor acceptor_;
    std::jthread thread_;
};

Server::Server(Settings settings, std::function<std::string()> fresh_id)
    : running_{std::make_unique<Running>(std::move(settings), std::move(fresh_id))} {}

Server::~Server() = default;

std::string const& Server::url() const { return running_->url(); }

void Server::use(Limits const& limits) { running_->use(limits); }

std::unique_ptr<Outlet> Server::serve(Content content, Flow flow) { return running_->serve(std::move(content), flow); }

std::optional<std::string> Server::rtp_refusal(std::string_view target) const {
    auto const endpoint = rtp_target(target);
    if (!endpoint)
        return "'" + std::string{target} + "' is not an RTP target: expected rtp://HOST:PORT with a numeric address or localhost";
    if (running_->settings().rtp_targets == RtpTargets::loopback && !endpoint->address().is_loopback())
        return "the RTP target '" + std::string{target} +
               "' is not a loopback address; the key media_rtp with the value any allows all addresses";
    return {};
}

std::unique_ptr<Outlet> Server::send(Tone const& tone, std::string_view rtp_target, Flow flow) {
    if (auto const problem = rtp_refusal(rtp_target)) throw std::runtime_error{*problem};
    return running_->send(tone, *media::rtp_target(rtp_target), flow);
}

}  // namespace rois::media
