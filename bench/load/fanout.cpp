#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "load/application.hpp"
#include "load/measure.hpp"
#include "load/modes.hpp"
#include "load/readiness.hpp"

namespace rois::bench {

namespace {

constexpr Nanoseconds longest_round = 20'000'000'000;

// The component's time stamp in the event, ">t<CLOCK_MONOTONIC in ns><", or `otherwise` if there is none.
Nanoseconds fired_at(std::string_view event, Nanoseconds otherwise) {
    auto const mark = event.find(">t");
    if (mark == event.npos) return otherwise;
    return std::strtoll(event.data() + mark + 2, nullptr, 10);
}

// A round ends when all subscribers have received all events of a burst. The next round then begins, or, with --rate, when it is
// due.
class Rounds {
public:
    explicit Rounds(Options const& options)
        : options_{options}, subscribers_{make_applications(options)}, firing_{options, options.connections, options.fire_setup} {
        for (std::size_t i = 0; i < subscribers_.size(); ++i) readiness_.watch(subscribers_[i].socket().descriptor(), i);
        fire_ = firing_.carried(filled_in(options.fire, options.connections, options.connections));
    }

    void run() {
        announce(options_);
        play(options_.warm_up);
        latencies_.clear();
        messages_ = 0;
        auto const cpu = cpu_of(options_.pid);
        auto const own_cpu = cpu_of(0);
        auto const begun = now();
        play(options_.seconds);
        auto const took = static_cast<double>(now() - begun);
        auto const count = static_cast<double>(messages_);
        auto const each = [&](Nanoseconds from, int pid) { return static_cast<double>(cpu_of(pid) - from) / 1'000 / count; };
        auto const line = "{" + member("cpu_us", each(cpu, options_.pid)) + "," + member("load_cpu_us", each(own_cpu, 0)) + "," +
                          member("messages", count) + "," + member("messages_per_second", count * 1e9 / took) + "," +
                          member("message_bytes", static_cast<double>(message_bytes_)) + "," +
                          member("bursts", static_cast<double>(latencies_.size())) + "," + latencies_.json() + "}";
        std::puts(line.c_str());
        disconnect(options_, subscribers_);
        disconnect(options_, {&firing_, 1});
    }

private:
    void play(double seconds) {
        auto const begun = now();
        auto const end = begun + static_cast<Nanoseconds>(seconds * 1e9);
        auto due = begun;
        do {
            wait_until(due);
            play_round(now());
            if (options_.rate > 0) due += static_cast<Nanoseconds>(1e9 / options_.rate);
        } while (now() < end);
    }

    // Between two rounds only pings arrive.
    void wait_until(Nanoseconds due) {
        while (options_.rate > 0 && now() < due) take_all(due);
    }

    void play_round(Nanoseconds begun) {
        auto const wanted = messages_ + subscribers_.size() * options_.burst;
        firing_.socket().send(fire_);
        bool const answered = options_.connect;
        while (answered && is_notification(firing_.socket().wait().body)) {
        }
        while (messages_ < wanted) {
            take_all(begun + longest_round);
            if (now() > begun + longest_round) throw std::runtime_error("not all events arrived within 20 s");
        }
        latencies_.add(now() - (last_fired_ == 0 ? begun : last_fired_));
        firing_.socket().drain();
    }

    void take_all(Nanoseconds until) {
        for (auto const& ready : readiness_.wait(until)) {
            while (auto const message = subscribers_[ready.data.u64].socket().next()) {
                ++messages_;
                message_bytes_ = message->body.size();
                last_fired_ = fired_at(message->body, 0);
            }
        }
    }

    Options const& options_;
    std::vector<Application> subscribers_;
    Application firing_;
    Readiness readiness_{options_.spin};
    std::string fire_;
    Latencies latencies_;
    std::size_t messages_ = 0;
    std::size_t message_bytes_ = 0;
    Nanoseconds last_fired_ = 0;
};

}  // namespace

void receive_events(Options const& options) { Rounds{options}.run(); }

}  // namespace rois::bench
