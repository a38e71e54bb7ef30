#include "remote/remote_engines.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>

#include "core/loop.hpp"
#include "remote/join_acceptor.hpp"
#include "remote/joiner.hpp"
#include "remote/rate_limit.hpp"
#include "remote/remote_engine.hpp"
#include "remote/times.hpp"
#include "types/text/texts.hpp"

namespace rois::remote {

namespace {

using namespace std::chrono_literals;

constexpr auto longest_pause_of_clock = 500ms;

class Pulse final : public Device {
public:
    void advance(Instant now) override { last_.store(now.steady, std::memory_order_relaxed); }
    bool beats(Steady now) const { return now - last_.load(std::memory_order_relaxed) < longest_pause_of_clock; }

private:
    std::atomic<Steady> last_ = Steady{};
};

}  // namespace

// All members are used on the thread of the links, except `post`, `states`, and `pulse_` itself.
class RemoteEngines::Links final : public RemoteEngineHost, public std::enable_shared_from_this<Links> {
public:
    explicit Links(Host host) : host_{std::move(host)} {}

    void start() {
        loop_.start(shared_from_this(), [this] { recover(); });
    }
    void stop() {
        post([this] {
            set({});
            acceptor_->close();
            if (joiner_) joiner_->end();
            loop_.finish();
        });
        loop_.join();
    }
    std::shared_ptr<Device> pulse() const { return pulse_; }

    void set(std::vector<SubEngine> const& wanted) {
        auto const stays = [&](RemoteEngine const& engine) {
            return std::ranges::find(wanted, engine.settings()) != wanted.end();
        };
        for (auto const& [name, engine] : std::exchange(engines_, {})) {
            if (stays(*engine))
                engines_.emplace(name, engine);
            else
                end(*engine);
        }
        for (auto const& each : wanted) {
            auto& engine = engines_[each.name];
            if (engine) continue;
            engine = std::make_shared<RemoteEngine>(each, shared_from_this());
            engine->begin();
        }
    }

    void everything_stopped(bool is_stopped) {
        everything_is_stopped_ = is_stopped;
        for (auto const& [name, engine] : engines_) is_stopped ? engine->ask_to_stop() : engine->clear_stop();
    }

    void accept(UniqueDescriptor&& socket, std::string head, JoinAcceptor::MayJoin may_join) {
        acceptor_->open(std::move(socket), std::move(head), std::move(may_join));
    }

    void trouble(std::string const& name, std::string const& what) {
        auto const found = engines_.find(name);
        if (found != engines_.end()) found->second->note(what);
    }

    // Any thread.
    std::vector<EngineState> states() const {
        std::lock_guard const lock{states_mutex_};
        std::vector<EngineState> all;
        all.reserve(states_.size());
        for (auto const& [name, state] : states_) all.push_back(state);
        return all;
    }

    void join(Joining joining) {
        auto const name = "engine " + joining.url;
        joiner_ = std::make_shared<Joiner>(loop_, std::move(joining), host_.instance,
                                           [this, name](std::string const& what) { host_.report(name, what); });
        joiner_->begin();
    }

    void post(std::function<void()> what) override { loop_.post(std::move(what)); }

private:
    Steady now() const override { return std::chrono::steady_clock::now(); }
    std::string const& own_name() const override { return host_.name; }
    void at(Steady when, std::function<void()> ring) override { loop_.at(when, std::move(ring)); }

    std::shared_ptr<client::Link> link(SubEngine const& to, client::Link::Listener& listener) override {
        if (to.url.empty()) return nullptr;
        auto& settings = settings_[to.name];
        settings.url = to.url;
        settings.token = to.token;
        settings.ca_file = to.ca_file;
        settings.certificate_file = to.certificate_file;
        settings.ping_interval = ping_interval;
        settings.longest_document = largest_document;
        return client::websocket_link(loop_, client::read_url(to.url, to.token), settings, listener);
    }

    std::vector<std::string> change(ComponentChange change) override { return host_.change(std::move(change)); }
    Engine::EarlierSession earlier_session(std::string const& sub_engine) override { return host_.earlier_session(sub_engine); }
    void session_opened(std::string const& sub_engine, SessionId const& id, std::function<void()> then) override {
        host_.session_opened(sub_engine, id, std::move(then));
    }
    void stopped_there(std::string const& sub_engine, std::optional<std::uint64_t> stop) override {
        host_.stopped_there(sub_engine, stop);
    }
    void commands_ended(std::string const& sub_engine, std::vector<CommandEnded> ended) override {
        host_.commands_ended(sub_engine, std::move(ended));
    }
    void report(std::string const& sub_engine, std::string const& what) override {
        host_.report("sub engine " + sub_engine, what);
    }
    void show(EngineState const& state) override {
        std::lock_guard const lock{states_mutex_};
        states_[state.name] = state;
    }
    bool everything_is_stopped() const override { return everything_is_stopped_; }
    bool is_alive() const override { return pulse_->beats(now()); }

