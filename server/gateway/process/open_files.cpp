#include "gateway/process/open_files.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace rois {

std::size_t raise_open_files(std::size_t wanted) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return 0;
    if (limit.rlim_cur >= wanted) return limit.rlim_cur;
    rlimit const privileged{wanted, std::max<rlim_t>(limit.rlim_max, wanted)};
    if (::setrlimit(RLIMIT_NOFILE, &privileged) == 0) return wanted;
    rlimit const allowed{std::min<rlim_t>(limit.rlim_max, wanted), limit.rlim_max};
    return ::setrlimit(RLIMIT_NOFILE, &allowed) == 0 ? allowed.rlim_cur : limit.rlim_cur;
}

}  // namespace rois
