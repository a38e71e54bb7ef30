#include "types/text/environment.hpp"

#include <algorithm>
#include <array>

namespace rois {

namespace {

// Includes variables of the project's tests, and those that Kubernetes sets for a service called rois-gateway.
bool is_known(std::string_view name) {
    constexpr std::array<std::string_view, 10> names{
        "ROIS_CONFIG",           "ROIS_NAME", "ROIS_URL",      "ROIS_SESSION", "ROIS_SESSION_FILE", "ROIS_TOKEN", "ROIS_CA_FILE",
        "ROIS_CERTIFICATE_FILE", "ROIS_JOBS", "ROIS_ENDURANCE"};
    constexpr std::array<std::string_view, 4> beginnings{"ROIS_GATEWAY_", "ROIS_TEST_", "ROIS_BINARY_", "ROIS_PICTURES"};
    return std::ranges::find(names, name) != names.end() ||
           std::ranges::any_of(beginnings, [&](auto each) { return name.starts_with(each); });
}

}  // namespace

std::vector<std::string> unknown_variables(char const* const* environment, std::function<bool(std::string_view)> const& is_key) {
    std::vector<std::string> unknown;
    for (auto const* const* each = environment; *each != nullptr; ++each) {
        std::string_view const variable{*each};
        auto const name = variable.substr(0, variable.find('='));
        bool const is_set = name.size() + 1 < variable.size();  // an empty variable counts as unset
        if (is_set && name.starts_with("ROIS_") && !is_known(name) && !is_key(name)) unknown.emplace_back(name);
    }
    std::ranges::sort(unknown);
    return unknown;
}

}  // namespace rois