    std::optional<std::string> why_loop(SubEngine const& sub_engine, std::vector<std::string> const& instances) override {
        bool const is_engine_here = sub_engine.engine.empty();
        for (auto const& instance : instances) {
            if (instance == host_.instance) return "it has this engine as a sub engine: that would be a loop";
            for (auto const& [other, known] : instances_)
                if (is_engine_here && other != sub_engine.name && std::ranges::find(known, instance) != known.end())
                    return "the sub engine " + quoted(other) + " is the same engine, or has it";
        }
        instances_[sub_engine.name] = is_engine_here ? instances : std::vector<std::string>{};
        return {};
    }

    // An engine keeps its name while its link is open. Only the same instance may replace the link.
    std::variant<std::shared_ptr<RemoteEngine>, std::string> joining(xml::Join const& join,
                                                                     JoinAcceptor::MayJoin const& may_join) {
        auto const found =
            std::ranges::find_if(engines_, [&](auto const& each) { return each.second->settings().joins == join.name; });
        if (join.name.empty() || found == engines_.end() || !may_join(found->first))
            return "unknown name " + quoted(join.name) +
                   ": expected the \"joins\" of an entry in the engines file, which the token allows";
        auto& [instance, often] = joined_[join.name];
        if (found->second->has_link() && instance != join.instance) return "another engine has joined as " + quoted(join.name);
        if (often.is_exceeded(now())) return quoted(join.name) + " joins too often: expected at most once a second";
        often.count();
        instance = join.instance;
        return found->second;
    }

    // Reports a refusal, unless the last engine that came by this name was refused for the same reason.
    void note_join(std::string const& name, std::string const& refusal) {
        auto& last = last_refusals_[joined_.contains(name) ? name : std::string{}];
        if (!refusal.empty() && last != refusal) host_.report("an engine that joins", "refused: " + refusal);
        last = refusal;
    }

    // An exception has left a handler of this thread, for example because memory is missing. It may have interrupted any of them.
    void recover() {
        for (auto const& [name, engine] : engines_) engine->recover();
        acceptor_->close();
        if (joiner_) joiner_->recover();
    }

    void end(RemoteEngine& engine) {
        engine.end();
        std::lock_guard const lock{states_mutex_};
        states_.erase(engine.settings().name);
    }

    Host const host_;
    client::Loop loop_;
    mutable std::mutex states_mutex_;
    std::map<std::string, EngineState> states_;  // guarded by states_mutex_
    std::shared_ptr<Pulse> const pulse_ = std::make_shared<Pulse>();
    std::map<std::string, std::shared_ptr<RemoteEngine>> engines_;
    bool everything_is_stopped_ = false;
    std::map<std::string, Settings> settings_;  // of the links, which refer to them
    std::map<std::string, std::vector<std::string>> instances_;
    struct Joined {
        std::string instance;    // the last one
        RateLimit often{10, 1};  // how often an engine may join
    };
    std::map<std::string, Joined> joined_;              // by name
    std::map<std::string, std::string> last_refusals_;  // by name; "": all unknown names
    std::shared_ptr<JoinAcceptor> const acceptor_ = std::make_shared<JoinAcceptor>(
        loop_, host_.schemas, [this](xml::Join const& join, JoinAcceptor::MayJoin const& may_join) {
            auto found = joining(join, may_join);
            auto const* refusal = std::get_if<std::string>(&found);
            note_join(join.name, refusal == nullptr ? std::string{} : *refusal);
            return found;
        });
    std::shared_ptr<Joiner> joiner_;  // null: this engine joins none
};

RemoteEngines::RemoteEngines(Host const& host)
    : links_{std::make_shared<Links>(host)},
      programs_{
          {.says = [report = host.report](std::string const& name, std::string const& line) { report("program " + name, line); },
           .happens = [links = links_](
                          std::string const& name,
                          std::string const& what) { links->post([links, name, what] { links->trouble(name, what); }); },
           .token = host.token}} {
    links_->start();
}

RemoteEngines::~RemoteEngines() { links_->stop(); }

void RemoteEngines::set(std::vector<SubEngine> wanted, std::string const& url_for_programs) {
    std::vector<Programs::Wanted> programs;
    for (auto const& each : wanted)
        if (!each.command.empty()) programs.push_back({each.name, each.command, each.folder, url_for_programs, each.joins});
    programs_.set(std::move(programs));
    links_->post([links = links_, wanted = std::move(wanted)] { links->set(wanted); });
}

void RemoteEngines::accept(UniqueDescriptor socket, std::string head, std::function<bool(std::string const&)> may_join) {
    auto shared = std::make_shared<UniqueDescriptor>(std::move(socket));  // std::function must be copyable
    links_->post([links = links_, shared, head = std::move(head), may_join = std::move(may_join)] {
        links->accept(std::move(*shared), head, may_join);
    });
}

bool is_in_the_clear(std::string const& url) { return client::is_in_the_clear(client::read_url(url)); }

void RemoteEngines::join(Joining joining) {
    client::read_url(joining.url, joining.token);
    links_->post([links = links_, joining = std::move(joining)] { links->join(joining); });
}

void RemoteEngines::everything_stopped(bool is_stopped) {
    links_->post([links = links_, is_stopped] { links->everything_stopped(is_stopped); });
}

std::vector<EngineState> RemoteEngines::states() const { return links_->states(); }

std::shared_ptr<Device> RemoteEngines::pulse() const { return links_->pulse(); }

}  // namespace rois::remote
