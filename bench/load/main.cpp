// rois-load: the load generator of ./dev bench. One thread, so that its own share of the machine stays small.
#include <sys/resource.h>

#include <cstdio>
#include <exception>

#include "load/modes.hpp"

int main(int argc, char** argv) {
    try {
        rlimit most{};
        if (getrlimit(RLIMIT_NOFILE, &most) == 0) {
            most.rlim_cur = most.rlim_max;
            setrlimit(RLIMIT_NOFILE, &most);
        }
        auto const options = rois::bench::read_options(argc, argv);
        switch (options.mode) {
            case rois::bench::Options::Mode::requests:
                rois::bench::make_requests(options);
                break;
            case rois::bench::Options::Mode::hold:
                rois::bench::hold(options);
                break;
            case rois::bench::Options::Mode::fanout:
                rois::bench::receive_events(options);
                break;
        }
        return 0;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "rois-load: %s\n", error.what());
        return 1;
    }
}
