#include "main/places.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "types/text/texts.hpp"

namespace rois {

namespace {

// Checks the folder of a file that does not exist yet.
void check(std::string const& key, std::string const& name) {
    if (name.empty()) return;
    auto place = std::filesystem::absolute(name).lexically_normal();
    if (!std::filesystem::exists(place)) place = (place.has_filename() ? place : place.parent_path()).parent_path();
    if (::access(place.c_str(), W_OK) != 0)
        throw BadSettings{key + ": cannot write " + rois::quoted(place.string()) + ": " + std::strerror(errno)};
}

}  // namespace

void check_places(GatewaySettings const& settings) {
    check("state", settings.state);
    check("audit_log", settings.audit_log);
}

}  // namespace rois
