// Two engines and the link between them, on one thread and with one clock: `hall` is a sub engine of `main`. All documents are
// encoded and read as on a real link.
//     TwoEngines engines{{navigation}};
//     auto desk = engines.main.connect();
//     desk.bind("hall.navigation");
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/world.hpp"
#include "remote/remote_engine.hpp"
#include "xml/codec/codec.hpp"

namespace rois {

class TwoEngines final {
public:
    // `of_hall`: the hall's frames and places; its own frame is "crs1", as in its profile. The main engine's frame is then
    // "here". Empty: neither has a frame.
    explicit TwoEngines(std::vector<Part> const& parts, remote::SubEngine settings = hall_settings(), Places const& of_hall = {},
                        std::vector<NamedPlace> const& places_of_main = {}, std::vector<Part> const& parts_of_main = {});
    ~TwoEngines();

    static remote::SubEngine hall_settings();

    World main;
    World hall;

    // Both clocks go on, in steps of 50 ms.
    void advance(std::chrono::milliseconds);
    // Delivers documents until none is under way.
    void settle();
    // Delivers documents, but the main engine handles none.
    void receive_without_main();
    // Returns whether the main engine has stopped reading.
    bool is_paused() const;

    // Performs an operation at the main engine, and delivers its documents.
    Reply ask(Application const&, Operation const&);
    template <class Operation>
    typename Operation::Reply ask(Application const& by, Operation operation) {
        return std::get<typename Operation::Reply>(ask(by, rois::Operation{std::move(operation)}));
    }
    ReturnCode bind(Application const& by, std::string const& ref) {
        return ask(by, Bind{Application::identifier(ref)}).return_code;
    }
    template <class... Units>
    Execute::Reply execute(Application const& by, Units... units) {
        return ask(by, Execute{{std::vector<CommandUnit>{std::move(units)...}}});
    }

    // Breaks the link. It cannot be opened before `repair`.
    void cut(client::Failure = client::Failure::passing);
    void repair() { is_broken_ = false; }
    // The hall's process is killed, and begins again.
    void restart_hall();
    // The process of the main engine, which keeps a journal, is killed, and begins again after `meanwhile`.
    void restart_main(std::function<void()> const& meanwhile = [] {});
    bool is_cut() const { return is_broken_; }
    // Breaks the link after this number of further documents.
    void cut_after(int documents) { until_cut_ = documents; }
    // If `yes`, keeps back the hall's answers and notifications.
    void hold_back(bool yes) { is_held_back_ = yes; }
    // The hall's answers that are kept back arrive in reverse order.
    void reverse_answers();
    // Changes the answers of the hall.
    std::function<void(Reply&)> falsify = [](Reply&) {};
    // An operation ("bind") that the hall refuses because the token of the main engine does not allow it.
    std::string not_allowed;
    // Sends the main engine a document, as if from the hall.
    void inject(std::string const& document);
    void inject(Notification const&);  // with the next sequence
    // Calls what runs on the thread of the links.
    std::function<void(std::function<void()> const&)> on_links = [](auto const& what) { what(); };
    // The clock of the main engine stands still.
    bool main_is_alive = true;
    bool main_answers_pings = true;
    // Changes the instances that a profile may not have.
    std::string instance_of_main = "main's own";

    std::vector<std::string> reported;  // lines for the log
    EngineState shown;                  // the last state of the hall
    int links = 0;                      // that were tried
    remote::RemoteEngine& remote() { return *remote_; }
    std::shared_ptr<client::Link> link_for(client::Link::Listener&);

    // Documents to the hall since the last call, by the name of their operations.
    std::vector<std::string> asked();

private:
    class Wire;
    class Host;

    bool deliver();
    void begin_main();

    std::vector<Part> const parts_;
    std::vector<Part> const parts_of_main_;
    remote::SubEngine const settings_;
    std::shared_ptr<Host> host_;
    std::shared_ptr<remote::RemoteEngine> remote_;
    std::shared_ptr<Wire> wire_;
    bool is_broken_ = false;
    bool is_held_back_ = false;
    std::optional<int> until_cut_;
    std::vector<std::string> asked_;
};

}  // namespace rois
