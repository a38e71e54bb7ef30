#include "remote/two_engines.hpp"

#include <algorithm>
#include <deque>
#include <map>

#include "files/files.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

namespace {

std::shared_ptr<xml::Schemas const> schemas() {
    static xml::Platform const platform;
    static auto const all = std::make_shared<xml::Schemas const>(files::schemas());
    return all;
}

}  // namespace

// The hall's end of the link does what the network layer does.
class TwoEngines::Wire final : public client::Link {
public:
    Wire(TwoEngines& engines, Listener& listener) : Link{listener}, engines_{engines} {}

    void open() override { opening_ = true; }
    void send(Document document) override { to_hall_.push_back(std::move(document)); }
    void attach(SessionId const& session, std::uint64_t last_sequence) override {
        send(client::document_of({Resume{session, last_sequence}, "resume"}));
    }
    void cut() override {
        listener_ = nullptr;
        close();
    }
    void pause() override { is_paused_ = true; }
    void go_on() override { is_paused_ = false; }
    bool is_paused() const { return is_paused_; }
    void answer_pings() {
        if (!session_.text.empty()) engines_.hall.engine->note_pong(session_, engines_.hall.now);
    }
    void inject(std::string const& document) {
        engines_.on_links([&] { listener_->document(document); });
    }
    std::uint64_t next_sequence() { return after_ + 1'000'000 + ++injected_; }
    void broke(client::Failure failure) {
        close();
        engines_.on_links([&] { fail("the link broke", failure); });
    }
    void reverse_answers() { std::ranges::reverse(waiting_); }
    bool is_dead() const { return listener_ == nullptr; }

    // Takes one step. Returns false if there is nothing to do.
    bool deliver() {
        if (std::exchange(opening_, false)) {
            engines_.on_links([&] {
                if (engines_.is_broken_)
                    fail("cannot be reached", client::Failure::passing);
                else
                    listener_->connected();
            });
            return true;
        }
        if (!to_hall_.empty()) {
            auto const document = to_hall_.front();
            to_hall_.pop_front();
            perform(*document);
            return true;
        }
        if (engines_.is_held_back_) return false;
        if (!waiting_.empty() && waiting_.front().second->said) {
            auto const [id, operation] = waiting_.front();
            waiting_.pop_front();
            answer(id, *operation);
            return true;
        }
        if (!session_.text.empty() && reads_ && !is_paused_)
            for (auto const& [sequence, notification] : reads_->read(after_, 1)) {
                after_ = sequence;
                inject(std::string{xml::notification_head(notification->body)} + std::to_string(sequence) +
                       xml::notification_tail(notification->body));
                return true;
            }
        return false;
    }

private:
    void perform(std::string const& document) {
        auto const read = reader_.read(document);
        ASSERT_TRUE(std::holds_alternative<Request>(read)) << document << std::get<Fault>(read).reason;
        auto const& [operation, id] = std::get<Request>(read);
        auto const name = document.substr(1, document.find(' ') - 1);
        engines_.asked_.push_back(name);
        if (name == engines_.not_allowed)
            return inject(xml::encode(Fault{FaultCode::not_allowed, "the token may not " + name, {}, id}));
        // A link whose session has ended opens another one.
        if (std::holds_alternative<Connect>(operation) && reads_ && reads_->closed()) session_ = {};
        auto const& session = std::holds_alternative<Resume>(operation) ? std::get<Resume>(operation).session : session_;
        waiting_.emplace_back(id, engines_.hall.begin_to_say(session, operation));
    }

    void answer(std::string const& id, TestedOperation const& operation) {
        if (auto const* refusal = std::get_if<Refusal>(&*operation.said)) {
            Fault fault{*refusal == Refusal::no_session ? FaultCode::no_session : FaultCode::too_many, "refused", {}, id};
            return inject(xml::encode(fault));
        }
        auto const& reply = std::get<Reply>(*operation.said);
        if (auto const* connected = std::get_if<Connect::Reply>(&reply); connected != nullptr && session_.text.empty())
            join(connected->session, 0);
        auto const* resume = std::get_if<Resume>(&operation.operation());
        if (resume != nullptr && std::get<Resume::Reply>(reply).return_code == ReturnCode::ok)
            join(resume->session, resume->last_sequence);
        if (std::holds_alternative<Disconnect::Reply>(reply)) session_ = {};
        auto sent = reply;
        engines_.falsify(sent);
        inject(xml::encode(sent, id));
    }

