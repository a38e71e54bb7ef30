// A component that answers when the test says so, as one in another program does.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/world.hpp"

namespace rois {

class SlowComponent final : public Component {
public:
    explicit SlowComponent(Part const& part) {
        description_.ref = Application::identifier(part.ref);
        description_.engine = part.engine;
        description_.profile = std::make_shared<ComponentProfile const>(part.profile);
        description_.moves = part.moves;
        description_.returns_at_once = true;
        description_.confirms_binding = part.confirms_binding;
    }

    // The questions and halts that wait for an answer: "query", "prepare", "bind", "suspend", "resume", "halt".
    struct Question {
        std::string what;
        Ticket ticket;
    };
    std::deque<Question> questions;
    std::vector<CommandHandle> begun;
    bool answers_halts = true;
    bool answers_prepare = true;

    ComponentPort& port() { return *port_; }

    // Answers the oldest question of this kind.
    void answer(std::string const& what, ComponentAnswer answer) { port_->answered(take(what), std::move(answer)); }
    void answer_query(std::string const& length) {
        Parameter row{"length", {"double", {}, {}, {}}, {length}};
        answer("query", std::vector<Results>{{{std::move(row)}, {}}});
    }
    void let_prepare() { answer("prepare", begin()); }
    void confirm_halt() { port_->halted(take("halt")); }
    Ticket take(std::string const& what) {
        auto const found = std::ranges::find(questions, what, &Question::what);
        if (found == questions.end()) throw std::logic_error("nothing waits: " + what);
        auto const ticket = found->ticket;
        questions.erase(found);
        return ticket;
    }

    ComponentDescription const& description() const override { return description_; }
    void attach(ComponentPort& port) override {
        port_ = &port;
        port.changed({.status = ComponentStatus::ready, .location = {}, .parameters = {}});
    }
    void bind(Ticket ticket, Binding const&, Instant) override { questions.push_back({"bind", ticket}); }
    void prepare(Ticket ticket, std::string_view, ParameterList const&, Instant) override {
        questions.push_back({"prepare", ticket});
        if (answers_prepare) let_prepare();
    }
    void halt(Ticket ticket, Instant) override {
        questions.push_back({"halt", ticket});
        if (answers_halts) confirm_halt();
    }
    void suspend(Ticket ticket, Instant) override { questions.push_back({"suspend", ticket}); }
    void resume(Ticket ticket, Instant) override { questions.push_back({"resume", ticket}); }
    void query(Ticket ticket, std::string_view, Instant) override { questions.push_back({"query", ticket}); }

private:
    Begin begin() {
        return [this](CommandHandle command, Instant) {
            begun.push_back(command);
            port_->started(command);
        };
    }

    ComponentDescription description_;
    ComponentPort* port_ = nullptr;
};

}  // namespace rois
