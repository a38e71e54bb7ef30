#include "clients/round_trips.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace rois::bench {

namespace {

constexpr Nanoseconds second = 1'000'000'000;
constexpr Nanoseconds warm_up = second / 5;

}  // namespace

Setting read_setting(int argc, char const* const* argv) {
    if (argc != 4 && argc != 5) throw std::runtime_error("expected PORT DOCUMENT SECONDS [blocking]");
    std::ifstream file{argv[2]};
    std::string document{std::istreambuf_iterator<char>{file}, {}};
    if (document.empty()) throw std::runtime_error(std::string{argv[2]} + " cannot be read");
    return {static_cast<std::uint16_t>(std::strtoul(argv[1], nullptr, 10)), std::move(document), std::strtod(argv[3], nullptr),
            argc == 5};
}

RoundTrips::RoundTrips(double seconds)
    : measured_{static_cast<Nanoseconds>(seconds * static_cast<double>(second))}, begun_{now()}, from_{begun_ + warm_up} {}

bool RoundTrips::next() {
    auto const ended = now();
    if (cpu_ != 0) {
        latencies_.add(ended - begun_);
    } else if (ended >= from_) {
        from_ = ended;
        cpu_ = cpu_of(0);
    }
    begun_ = ended;
    if (ended < from_ + measured_) return true;
    cpu_ = cpu_of(0) - cpu_;
    measured_ = ended - from_;
    return false;
}

std::string RoundTrips::json() {
    auto const count = static_cast<double>(latencies_.size());
    auto const seconds = static_cast<double>(measured_) / static_cast<double>(second);
    return "{" + member("cpu_us", static_cast<double>(cpu_) / 1'000 / count) + "," +
           member("requests_per_second", count / seconds) + "," + latencies_.json() + "}";
}

int measure_round_trips(int argc, char const* const* argv, void (*ask)(Setting const&, RoundTrips&)) {
    try {
        auto const setting = read_setting(argc, argv);
        RoundTrips trips{setting.seconds};
        ask(setting, trips);
        std::puts(trips.json().c_str());
        return 0;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return 1;
    }
}

}  // namespace rois::bench