    void join(SessionId const& session, std::uint64_t after) {
        session_ = session;
        after_ = after;
        reads_ = engines_.hall.engine->notifications(session);
        engines_.hall.engine->link_opened(session, LinkKind::websocket, engines_.hall.now);
    }

    void close() {
        if (session_.text.empty()) return;
        engines_.hall.engine->link_closed(session_, LinkKind::websocket, Closing::lost, engines_.hall.now);
        session_ = {};
    }

    TwoEngines& engines_;
    xml::RequestReader reader_{schemas()};
    bool opening_ = false;
    std::deque<Document> to_hall_;
    std::deque<std::pair<std::string, std::shared_ptr<TestedOperation>>> waiting_;
    SessionId session_;
    std::uint64_t after_ = 0;
    std::uint64_t injected_ = 0;
    bool is_paused_ = false;
    std::shared_ptr<NotificationQueue> reads_;
};

class TwoEngines::Host final : public remote::RemoteEngineHost {
public:
    explicit Host(TwoEngines& engines) : engines_{engines} {}

    Steady now() const override { return engines_.main.now.steady; }
    void at(Steady when, std::function<void()> ring) override { alarms_.emplace(when, std::move(ring)); }
    void post(std::function<void()> what) override { posted_.push_back(std::move(what)); }
    std::shared_ptr<client::Link> link(remote::SubEngine const&, client::Link::Listener& listener) override {
        return engines_.link_for(listener);
    }
    std::vector<std::string> change(ComponentChange change) override {
        return engines_.main.engine->change(std::move(change), engines_.main.now);
    }
    Engine::EarlierSession earlier_session(std::string const& name) override {
        return engines_.main.engine->earlier_session(name);
    }
    void session_opened(std::string const& name, SessionId const& id, std::function<void()> then) override {
        auto& engine = *engines_.main.engine;
        engine.and_work(
            [&] {
                engine.session_opened_there(name, id);
                engine.when_stored(std::move(then));
            },
            engines_.main.now);
    }
    void stopped_there(std::string const& name, std::optional<std::uint64_t> stop) override {
        auto& engine = *engines_.main.engine;
        engine.and_work([&] { engine.stopped_there(name, stop); }, engines_.main.now);
    }
    void commands_ended(std::string const& name, std::vector<CommandEnded> ended) override {
        auto& engine = *engines_.main.engine;
        engine.and_work([&] { engine.ended_there(name, std::move(ended), engines_.main.now); }, engines_.main.now);
    }
    std::string const& own_name() const override { return name_; }
    std::optional<std::string> why_loop(remote::SubEngine const&, std::vector<std::string> const& instances) override {
        if (std::ranges::find(instances, engines_.instance_of_main) == instances.end()) return {};
        return "that would be a loop";
    }
    bool everything_is_stopped() const override { return is_stopped; }
    bool is_alive() const override { return engines_.main_is_alive; }
    void report(std::string const&, std::string const& what) override { engines_.reported.push_back(what); }
    void show(EngineState const& state) override { engines_.shown = state; }

    // Takes one step. Returns false if there is nothing to do.
    bool run() {
        if (posted_.empty() && (alarms_.empty() || alarms_.begin()->first > now())) return false;
        std::function<void()> next;
        if (!posted_.empty()) {
            next = std::move(posted_.front());
            posted_.pop_front();
        } else {
            next = std::move(alarms_.extract(alarms_.begin()).mapped());
        }
        engines_.on_links(next);
        return true;
    }
    bool is_stopped = false;
    void drop() {
        posted_.clear();
        alarms_.clear();
    }

private:
    TwoEngines& engines_;
    std::string const name_ = "main";
    std::deque<std::function<void()>> posted_;
    std::multimap<Steady, std::function<void()>> alarms_;
};

