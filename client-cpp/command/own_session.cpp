#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>

#include "command/session.hpp"

namespace rois::command {

namespace {

// What came and was not taken yet; filled on the client's thread.
class Inbox {
public:
    void put(Heard heard) {
        {
            std::lock_guard const lock{mutex_};
            waiting_.push_back(std::move(heard));
        }
        changed_.notify_all();
    }

    void close() {
        {
            std::lock_guard const lock{mutex_};
            closed_ = true;
        }
        changed_.notify_all();
    }

    std::optional<Heard> take(Until until) {
        std::unique_lock lock{mutex_};
        auto const ready = [&] { return closed_ || !waiting_.empty(); };
        if (!until) {
            changed_.wait(lock, ready);
        } else {
            changed_.wait_until(lock, *until, ready);
        }
        if (waiting_.empty()) return std::nullopt;
        auto first = std::move(waiting_.front());
        waiting_.pop_front();
        return first;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Heard> waiting_;
    bool closed_ = false;
};

class OwnSession : public Session {
public:
    OwnSession(Options const& options, std::shared_ptr<RecordingWriter> recorded)
        : url_{options.url}, recorded_{std::move(recorded)}, connection_{settings(options), observers()} {
        auto const none = connection_.wait(connection_.opened(options.deadline));
        if (none) throw Trouble{Exit::no_answer, url_ + ": " + none->reason};
    }

    bool is_joined() const override { return false; }
    SessionId id() const override { return connection_.session(); }

    std::string send(std::string const& document) override {
        auto sent = connection_.wait(connection_.send(document));
        if (auto* const answer = std::get_if<std::string>(&sent)) return std::move(*answer);
        if (interrupted()) throw Trouble{Exit::interrupted, ""};
        throw Trouble{Exit::no_answer, std::get<NoAnswer>(sent).reason};
    }

    std::optional<Heard> hear(Until until) override { return inbox_.take(until); }

protected:
    Answer answer(Request request) override { return connection_.wait(connection_.request(std::move(request))); }

    void end_waiting() override {
        inbox_.close();
        connection_.close();
    }

private:
    // Commands that are over soon do not try for long.
    static Settings settings(Options const& options) {
        auto settings = settings_of(options);
        bool const lasts = options.command == "watch" || options.command == "subscribe" || options.command == "record" ||
                           options.command == "bind" || options.command == "scenario";
        if (!lasts) settings.attempts = 3;
        return settings;
    }

    Observers observers() {
        Observers observers;
        observers.state = [this](StateChange const& change) {
            inbox_.put(change);
            if (change.state == State::closed) inbox_.close();
        };
        observers.gap = [this](Gap const& gap) { inbox_.put(gap); };
        observers.notification = [this](Notification const& notification, std::uint64_t sequence) {
            inbox_.put(News{notification, sequence});
        };
        if (recorded_)
            observers.tap = [recorded = recorded_](Direction direction, std::string_view document) {
                recorded->add(direction, document);
            };
        return observers;
    }

    std::string url_;
    std::shared_ptr<RecordingWriter> recorded_;
    Inbox inbox_;
    Connection connection_;
};

}  // namespace

std::unique_ptr<Session> own_session(Options const& options, std::shared_ptr<RecordingWriter> recorded) {
    try {
        return std::make_unique<OwnSession>(options, std::move(recorded));
    } catch (std::invalid_argument const& error) {
        throw Trouble{Exit::usage, error.what()};
    }
}

}  // namespace rois::command
