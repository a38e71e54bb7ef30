#include "command/recording/player.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "command/sequences.hpp"
#include "xml/codec/decoding.hpp"

namespace rois::command {

namespace {

using Clock = std::chrono::steady_clock;

// Recorded command ids, and the ids that the application has given instead.
using Names = std::map<CommandId, CommandId>;

// Returns the answer to an operation that is not in the recording: UNSUPPORTED.
std::variant<Reply, Fault> unknown(Operation const& operation) {
    auto const name = std::string{xml::operation_names()[operation.index()]};
    return std::visit(
        [&](auto const& one) {
            typename std::decay_t<decltype(one)>::Reply reply;
            reply.return_code = ReturnCode::unsupported;
            reply.reason = "the recording has no answer to this " + name;
            return Reply{std::move(reply)};
        },
        operation);
}

}  // namespace

// The notifications to send, with their times. Outlives its player while its timer runs.
class Player::Stage : public std::enable_shared_from_this<Player::Stage> {
public:
    Stage(asio::io_context& io, HostedSession& session, double speed) : timer_{io}, session_{&session}, speed_{speed} {}

    void subscribe(SubscribeId const& id) { subscriptions_.insert(id); }
    void unsubscribe(SubscribeId const& id) { subscriptions_.erase(id); }

    // Schedules notifications. The answer is written before them.
    void add(std::vector<Later> const& all, Names const& names) {
        auto const now = Clock::now();
        for (auto const& later : all) {
            auto notification = later.notification;
            if (auto* const completed = std::get_if<Completed>(&notification)) {
                auto const name = names.find(completed->command_id);
                if (name != names.end()) completed->command_id = name->second;
            }
            auto const delay = speed_ > 0
                                   ? std::chrono::duration<double, std::micro>{static_cast<double>(later.delay.count()) / speed_}
                                   : std::chrono::duration<double, std::micro>{0};
            due_.emplace(now + std::chrono::duration_cast<Clock::duration>(delay), Due{later.at, std::move(notification)});
        }
        wait();
    }

    // Sends now all notifications that were recorded before this time, so that they stay in order.
    void catch_up(std::chrono::microseconds recorded) {
        for (auto one = due_.begin(); one != due_.end();) {
            if (one->second.recorded <= recorded) {
                notify(one->second.notification);
                one = due_.erase(one);
            } else {
                ++one;
            }
        }
    }

    void close() {
        session_ = nullptr;
        due_.clear();
        timer_.cancel();
    }

private:
    void wait() {
        if (due_.empty()) return;
        timer_.expires_at(due_.begin()->first);
        timer_.async_wait([self = shared_from_this()](Failure failure) {
            if (!failure) self->notify_due();
        });
    }

    void notify_due() {
        auto const now = Clock::now();
        while (session_ != nullptr && !due_.empty() && due_.begin()->first <= now) {
            auto const due = std::move(due_.begin()->second);
            due_.erase(due_.begin());
            notify(due.notification);
        }
        wait();
    }

    void notify(Notification const& notification) {
        auto const* const event = std::get_if<ReceiveEvent>(&notification);
        if (event == nullptr || subscriptions_.contains(event->subscribe_id)) session_->notify(notification);
    }

    struct Due {
        std::chrono::microseconds recorded;
        Notification notification;
    };

    asio::steady_timer timer_;
    HostedSession* session_;
    double speed_;
    std::multimap<Clock::time_point, Due> due_;
    std::set<SubscribeId> subscriptions_;
};

Player::Player(asio::io_context& io, HostedSession& session, std::shared_ptr<Script const> script, double speed)
    : stage_{std::make_shared<Stage>(io, session, speed)}, script_{std::move(script)} {
    if (auto const* const connected = matching(Connect{})) stage_->add(connected->later, {});
}

Player::~Player() { stage_->close(); }

void Player::take(std::string const&, std::variant<Request, Fault> const& read, std::function<void(std::string)> reply) {
    auto const* const request = std::get_if<Request>(&read);
    reply(request != nullptr ? answer(*request) : xml::encode(std::get<Fault>(read)));
}

// The n-th of equal requests gets the n-th recorded answer, or the last one if the recording has fewer.
Exchange const* Player::matching(Operation const& operation) {
    auto const take = [&](std::map<std::string, std::vector<std::size_t>> const& all, std::string const& key) -> Exchange const* {
        auto const found = all.find(key);
        if (key.empty() || found == all.end()) return nullptr;
        auto& used = used_[key];
        auto const index = found->second[std::min(used, found->second.size() - 1)];
        ++used;
        return &script_->exchanges[index];
    };
    if (auto const* const same = take(script_->exactly, exact_key(operation))) return same;
    return take(script_->roughly, rough_key(operation));
}

std::string Player::answer(Request const& request) {
    auto operation = request.operation;
    if (auto* const asked = std::get_if<GetCommandResult>(&operation)) {
        auto const recorded = recorded_ids_.find(asked->command_id);
        if (recorded != recorded_ids_.end()) asked->command_id = recorded->second;
    }
    if (auto const* const left = std::get_if<Unsubscribe>(&operation)) stage_->unsubscribe(left->subscribe_id);
    auto const* const exchange = matching(operation);
    auto answered = exchange != nullptr ? answer_of(*exchange, operation) : unknown(operation);
    if (auto* const fault = std::get_if<Fault>(&answered)) {
        fault->request_id = request.request_id;
        return xml::encode(*fault);
    }
    return xml::encode(std::get<Reply>(answered), request.request_id);
}

std::variant<Reply, Fault> Player::answer_of(Exchange const& exchange, Operation const& operation) {
    auto answer = exchange.answer;
    Names names;
    bool const moves = std::holds_alternative<Execute>(operation) || std::holds_alternative<SetParameter>(operation);
    if (moves) stage_->catch_up(exchange.asked_at);
    auto* const reply = std::get_if<Reply>(&answer);
    auto* const executed = reply != nullptr ? std::get_if<Execute::Reply>(reply) : nullptr;
    if (executed != nullptr && executed->return_code == ReturnCode::ok) {
        auto sequence = std::get<Execute>(operation).command_unit_list;
        auto const recorded = messages_of(executed->command_unit_list);
        auto const given = messages_of(sequence);
        for (std::size_t i = 0; i < std::min(recorded.size(), given.size()); ++i) {
            if (given[i]->command_id.text.empty()) given[i]->command_id = recorded[i]->command_id;
            names[recorded[i]->command_id] = given[i]->command_id;
            recorded_ids_[given[i]->command_id] = recorded[i]->command_id;
        }
        executed->command_unit_list = std::move(sequence);
    }
    if (reply != nullptr && std::holds_alternative<Subscribe::Reply>(*reply))
        stage_->subscribe(std::get<Subscribe::Reply>(*reply).subscribe_id);
    stage_->add(exchange.later, names);
    return answer;
}

}  // namespace rois::command