remote::SubEngine TwoEngines::hall_settings() {
    remote::SubEngine settings;
    settings.name = "hall";
    settings.url = "ws://hall";
    return settings;
}

TwoEngines::TwoEngines(std::vector<Part> const& parts, remote::SubEngine settings, Places const& of_hall,
                       std::vector<NamedPlace> const& places_of_main, std::vector<Part> const& parts_of_main)
    : main{parts_of_main, {}},
      hall{parts, {}},
      parts_{parts},
      parts_of_main_{parts_of_main},
      settings_{std::move(settings)},
      host_{std::make_shared<Host>(*this)} {
    if (!of_hall.frames.own().empty()) {
        main.engine->describe({.frames = {"here"}, .all = places_of_main});
        hall.engine->describe(of_hall);
    }
    begin_main();
}

void TwoEngines::begin_main() {
    remote_ = std::make_shared<remote::RemoteEngine>(settings_, host_);
    main.engine->on_stop([this](bool is_stopped) {
        remote_->run([this, is_stopped](auto& engine) {
            host_->is_stopped = is_stopped;
            is_stopped ? engine.ask_to_stop() : engine.clear_stop();
        });
    });
    host_->is_stopped = main.engine->everything_is_stopped();
    remote_->begin();
    advance(100ms);
}

TwoEngines::~TwoEngines() {
    remote_->end();  // drops the questions that are not answered, which refer to it
    host_->drop();
    if (wire_) wire_->cut();
}

std::shared_ptr<client::Link> TwoEngines::link_for(client::Link::Listener& listener) {
    ++links;
    return wire_ = std::make_shared<Wire>(*this, listener);
}

bool TwoEngines::is_paused() const { return wire_ && wire_->is_paused(); }

void TwoEngines::receive_without_main() {
    while (host_->run() || deliver()) {
    }
}

void TwoEngines::settle() {
    auto const work = [](World& world) { world.engine->and_work([] {}, world.now); };
    bool goes_on = true;
    while (goes_on) {
        goes_on = host_->run() || deliver();
        work(main);
        work(hall);
    }
}

bool TwoEngines::deliver() {
    if (!wire_ || wire_->is_dead()) return false;
    if (until_cut_ == 0) {
        until_cut_.reset();
        cut();
        return true;
    }
    if (!wire_->deliver()) return false;
    if (until_cut_) --*until_cut_;
    return true;
}

void TwoEngines::advance(std::chrono::milliseconds time) {
    for (auto passed = 0ms; passed < time; passed += 50ms) {
        if (main_is_alive)
            main.advance(50ms);
        else
            main.now = {main.now.steady + 50ms, main.now.utc + 50ms};
        hall.advance(50ms);
        if (wire_ && !wire_->is_dead() && main_answers_pings) wire_->answer_pings();
        settle();
    }
}

Reply TwoEngines::ask(Application const& by, Operation const& operation) {
    auto const asked = main.begin_to_say(by.session, operation);
    settle();
    for (int i = 0; i < 40 && !asked->said; ++i) advance(50ms);
    return std::get<Reply>(asked->said.value());
}

void TwoEngines::reverse_answers() { wire_->reverse_answers(); }

void TwoEngines::inject(std::string const& document) {
    wire_->inject(document);
    settle();
}

void TwoEngines::inject(Notification const& notification) {
    inject(std::string{xml::notification_head(notification)} + std::to_string(wire_->next_sequence()) +
           xml::notification_tail(notification));
}

void TwoEngines::cut(client::Failure failure) {
    is_broken_ = true;
    if (wire_ && !wire_->is_dead()) wire_->broke(failure);
}

void TwoEngines::restart_hall() {
    cut();
    hall.restart(parts_);
    repair();
}

void TwoEngines::restart_main(std::function<void()> const& meanwhile) {
    main.journal->then = MemoryJournal::Then::later;  // nothing of its end is stored
    cut();
    remote_->end();
    host_->drop();
    meanwhile();
    main.journal->then = MemoryJournal::Then::stored;
    main.restart(parts_of_main_);
    main.engine->begin(main.now);
    repair();
    begin_main();
}

std::vector<std::string> TwoEngines::asked() { return std::exchange(asked_, {}); }

}  // namespace rois
