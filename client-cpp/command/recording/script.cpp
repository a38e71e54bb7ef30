#include "command/recording/script.hpp"

#include <algorithm>
#include <deque>
#include <list>
#include <optional>
#include <utility>

#include "command/exit.hpp"
#include "command/sequences.hpp"

namespace rois::command {

namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};

// Builds the script of one session from its documents.
class Builder {
public:
    explicit Builder(xml::RequestReader& requests) : requests_{requests} {}

    void add(RecordedDocument const& document) {
        if (document.direction == Direction::out) {
            add_sent(document);
        } else {
            add_received(document);
        }
    }

    std::shared_ptr<Script const> finish() {
        for (std::size_t i = 0; i < script_->exchanges.size(); ++i) {
            auto const& request = script_->exchanges[i].request;
            script_->exactly[exact_key(request)].push_back(i);
            if (auto key = rough_key(request); !key.empty()) script_->roughly[std::move(key)].push_back(i);
        }
        return script_;
    }

private:
    struct Asked {
        std::chrono::microseconds at{};
        Operation operation;
        std::string request_id;
    };

    void add_sent(RecordedDocument const& document) {
        auto read = requests_.read(document.text);
        auto* const request = std::get_if<Request>(&read);
        if (request == nullptr) return;
        // A request that was sent again after the link broke counts once.
        bool const again =
            !request->request_id.empty() && std::ranges::find(asked_, request->request_id, &Asked::request_id) != asked_.end();
        if (!again) asked_.push_back({document.at, std::move(request->operation), std::move(request->request_id)});
    }

    void add_received(RecordedDocument const& document) {
        auto read = answers_.read(document.text);
        if (!read) return;
        std::visit(Overloaded{[&](xml::Answered& answered) {
                                  auto reply = std::move(answered.reply);
                                  answer(std::move(reply), answered.request_id, document.at);
                              },
                              [&](Fault& fault) {
                                  auto const id = fault.request_id;
                                  answer(std::move(fault), id, document.at);
                              },
                              [&](xml::NumberedNotification& numbered) { add(std::move(numbered.notification), document.at); }},
                   *read);
    }

    void answer(std::variant<Reply, Fault> answer, std::string const& request_id, std::chrono::microseconds at) {
        auto const asked = std::ranges::find(asked_, request_id, &Asked::request_id);
        if (asked == asked_.end()) return;
        script_->exchanges.push_back({asked->at, std::move(asked->operation), std::move(answer), {}});
        answered_at_.push_back(at);
        asked_.erase(asked);
        note_ids(script_->exchanges.back(), script_->exchanges.size() - 1);
    }

    void note_ids(Exchange& exchange, std::size_t index) {
        auto* const reply = std::get_if<Reply>(&exchange.answer);
        if (reply == nullptr) return;
        if (auto* const executed = std::get_if<Execute::Reply>(reply)) {
            for (auto const* const message : messages_of(executed->command_unit_list)) commands_[message->command_id] = index;
            mover_ = index;
        } else if (auto const* const set = std::get_if<SetParameter::Reply>(reply)) {
            commands_[set->command_id] = index;
            mover_ = index;
        } else if (auto const* const subscribed = std::get_if<Subscribe::Reply>(reply)) {
            subscriptions_[subscribed->subscribe_id] = index;
        } else if (std::holds_alternative<Connect::Reply>(*reply)) {
            first_ = index;
        }
    }

    void add(Notification notification, std::chrono::microseconds at) {
        if (std::holds_alternative<Lost>(notification)) return;  // concerns only the recorded link
        auto const cause = cause_of(notification);
        if (!cause) return;
        auto const delay = std::max(at - answered_at_[*cause], std::chrono::microseconds{0});
        script_->exchanges[*cause].later.push_back({at, delay, std::move(notification)});
    }

    std::optional<std::size_t> cause_of(Notification const& notification) const {
        if (auto const* const completed = std::get_if<Completed>(&notification)) {
            auto const found = commands_.find(completed->command_id);
            if (found != commands_.end()) return found->second;
        }
        if (mover_) return mover_;
        if (auto const* const event = std::get_if<ReceiveEvent>(&notification)) {
            auto const found = subscriptions_.find(event->subscribe_id);
            if (found != subscriptions_.end()) return found->second;
        }
        return first_;
    }

    xml::RequestReader& requests_;
    xml::AnswerReader answers_;
    std::shared_ptr<Script> script_ = std::make_shared<Script>();
    std::deque<Asked> asked_;
    std::vector<std::chrono::microseconds> answered_at_;
    std::map<CommandId, std::size_t> commands_;
    std::map<SubscribeId, std::size_t> subscriptions_;
    std::optional<std::size_t> mover_;  // the last `execute` or `set_parameter`
    std::optional<std::size_t> first_;
};

void forget_ids(Operation& operation) {
    if (auto* const execute = std::get_if<Execute>(&operation))
        for (auto* const message : messages_of(execute->command_unit_list)) message->command_id = {};
}

}  // namespace

std::string exact_key(Operation operation) {
    forget_ids(operation);
    return xml::encode(Request{std::move(operation), {}});
}

std::string rough_key(Operation operation) {
    bool const chooses = std::holds_alternative<BindAny>(operation) || std::holds_alternative<Search>(operation);
    if (chooses) return {};
    forget_ids(operation);
    std::visit(Overloaded{[](Execute& execute) {
                              for (auto* const message : messages_of(execute.command_unit_list)) message->arguments.clear();
                          },
                          [](SetParameter& set) { set.parameters.clear(); }, [](Connect& connect) { connect = {}; },
                          [](auto& other) {
                              if constexpr (requires { other.condition; }) other.condition = {};
                          }},
               operation);
    return xml::encode(Request{std::move(operation), {}});
}

std::vector<std::shared_ptr<Script const>> scripts_of(std::vector<RecordedDocument> const& documents,
                                                      xml::RequestReader& requests) {
    std::list<std::pair<std::string, Builder>> builders;  // by session; a list, since a Builder cannot be moved
    for (auto const& document : documents) {
        auto found = std::ranges::find_if(builders, [&](auto const& one) { return one.first == document.session; });
        if (found == builders.end()) found = builders.emplace(builders.end(), document.session, requests);
        found->second.add(document);
    }
    std::vector<std::shared_ptr<Script const>> scripts;
    for (auto& [session, builder] : builders) {
        auto script = builder.finish();
        if (!script->exchanges.empty()) scripts.push_back(std::move(script));
    }
    if (scripts.empty()) throw Trouble{Exit::usage, "the recording contains no request with its answer"};
    return scripts;
}

}  // namespace rois::command
