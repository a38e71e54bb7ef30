#include <cstdio>
#include <deque>
#include <stdexcept>
#include <vector>

#include "load/application.hpp"
#include "load/measure.hpp"
#include "load/modes.hpp"
#include "load/readiness.hpp"

namespace rois::bench {

namespace {

// The requests of one connection, one at a time.
class Asker {
public:
    Asker(Application& application, Options const& options, std::size_t number) : application_{application}, options_{options} {
        for (std::size_t i = 0; i < options.variants; ++i)
            for (auto const& body : options.bodies) prepare(filled_in(body, number, number * options.variants + i));
    }

    // Sends the next request. Its latency counts from `due`.
    void ask(Nanoseconds due) {
        began_ = due;
        answered_ = notified_ = false;
        application_.socket().send(requests_[next_]);
        next_ = next_ + 1 == requests_.size() ? 0 : next_ + 1;
    }

    // Reads the received messages. Returns true when the request is over.
    bool take() {
        while (auto const message = application_.socket().next()) {
            take(*message);
            if (answered_ && (notified_ || options_.await.empty())) return true;
        }
        return false;
    }

    Nanoseconds began() const { return began_; }
    std::size_t answer_bytes() const { return answer_bytes_; }

private:
    // Prepares one request, or two with different heads.
    void prepare(std::string const& document) {
        auto const request = application_.carried(document);
        if (!options_.other_heads) return requests_.push_back(request);
        for (auto const* field : {"Max-Forwards: 1\r\n", "Max-Forwards: 2\r\n"})
            requests_.push_back(std::string{request}.insert(request.find("Host:"), field));
    }

    void take(Socket::Message const& message) {
        bool const has_notifications = options_.via == Via::http ? answered_ : is_notification(message.body);
        if (has_notifications) {
            note_sequence(message.body);
            notified_ = message.body.find(options_.await) != message.body.npos;
        } else {
            if (!options_.expect.empty() && message.body.find(options_.expect) == message.body.npos)
                throw std::runtime_error("unexpected answer: " + std::string{message.head} + std::string{message.body});
            answered_ = true;
            answer_bytes_ = message.body.size();
        }
        if (options_.via == Via::http && !options_.await.empty() && !notified_) poll();
    }

    // Notes the last sequence of this message; the next poll continues after it.
    void note_sequence(std::string_view document) {
        constexpr std::string_view attribute = "sequence=\"";
        auto const last = document.rfind(attribute);
        if (last != document.npos) last_sequence_ = std::strtoull(document.data() + last + attribute.size(), nullptr, 10);
    }

    // Sends a long poll: over HTTP, notifications must be requested.
    void poll() {
        auto const path = options_.path + "/notifications?wait=10&after=" + std::to_string(last_sequence_);
        application_.socket().send(http_get(path, application_.session(), "application/xml"));
    }

    Application& application_;
    Options const& options_;
    std::vector<std::string> requests_;
    std::size_t next_ = 0;
    Nanoseconds began_ = 0;
    std::size_t answer_bytes_ = 0;
    std::uint64_t last_sequence_ = 0;
    bool answered_ = false;
    bool notified_ = false;
};

class Load {
public:
    explicit Load(Options const& options) : options_{options}, applications_{make_applications(options)} {
        for (std::size_t i = 0; i < applications_.size(); ++i) {
            askers_.emplace_back(applications_[i], options, i);
            readiness_.watch(applications_[i].socket().descriptor(), i);
            free_.push_back(i);
        }
    }

    void run() {
        announce(options_);
        due_ = now();
        play_until(due_ + in_nanoseconds(options_.warm_up));
        latencies_.clear();
        auto const cpu = cpu_of(options_.pid);
        auto const own_cpu = cpu_of(0);
        auto const begun = now();
        play_until(begun + in_nanoseconds(options_.seconds));
        auto const took = static_cast<double>(now() - begun);
        auto const count = static_cast<double>(latencies_.size());
        if (count == 0) throw std::runtime_error("no request was answered in the measured time");
        auto const each = [&](Nanoseconds from, int pid) { return static_cast<double>(cpu_of(pid) - from) / 1'000 / count; };
        auto const line = "{" + member("cpu_us", each(cpu, options_.pid)) + "," + member("load_cpu_us", each(own_cpu, 0)) + "," +
                          member("requests", count) + "," + member("requests_per_second", count * 1e9 / took) + "," +
                          member("answer_bytes", static_cast<double>(askers_.front().answer_bytes())) + "," + latencies_.json() +
                          "}";
        std::puts(line.c_str());
        disconnect(options_, applications_);
    }

private:
    static Nanoseconds in_nanoseconds(double seconds) { return static_cast<Nanoseconds>(seconds * 1e9); }

    void play_until(Nanoseconds end) {
        for (auto at = now(); at < end; at = now()) {
            ask(at);
            auto const wake = options_.rate > 0 && !free_.empty() ? std::min(end, due_) : end;
            for (auto const& ready : readiness_.wait(wake)) {
                if (!askers_[ready.data.u64].take()) continue;
                latencies_.add(now() - askers_[ready.data.u64].began());
                free_.push_back(ready.data.u64);
            }
        }
    }

    // Lets idle connections send a request: all of them or, with --rate, as many as are due.
    void ask(Nanoseconds at) {
        while (!free_.empty() && (options_.rate == 0 || due_ <= at)) {
            askers_[free_.front()].ask(options_.rate == 0 ? now() : due_);
            if (options_.rate > 0) due_ += in_nanoseconds(1 / options_.rate);
            free_.pop_front();
        }
    }

    Options const& options_;
    std::vector<Application> applications_;
    std::deque<Asker> askers_;
    Readiness readiness_{options_.spin};
    std::deque<std::size_t> free_;
    Nanoseconds due_ = 0;
    Latencies latencies_;
};

}  // namespace

void make_requests(Options const& options) {
    if (options.bodies.empty()) throw std::runtime_error("--body is missing");
    Load{options}.run();
}

}  // namespace rois::bench
